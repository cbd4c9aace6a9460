"""One of the two releases of a question."""

from __future__ import annotations

import msgspec
from ecm_checker.hub.package import Package


class Side(msgspec.Struct, frozen=True):
    """A release: its package, and how it is called (`driver@1.2.0`, `src/driver`), with its commit."""

    label: str
    package: Package
    commit: str | None = None
    repository: str = ""
