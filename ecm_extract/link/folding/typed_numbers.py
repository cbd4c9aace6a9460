"""Numbers of C++ where they are read: as the type holds them that the variable, field or function is declared with.

`double rate = 10;`, `std::vector<double> rates{10};`, `double rate() { return 10; }` all give 10.0 to who reads them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.containers import ELEMENT_METHODS, element_type, is_map, is_tuple
from ecm_extract.link.code.numbers import type_of_number
from ecm_extract.link.code.spelling import plain, pointee, template_arguments
from ecm_extract.link.folding.declared_numbers import in_type
from ecm_extract.link.running.env import MAX_DEPTH, Env, invocation_of
from ecm_extract.link.running.values import Value

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PAIR: Final = ("first", "second")
_GET: Final = "std::get"
_OF_OPTIONAL: Final = frozenset({"value", "value_or"})
_PLACES: Final = frozenset({("[]", 2), ("*", 1)})
"""Operators, with the number of their operands, that give a place: an element, what a pointer points to."""


class TypedNumbers:
    """Tells how an expression holds its numbers; the type of each place is looked up once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def held(self, values: tuple[Value, ...], expr: Expr, env: Env) -> tuple[Value, ...]:
        """Return the values of an expression as its type holds them, where they are numbers and it is a place."""
        if env.func.file.language != "cpp" or not _is_typed(expr):
            return values
        if not any(isinstance(value.data, int | float) for value in values):
            return values
        name = self._number(self._type(expr, env), env)
        return in_type(values, name) if name else values

    def _number(self, written: str, env: Env) -> str:
        """The type of numbers that a type as written means, through an alias or a parameter of a template."""
        written = pointee(written) if written else ""
        if not written or "<" in written:
            return ""
        bare, known = plain(written), type_of_number(written)
        return known or type_of_number(env.types.get(bare) or self._aliased(bare, env))

    def _aliased(self, name: str, env: Env) -> str:
        return self.folder.program.alias(name, env.func.file, env.scope) or ""

    def _type(self, expr: Expr, env: Env) -> str:
        if isinstance(expr, Name):
            return self._of_variable(expr, env)
        place = env.before(env.at)
        if isinstance(expr, Member) and expr.name in _PAIR:
            return self._part(self._type(expr.base, place), _PAIR.index(expr.name)) or self._known(expr, env)
        if isinstance(expr, Op) and expr.op == "[]":
            return element_type(self._type(expr.operands[0], place))
        if isinstance(expr, Op):
            return pointee(self._type(expr.operands[0], place))
        return self._returned(expr, place) if isinstance(expr, Call) else self._known(expr, env)

    def _returned(self, call: Call, env: Env) -> str:
        """The type of an element that a method gives, of a part of a tuple, or of what a function of the tree gives."""
        if isinstance(call.callee, Member) and call.callee.name in ELEMENT_METHODS:
            return element_type(self._type(call.callee.base, env))
        if isinstance(call.callee, Member) and call.callee.name in _OF_OPTIONAL:
            return pointee(self._type(call.callee.base, env))
        if call.callee == Name(_GET):
            at = call.types[0] if len(call.args) == len(call.types) == 1 else ""
            return self._part(self._type(call.args[0], env), int(at)) if at.isdecimal() else ""
        callee = self.folder.objects.callee(invocation_of(call, env), env)
        return callee.fact.returns if callee is not None else ""

    def _known(self, expr: Expr, env: Env) -> str:
        return self.folder.objects.type_of(expr, env)

    def _part(self, written: str, at: int) -> str:
        """The type of a part of a pair, a tuple, or an entry of a table."""
        held = template_arguments(written) if is_tuple(written) or is_map(written) else ()
        return held[at] if at < len(held) else ""

    def _of_variable(self, expr: Name, env: Env) -> str:
        """The type of a variable by its declaration that is in sight; of a part of a pair by that of the pair."""
        declared = _declaration(expr, env)
        if declared is None or declared.value is None or "auto" not in declared.type.split():
            return declared.type if declared is not None else self._known(expr, env)
        whole = self._type(declared.value, env.before(env.at)) if not env.depth > MAX_DEPTH else ""
        each = self._entry(whole) if declared.kind == "each" else whole
        return self._part(each, declared.target.items.index(expr)) if isinstance(declared.target, Items) else each

    def _entry(self, written: str) -> str:
        """The type of what a loop over a container gets: of a table a pair."""
        return written if is_map(written) else element_type(written)


def _is_typed(expr: Expr) -> bool:
    """Whether an expression is of a type that something declares."""
    return isinstance(expr, Name | Member | Call) or (isinstance(expr, Op) and (expr.op, len(expr.operands)) in _PLACES)


def _declaration(expr: Name, env: Env) -> Statement | None:
    """The last declaration of a variable before a place that may be in sight there."""
    body = env.func.fact.body
    depth = body[env.at].depth if env.at < len(body) else 0
    for statement in reversed(body[: env.at + 1]):
        if statement.kind in {"let", "each"} and statement.depth <= depth and _binds(statement.target, expr):
            return statement
    return None


def _binds(target: Expr | None, name: Name) -> bool:
    return target == name or (isinstance(target, Items) and name in target.items)
