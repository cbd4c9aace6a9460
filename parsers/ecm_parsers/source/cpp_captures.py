"""What lambdas of C++ capture by an initial value: `[pub = create(node)](const M & m) { pub->publish(m); }`."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from tree_sitter import Node


class Capture(NamedTuple):
    """A capture with its name and the expression that is evaluated when the lambda is made."""

    name: str
    value: Node


def initial_captures(node: Node) -> list[Capture]:
    """Return the captures of a lambda expression that have an initial value."""
    listed = node.child_by_field_name("captures")
    entries = listed.named_children if listed is not None else []
    found = [(each.child_by_field_name("left"), each.child_by_field_name("right")) for each in entries]
    return [
        Capture((left.text or b"").decode(errors="replace"), right)
        for left, right in found
        if left is not None and right is not None
    ]
