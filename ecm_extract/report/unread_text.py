"""What was not read, in words: how much for each reason, where, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Final, Protocol

from ecm_extract.report.terminal import one_line
from ecm_extract.tree.unread import REASONS, Reason

MAX_PATHS: Final = 3
"""How many paths are shown for one reason; the JSON document has all."""

_WHAT: Final[Mapping[Reason, str]] = {
    "missing": "file(s) not in this clone",
    "submodule": "submodule(s) not in this clone",
    "too-large": "file(s) larger, deeper or slower to parse than what is read",
    "unreadable": "file(s) or folder(s) without permission, or cut off",
    "malformed": "package.xml that cannot be read as one",
    "unjudged": "file(s) beyond what one run of lint judges",
    "stopped": "rule(s), or file(s) with a function, at which ecm-extract stopped with a fault of its own",
    "unfollowed": "file(s) with code that is not followed to its end",
    "outside": "file(s) that give a node to a function or class which is not in the tree",
    "undecided": "file(s) that call macros of which a build chooses the definition",
    "generated": "source(s) of programs or libraries that a build makes",
    "excluded": "pattern(s) of `exclude` in ecm.toml",
    "ignored": "folder(s) left out by COLCON_IGNORE, CATKIN_IGNORE or AMENT_IGNORE",
    "link": "link(s) that lead out of the tree",
}
_DO: Final[Mapping[Reason, str]] = {
    "missing": "get it with `git fetch --refetch --no-filter origin`",
    "submodule": "get them with `git submodule update --init --recursive`",
    "too-large": "split it, or leave it out on purpose with `exclude` in ecm.toml",
    "unreadable": "check the permissions and run again",
    "malformed": "correct it",
    "unjudged": "lint the packages one by one",
    "stopped": "report it, with what ECM_DEBUG=1 prints",
    "unfollowed": "the summary has its lines, and what to do about each",
    "outside": "read its package as well, or add a row for it to ecm.toml",
}


class Told(Protocol):
    """What is told of something that was not read, of one tree or of a comparison."""

    @property
    def path(self) -> str:
        """Where."""

    @property
    def reason(self) -> Reason:
        """Why."""


def unread_lines(unread: Iterable[Told]) -> list[str]:
    """Return one line for each reason, in the order of the reasons."""
    grouped: dict[Reason, list[str]] = {}
    for each in unread:
        grouped.setdefault(each.reason, []).append(_shown(each))
    return [_line(reason, grouped[reason]) for reason in REASONS if reason in grouped]


def _line(reason: Reason, paths: Sequence[str]) -> str:
    more = f" and {len(paths) - MAX_PATHS} more" if len(paths) > MAX_PATHS else ""
    do = f"; {_DO[reason]}" if reason in _DO else ""
    return one_line(f"{len(paths)} {_WHAT[reason]}: {', '.join(paths[:MAX_PATHS])}{more}{do}", 600)


def _shown(each: Told) -> str:
    """The path; of a submodule also where it moves from and to."""
    old, new = getattr(each, "old", None), getattr(each, "new", None)
    moves = f" ({(old or 'none')[:12]} to {(new or 'none')[:12]})" if old != new else ""
    return f"{each.path}{moves}"
