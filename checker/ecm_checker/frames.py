"""Coordinate frames: canonical names, and which of them a transform connects.

Source: REP 105; tf2 takes frame ids without a leading slash.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import resources

from ecm_checker.names import is_known


@cache
def aliases() -> Mapping[str, str]:
    """Other spellings of a frame -> the canonical one."""
    text = (resources.files("ecm_checker") / "data" / "frames.toml").read_text("utf-8")
    table: dict[str, str] = tomllib.loads(text)["aliases"]
    return table


def canonical(frame: str) -> str:
    """The frame without a leading slash, in its usual spelling."""
    bare = frame.strip().lstrip("/")
    return aliases().get(bare, bare)


def known(frame: str | None) -> str | None:
    """The canonical frame; None when it is not declared or computed when it runs."""
    return canonical(frame) if frame and is_known(frame) and "<-" not in frame else None


def ends(text: str | None) -> tuple[str, str] | None:
    """Both frames of a transform (`a <- b`); None when one of them is not known."""
    sides = [known(side) for side in (text or "").split("<-")]
    if len(sides) != 2 or sides[0] is None or sides[1] is None:
        return None
    return sides[0], sides[1]


def groups(transforms: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Frame -> a name of the tree that it is in: two frames are connected when theirs is the same."""
    root: dict[str, str] = {}
    for one, two in transforms:
        first, second = _root(root, canonical(one)), _root(root, canonical(two))
        root[max(first, second)] = min(first, second)
    return {frame: _root(root, frame) for frame in list(root)}


def _root(root: dict[str, str], frame: str) -> str:
    root.setdefault(frame, frame)
    while root[frame] != frame:
        frame = root[frame]
    return frame
