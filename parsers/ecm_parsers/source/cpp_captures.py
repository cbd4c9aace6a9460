"""What lambdas of C++ capture by a value of their own: `[pub = create(node)](const M & m) { pub->publish(m); }`.

A copy of a variable is one where the variable is assigned behind the lambda: `[name]` has what it was before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ecm_parsers.source.expr import Name
from ecm_parsers.source.facts import Function
from ecm_parsers.source.rewriting import rewritten

if TYPE_CHECKING:
    from tree_sitter import Node


_FUNCTIONS = frozenset({"function_definition", "lambda_expression"})
_DECLARING = frozenset({"reference_declarator", "pointer_declarator", "structured_binding_declarator"})
_ASSIGNED = {"assignment_expression": "left", "update_expression": "argument"}


class Capture(NamedTuple):
    """A capture with its name, the expression that is evaluated when the lambda is made, and if it refers to that."""

    name: str
    value: Node
    shares: bool


class _Around(NamedTuple):
    """What a function declares, and where each variable is assigned for the last time."""

    declared: frozenset[bytes]
    assigned: Mapping[bytes, int]


class Captures:
    """Finds what lambdas of one function capture; the functions around them are looked through once."""

    def __init__(self) -> None:
        self._around: dict[tuple[int, int], _Around] = {}

    def of(self, node: Node) -> list[Capture]:
        """Return the captures of a lambda expression that have a value of their own."""
        listed = node.child_by_field_name("captures")
        entries = listed.named_children if listed is not None else []
        return [found for entry in entries for found in (*_initial(entry), *self._copied(entry, node))]

    def _copied(self, entry: Node, made: Node) -> Iterator[Capture]:
        """Variables that are captured by copy, and assigned behind the lambda in the body around it."""
        named: Sequence[Node] = ()
        around = self._of_function(made)
        if entry.type == "lambda_default_capture" and entry.text == b"=":
            named = [name for name in _used(made) if name.text in around.declared]
        elif entry.type == "identifier" and (entry.prev_sibling is None or entry.prev_sibling.type != "&"):
            named = [entry]
        behind = [each for each in named if around.assigned.get(each.text or b"", 0) > made.end_byte]
        found = {each.text or b"": each for each in reversed(behind)}
        yield from (Capture(name.decode(errors="replace"), each, False) for name, each in found.items())

    def _of_function(self, made: Node) -> _Around:
        around = made.parent
        while around is not None and around.type not in _FUNCTIONS:
            around = around.parent
        if around is None:
            return _Around(frozenset(), {})
        place = (around.start_byte, around.end_byte)
        if place not in self._around:
            self._around[place] = _looked_through(around)
        return self._around[place]


def _looked_through(function: Node) -> _Around:
    declared: set[bytes] = set()
    assigned: dict[bytes, int] = {}
    for node in _within(function):
        if node.type == "identifier" and node.text is not None and _is_declared(node):
            declared.add(node.text)
        target = node.child_by_field_name(_ASSIGNED[node.type]) if node.type in _ASSIGNED else None
        if target is not None and target.type == "identifier" and target.text is not None:
            assigned[target.text] = max(assigned.get(target.text, 0), node.end_byte)
    return _Around(frozenset(declared), assigned)


def _used(made: Node) -> list[Node]:
    """The names in a lambda's body, without those that it captures by name."""
    listed, body = made.child_by_field_name("captures"), made.child_by_field_name("body")
    own = {name.text for name in _within(listed) if name.type == "identifier"} if listed is not None else set()
    names = (each for each in _within(body) if each.type == "identifier") if body is not None else ()
    return [name for name in names if name.text not in own]


def _is_declared(name: Node) -> bool:
    """Whether an identifier is what a declaration gives its name to."""
    parent = name.parent
    return parent is not None and (parent.type in _DECLARING or parent.child_by_field_name("declarator") == name)


def _within(node: Node) -> Iterator[Node]:
    """A node and all within it, in their order."""
    pending = [node]
    while pending:
        each = pending.pop()
        yield each
        pending += reversed(each.named_children)


def _initial(entry: Node) -> Iterator[Capture]:
    left, right = entry.child_by_field_name("left"), entry.child_by_field_name("right")
    if left is not None and right is not None:
        yield Capture((left.text or b"").decode(errors="replace"), right, entry.children[0].type == "&")


def capturing(functions: Sequence[Function], held: Mapping[str, str]) -> Sequence[Function]:
    """Return a lambda, and those within it, that call what it captures as the function around it does.

    Args:
        functions: the lambda and those within it.
        held: the names of its captures -> those of the variables that hold them; what hides one is left alone.
    """
    hidden = {name for function in functions for name in _declared(function)}
    names = {name: variable for name, variable in held.items() if name not in hidden}
    if not names:
        return functions
    return [rewritten(each, lambda part: _renamed(part, names)) for each in functions]


def _renamed(part: Any, names: Mapping[str, str]) -> Name | None:
    return Name(names[part.id]) if isinstance(part, Name) and part.id in names else None


def _declared(function: Function) -> Iterator[str]:
    yield from (parameter.name for parameter in function.params)
    for statement in function.body:
        if statement.kind in {"let", "each"} and isinstance(statement.target, Name):
            yield statement.target.id
