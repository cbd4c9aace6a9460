"""What of a comparison was not read, on which side, and whether the verdict can be known without it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Literal

import msgspec

from ecm_extract.exclusion import Exclusion
from ecm_extract.tree.unread import Reason, Unread, is_gap

SideWord = Literal["old", "new", "both", "consumer"]
_Key = tuple[Reason, str]


class UnreadPart(msgspec.Struct, frozen=True):
    """Something that was not read of one side or of both.

    Attributes:
        path: relative to the root of the tree, printable; of `excluded` the pattern.
        reason: why.
        carries: whether it can declare or use interfaces.
        side: where it was not read.
        limits: whether the verdict is not known because of it.
        old, new: of a submodule, the commits that the two sides name; None on a side that has none or has read it.
    """

    path: str
    reason: Reason
    carries: bool
    side: SideWord
    limits: bool
    old: str | None = None
    new: str | None = None


class SideRead(msgspec.Struct, frozen=True):
    """What a comparison knows of how one side was read: what was not, and every path that the side lists."""

    unread: tuple[Unread, ...]
    paths: frozenset[str]


def unread_parts(old: SideRead, new: SideRead, consumers: Iterable[Unread] = ()) -> tuple[UnreadPart, ...]:
    """Return what was not read, what limits the verdict first."""
    before, after = _by_key(old.unread), _by_key(new.unread)
    found = [_both(each, after[key]) for key, each in before.items() if key in after]
    found += [_on_old(each, new) for key, each in before.items() if key not in after]
    found += [_on_new(each, old) for key, each in after.items() if key not in before]
    found += [UnreadPart(each.path, each.reason, each.carries, "consumer", is_gap(each)) for each in consumers]
    return tuple(sorted(found, key=lambda part: (not part.limits, part.reason, part.path, part.side)))


def _by_key(unread: Iterable[Unread]) -> Mapping[_Key, Unread]:
    return {(each.reason, each.path): each for each in unread}


def _both(before: Unread, after: Unread) -> UnreadPart:
    """What is left out of both sides on purpose, or is a submodule that did not move, hides no change."""
    limits = is_gap(before) or is_gap(after) or before.commit != after.commit
    carries = before.carries or after.carries
    return UnreadPart(before.path, before.reason, carries, "both", limits, before.commit or None, after.commit or None)


def _on_old(unread: Unread, new: SideRead) -> UnreadPart:
    return UnreadPart(
        unread.path, unread.reason, unread.carries, "old", _limits(unread, new), old=unread.commit or None
    )


def _on_new(unread: Unread, old: SideRead) -> UnreadPart:
    return UnreadPart(
        unread.path, unread.reason, unread.carries, "new", _limits(unread, old), new=unread.commit or None
    )


def _limits(unread: Unread, other: SideRead) -> bool:
    """What only one side leaves out limits the verdict where the other has read it: it would look added or removed."""
    return unread.carries and (is_gap(unread) or unread.reason == "submodule" or _holds(other, unread))


def _holds(side: SideRead, unread: Unread) -> bool:
    if unread.reason == "excluded":
        return any(map(Exclusion((unread.path,)).leaves_out, side.paths))
    return unread.path in side.paths or any(path.startswith(f"{unread.path}/") for path in side.paths)
