"""The wire format `ecm-extract/migration/1`."""

from __future__ import annotations

import msgspec
from ecm_checker.json_data import json_data

from ecm_extract.diff.migration import migration_of
from ecm_extract.diff.model import Comparison


def render(comparison: Comparison) -> str:
    """Return the migration of a comparison as JSON, indented by one space."""
    found = migration_of(comparison.old.ref, comparison.new.ref, comparison.changes)
    data = msgspec.json.encode(json_data(msgspec.to_builtins(found)))
    return msgspec.json.format(data, indent=1).decode() + "\n"
