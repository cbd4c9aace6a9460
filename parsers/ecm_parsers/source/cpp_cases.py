"""The cases of a `switch` of C++, each with all that is written up to the next one.

A declaration of a name (`using a::b;`), and what follows it, stands beside the case in the tree, and so does what a
macro decides: `#ifdef X` around cases.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tree_sitter import Node

_CASE = "case_statement"
_ATTRIBUTED = "attributed_statement"
_MACROS = frozenset({"preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef"})


@dataclass(slots=True)
class CaseNodes:
    """One case: its value, None for the default, and its statements."""

    value: Node | None
    statements: list[Node] = field(default_factory=list)


def cases_of(body: Node) -> list[CaseNodes]:
    """Return the cases in the block of a `switch`."""
    found: list[CaseNodes] = []
    for node in _parts(body):
        if node.type == _CASE:
            value = node.child_by_field_name("value")
            found.append(CaseNodes(value, [child for child in node.named_children if child != value]))
        elif found:
            found[-1].statements.append(node)
    return found


def _parts(block: Node) -> Iterator[Node]:
    """The cases of a block and what stands beside them, on whatever side of a macro."""
    asked = (block.child_by_field_name("name"), block.child_by_field_name("condition"))
    for node in block.named_children:
        if node.type in _MACROS and any(part.type == _CASE for part in _parts(node)):
            yield from _parts(node)
        elif node.type == _ATTRIBUTED and node.named_children[-1].type == _CASE:
            yield node.named_children[-1]
        elif node not in asked:
            yield node
