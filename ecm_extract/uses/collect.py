"""All uses of a workspace that the changes break."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from ecm_extract.entities.side import Workspace
from ecm_extract.uses.endpoints import endpoint_uses
from ecm_extract.uses.fields import field_uses
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Use
from ecm_extract.uses.overrides import override_uses
from ecm_extract.uses.parameters import parameter_uses
from ecm_extract.uses.symbols import symbol_uses

_MATCHERS = (endpoint_uses, parameter_uses, symbol_uses, override_uses, field_uses)


def uses_of(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the uses of a workspace, each with the commit it was read at."""
    if index.is_empty():
        return
    for matcher in _MATCHERS:
        for use in matcher(workspace, index):
            yield msgspec.structs.replace(use, commit=workspace.tree.commit)
