"""Objects that a function makes behind a pointer, and that nobody else has: it only reads and assigns their fields."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass
from typing import Final

from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children
from ecm_extract.shipped import shipped_names

_TABLE: Final = "link/code/library_values.toml"
_POINTERS: Final = shipped_names(_TABLE, "pointers")
_ALLOCATED: Final = shipped_names(_TABLE, "allocated")
_ASKING: Final = frozenset({"!", "&&", "||", "==", "!="})
_NULL: Final = (Constant("null"), Name("NULL"))


def pointed(expr: Expr) -> str:
    """Return the class of the object that an expression makes behind a pointer; empty for others."""
    made = expr.callee if isinstance(expr, Call) and expr.types else None
    is_made = isinstance(made, Name) and makes_pointed(last_name(made.id))
    return expr.types[0] if is_made and isinstance(expr, Call) else ""


def is_null(expr: Expr | None) -> bool:
    """Tell whether an expression is what a pointer is given that is no object."""
    return expr in _NULL


def makes_pointed(last: str) -> bool:
    """Tell whether a function of a last name makes an object behind a pointer."""
    return last in _POINTERS or last in _ALLOCATED


def given_to_pointed(last: str, args: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return what such a function gives the constructor of the object, which is all but an allocator."""
    return args[1:] if last in _ALLOCATED else args


def is_only_reached_into(name: str, func: Func, is_followed: Callable[[Call], bool]) -> bool:
    """Tell whether a function does nothing with a pointer, and its copies, but reach into what it points to.

    Args:
        name: the variable that the pointer was made for.
        func: the function.
        is_followed: tells whether a call on what it points to is one of a method whose changes are followed.
    """
    body = func.fact.body
    copies = {entry.target.id for entry in body if _copies(name, entry) and isinstance(entry.target, Name)}
    reaching = _Reaching(frozenset({name, *copies}), is_followed)
    return not any(reaching.gives(each, statement) for each in (name, *copies) for statement in body)


def _copies(name: str, statement: Statement) -> bool:
    """Whether a statement declares another pointer to the same object."""
    return statement.kind == "let" and statement.value == Name(name) and not statement.type.endswith("&")


@dataclass(frozen=True, slots=True)
class _Reaching:
    """What a function does with the pointers to one object."""

    names: Set[str]
    is_followed: Callable[[Call], bool]

    def gives(self, name: str, statement: Statement) -> bool:
        """Tell whether a statement does anything else with a pointer than to reach into what it points to."""
        made = isinstance(statement.value, Call) and bool(pointed(statement.value))
        copied = self._is_one(statement.value)
        if statement.target == Name(name):
            alone = len(self.names) == 1  # of several one would point to another object from then on
            begun = statement.kind == "let" and (made or copied or statement.value is None)
            return not (begun or (made and alone and not statement.type))
        if copied and self._is_one(statement.target):
            return False
        return self._gives(name, statement)

    def _is_one(self, expr: Expr | None) -> bool:
        return isinstance(expr, Name) and expr.id in self.names

    def _gives(self, name: str, statement: Statement) -> bool:
        refers = statement.kind in {"let", "each"} and statement.type.endswith(("&", "*"))
        reached = any(_is_field(part, name) for part in _parts(statement.value)) if refers else False
        return reached or any(
            self._is_given(part, name) for expr in (statement.target, statement.value) for part in _parts(expr)
        )

    def _is_given(self, part: Expr, name: str) -> bool:
        """Whether the pointer stands alone, an unknown method is called on it, or the address of a field is taken."""
        if isinstance(part, Call):
            return _is_field(part.callee, name) and not self.is_followed(part)
        taken = isinstance(part, Op) and part.op == "&" and len(part.operands) == 1
        return part == Name(name) or (taken and isinstance(part, Op) and _is_field(part.operands[0], name))


def _parts(expr: Expr | None) -> Iterator[Expr]:
    """Yield an expression and all in it, but not a pointer in front of a field, or that is asked for an object."""
    if expr is None:
        return
    yield expr
    for at, part in enumerate(children(expr)):
        if not (isinstance(part, Name) and (isinstance(expr, Member) or _asks(expr, at))):
            yield from _parts(part)


def _asks(expr: Expr, at: int) -> bool:
    """Whether an operation asks no more of one of its operands than whether it points to an object."""
    return isinstance(expr, Op) and (expr.op in _ASKING or (expr.op == "?:" and at == 0))


def _is_field(expr: Expr, name: str) -> bool:
    return isinstance(expr, Member) and expr.base == Name(name)
