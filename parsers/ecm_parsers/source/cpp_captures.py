"""What lambdas of C++ capture by an initial value: `[pub = create(node)](const M & m) { pub->publish(m); }`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import msgspec

from ecm_parsers.source.expr import Name
from ecm_parsers.source.facts import Function

if TYPE_CHECKING:
    from tree_sitter import Node


class Capture(NamedTuple):
    """A capture with its name, the expression that is evaluated when the lambda is made, and if it refers to that."""

    name: str
    value: Node
    shares: bool


def initial_captures(node: Node) -> list[Capture]:
    """Return the captures of a lambda expression that have an initial value."""
    listed = node.child_by_field_name("captures")
    return [found for entry in (listed.named_children if listed is not None else []) for found in _initial(entry)]


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
    return [_renamed(function, names) for function in functions] if names else functions


def _declared(function: Function) -> Iterator[str]:
    yield from (parameter.name for parameter in function.params)
    for statement in function.body:
        if statement.kind in {"let", "each"} and isinstance(statement.target, Name):
            yield statement.target.id


def _renamed(part: Any, names: Mapping[str, str]) -> Any:
    """The same facts with other names of variables."""
    if isinstance(part, Name):
        return Name(names[part.id]) if part.id in names else part
    if isinstance(part, tuple):
        return tuple([_renamed(each, names) for each in part])
    if not isinstance(part, msgspec.Struct):
        return part
    given = [(each, getattr(part, each)) for each in part.__struct_fields__]
    return msgspec.structs.replace(part, **{each: _renamed(value, names) for each, value in given})
