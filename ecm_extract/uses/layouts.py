"""Endpoints of a type whose layout changed: built against the old one they no longer talk to those built anew.

Source: ROS 1 compares MD5 sums when it connects, ROS 2 type hashes (REP 2011); nested types count.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_VERBS: Final = {
    "publisher": "publishes it on",
    "subscriber": "subscribes to it on",
    "service_server": "serves it as",
    "service_client": "calls it as",
    "action_server": "serves it as",
    "action_client": "calls it as",
}


def layout_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the endpoints of a workspace that must be built anew, each line once."""
    seen: set[tuple[str, str, int]] = set()
    for module in workspace.linked:
        for entry in module.interfaces:
            located = index.layout_of(entry.type) if entry.role in _VERBS and entry.type is not None else None
            at = entry.evidence[0]
            mark = (entry.type or "", at.path, at.line)
            if located is not None and mark not in seen:
                seen.add(mark)
                place = Place(module.module.package, at.path, at.line)
                what = f"{_VERBS[entry.role]} {entry.name} and must be built anew with it"
                yield use_at(located, place, what, "likely")
