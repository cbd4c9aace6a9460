"""Algorithms of C++ that call a lambda once for each element are loops: `std::for_each(begin(a), end(a), [](T x) { })`.

Source: [alg.foreach], [alg.transform] of the C++ standard; boost/range/algorithm/for_each.hpp.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.cpp_lambdas import lambda_parameters, lambda_traits
from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Parameter

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_FOR_EACH: Final = frozenset({"std::for_each", "std::ranges::for_each", "boost::for_each", "boost::range::for_each"})
_TRANSFORM: Final = "std::transform"
_INSERTER: Final = frozenset({"std::back_inserter", "back_inserter"})
_ENDS: Final = ({"begin", "cbegin"}, {"end", "cend"})
_LOOPS: Final = frozenset({"for_statement", "for_range_loop", "while_statement", "do_statement"})


class Rounds(NamedTuple):
    """What a statement does for each element of `over`: `body` with it in `each`; what that returns is put `into`."""

    over: Expr
    each: Parameter
    body: Node
    into: Expr | None


def rounds_of(reader: ExprReader, statement: Node) -> Rounds | None:
    """Return the rounds of a statement that is such a call; None of others, and of a lambda that keeps own copies."""
    function = statement.child_by_field_name("function") if statement.type == "call_expression" else None
    listed = statement.child_by_field_name("arguments")
    name = reader.name(function) if function is not None else ""
    if listed is None or name not in {*_FOR_EACH, _TRANSFORM}:
        return None
    *given, last = [child for child in listed.named_children if child.type != "comment"] or [listed]
    body, params = last.child_by_field_name("body"), lambda_parameters(reader, last) if given else ()
    if last.type != "lambda_expression" or body is None or len(params) != 1 or not _is_plain(last, body):
        return None
    into = _inserted(reader.read(given[2])) if name == _TRANSFORM and len(given) == 3 else None
    expected = 1 if len(given) == 1 else 3 if name == _TRANSFORM else 2
    over = _elements(reader, given) if len(given) == expected and (into is not None or name != _TRANSFORM) else None
    return Rounds(over, params[0], body, into) if over is not None else None


def _elements(reader: ExprReader, given: list[Node]) -> Expr | None:
    """What the iterators are the ends of, or the range itself."""
    if len(given) == 1:
        return reader.read(given[0])
    first, last = (_container(reader.read(each), ends) for each, ends in zip(given, _ENDS, strict=False))
    return first if first == last else None


def _container(expr: Expr, ends: set[str]) -> Expr | None:
    """What an iterator is an end of: `names.begin()`, `std::begin(names)`."""
    if not isinstance(expr, Call):
        return None
    if isinstance(expr.callee, Member):
        return expr.callee.base if expr.callee.name in ends and not expr.args else None
    free = isinstance(expr.callee, Name) and expr.callee.id.removeprefix("std::") in ends
    return expr.args[0] if free and len(expr.args) == 1 else None


def _inserted(expr: Expr) -> Expr | None:
    """The container that results are put at the end of."""
    inserts = isinstance(expr, Call) and isinstance(expr.callee, Name) and expr.callee.id in _INSERTER
    return expr.args[0] if isinstance(expr, Call) and inserts and len(expr.args) == 1 else None


def _is_plain(made: Node, body: Node) -> bool:
    """Whether a lambda has no variables of its own between calls, and returns from no loop within it."""
    listed = made.child_by_field_name("captures")
    own = listed is not None and any(each.type == "lambda_capture_initializer" for each in listed.named_children)
    return not own and "mutable" not in lambda_traits(made) and not any(_returns_in_loops(body, False))


def _returns_in_loops(node: Node, looped: bool) -> Iterator[bool]:
    if node.type == "return_statement" and looped:
        yield True
    for child in node.named_children if node.type != "lambda_expression" else ():
        yield from _returns_in_loops(child, looped or child.type in _LOOPS)
