"""The lock file: one release of each package, by the hash of its contract (`ecm-extract/lock/1`)."""

from __future__ import annotations

from typing import Literal

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.registry.wishes import Wish


class Locked(msgspec.Struct, frozen=True):
    """A release that was chosen, by the hash of its contract; `by` names who asked for it."""

    package: str
    version: str
    contract: str
    repository: str
    tag: str | None
    commit: str | None
    channel: str | None
    by: tuple[str, ...]


class Outside(msgspec.Struct, frozen=True):
    """A dependency that the registry does not have; `known` when the runtime profile has a version in its range."""

    package: str
    wanted: str
    by: str
    known: bool


class Passed(msgspec.Struct, frozen=True):
    """A better release that was not chosen, and why."""

    release: str
    reason: str


class Lock(msgspec.Struct, frozen=True, kw_only=True):
    """One release of each package: what to install."""

    schema: Literal["ecm-extract/lock/1"] = "ecm-extract/lock/1"
    requests: tuple[Wish, ...]
    releases: tuple[Locked, ...]
    outside: tuple[Outside, ...]
    passed: tuple[Passed, ...]
    findings: tuple[Finding, ...]
