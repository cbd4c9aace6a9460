"""What of a tree was not read: one record for every reason, so that no result can pass for a whole one."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final, Literal, get_args

import msgspec
from ecm_checker.wire import GAP_REASONS, NotRead

from ecm_extract.source_suffixes import CPP

Reason = Literal[
    "missing",
    "submodule",
    "too-large",
    "unreadable",
    "malformed",
    "unjudged",
    "stopped",
    "unfollowed",
    "outside",
    "undecided",
    "generated",
    "excluded",
    "ignored",
    "link",
]
"""Why something was not read: not in this clone (content, submodule), above a bound, no permission, no well-formed
manifest; beyond the number that one run judges; a fault of this program at it; more steps than are followed; a node
that code gets which is not in the tree; code that a build chooses, or makes; left out because the project asks for it
(`exclude`, a marker); a link that leads out of the tree."""

REASONS: Final[tuple[Reason, ...]] = get_args(Reason)
ON_PURPOSE: Final[frozenset[Reason]] = frozenset({"excluded", "ignored", "link"})
"""Reasons that the project itself has given."""

_DECLARING: Final = (
    *(".msg", ".srv", ".action", ".idl", ".xml", ".yaml", ".yml", ".cfg", ".launch", ".test"),
    *(".urdf", ".xacro", ".srdf", ".cmake", "CMakeLists.txt", "setup.cfg", "pyproject.toml", "ecm.toml"),
    *sorted(CPP),
    ".py",
)


class Unread(msgspec.Struct, frozen=True):
    """Something of one tree that was not read.

    Attributes:
        path: of the file or folder, relative to the root of the tree, printable; of `excluded` the pattern.
        reason: why.
        carries: whether it can declare or use interfaces.
        commit: of a submodule, the commit that the tree names; else empty.
    """

    path: str
    reason: Reason
    carries: bool = True
    commit: str = ""


def can_declare(path: str) -> bool:
    """Whether a file can declare or use interfaces, by its name; one without a suffix may be a script."""
    return path.endswith(_DECLARING) or "." not in path.rpartition("/")[2]


def is_gap(unread: Unread) -> bool:
    """Whether a result of this tree alone says less than the whole because of it."""
    return unread.carries and unread.reason in GAP_REASONS


def not_read(rows: Iterable[Unread]) -> tuple[NotRead, ...]:
    """Return what was not read of a tree as documents say it."""
    return tuple(msgspec.convert(each, NotRead, from_attributes=True) for each in rows)


def unread_in(rows: Iterable[NotRead]) -> tuple[Unread, ...]:
    """Return what a document says was not read."""
    return tuple(msgspec.convert(each, Unread, from_attributes=True) for each in rows)
