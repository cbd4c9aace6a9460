"""What runs have shown on this machine, so that `accept` can tell a fingerprint from a slip of the pen.

It lies in the cache: where that cannot be used, nothing is remembered.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.answers.scope import Scope, scope_of
from ecm_extract.cache.folder import cache_folder
from ecm_extract.cache.store import Store

_KEY: Final = "shown-1"


class Shown(msgspec.Struct, frozen=True):
    """A finding or a change that a run has shown.

    Attributes:
        fingerprint: 16 hexadecimal digits. rule: that found it. scope: of the runs that find it.
        message: what was said. file: of accepted findings that the run has read.
    """

    fingerprint: str
    rule: str
    scope: Scope
    message: str
    file: str


def shown_of(findings: Iterable[Finding], file: Path) -> list[Shown]:
    """Return what is to be kept of findings; `file` holds what is accepted of them."""
    return [
        Shown(each.fingerprint, each.rule, scope_of(each.rule), f"{each.name}: {each.message}", str(file))
        for each in findings
    ]


def remember(entries: Iterable[Shown]) -> None:
    """Keep what a run has shown."""
    Store(cache_folder()).put({f"{_KEY} {each.fingerprint}": msgspec.msgpack.encode(each) for each in entries})


def recall(fingerprint: str) -> Shown | None:
    """Return what the last run that showed a fingerprint said; None when none did."""
    key = f"{_KEY} {fingerprint}"
    found = Store(cache_folder()).get([key]).get(key)
    try:
        return None if found is None else msgspec.msgpack.decode(found, type=Shown)
    except msgspec.MsgspecError:
        return None
