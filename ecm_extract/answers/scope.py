"""Which runs can find a finding again: only those may say that an answer to it matches nothing."""

from __future__ import annotations

from typing import Final, Literal

Scope = Literal["tree", "change", "check"]
"""Found in a tree by itself, in the change between two trees, or by the checker over contracts."""

CHANGE_RULES: Final = frozenset({"VER001", "LNT019"})
"""Both tell of one change of an interface: what it breaks, and where it is made."""

_BETWEEN_TREES: Final = CHANGE_RULES | {"LNT030"}


def scope_of(rule: str) -> Scope:
    """Return the runs that a rule belongs to."""
    if rule in _BETWEEN_TREES:
        return "change"
    return "tree" if rule.startswith("LNT") else "check"
