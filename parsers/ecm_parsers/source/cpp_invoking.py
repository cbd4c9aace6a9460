"""What calls of C++ call with arguments of theirs: `std::thread(&Node::run, this, "x")` calls `run("x")`.

Source: [func.require] of the C++ standard: who has a pointer to a method calls it on the first argument. One that is
given nothing but an object and placeholders is a callback, of which others know what it gets.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Final

import msgspec

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Number, Op

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_ANY: Final = "*"
"""Stands for whatever is before a function, one argument."""
_OWN = frozenset({"shared_from_this", "weak_from_this"})
"""Methods that give the object at hand; en.cppreference.com, std::enable_shared_from_this."""


class _Names(msgspec.Struct, frozen=True):
    names: frozenset[str]


class _Table(msgspec.Struct, frozen=True):
    """What is known of such calls; see cpp_invoking.toml."""

    calling: Mapping[str, Sequence[str]]
    running: _Names
    emplacing: _Names
    making: _Names
    placeholders: _Names
    referring: _Names


@cache
def _table() -> _Table:
    text = (files("ecm_parsers") / "source" / "cpp_invoking.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


def gets_values(reader: ExprReader, made: Node) -> bool:
    """Tell whether a lambda stands in a call that calls it with further arguments of its own."""
    listed = made.parent
    if listed is None or listed.type not in {"argument_list", "initializer_list"}:
        return False
    args = [child for child in listed.named_children if child.type != "comment"]
    at = args.index(made)
    if all(_is_named_placeholder(reader.text(each)) for each in args[at + 1 :]):
        return False
    before = _before(*_maker(reader, listed))
    return before is not None and all(_is_before(reader.text(each), before) for each in args[:at])


def _maker(reader: ExprReader, listed: Node) -> tuple[str, Sequence[str]]:
    """What is called with a list of arguments, or is made of it, with its template arguments."""
    around = listed.parent
    declared = around.parent if around is not None and around.type == "init_declarator" else around
    fields = ("function", "type")
    callee = next(filter(None, map(declared.child_by_field_name, fields)), None) if declared is not None else None
    return (reader.name(callee), reader.template_arguments(callee)) if callee is not None else ("", ())


def invoked(call: Call) -> Call | None:
    """Return what a call calls, or makes somebody call, with values that it gives; None of others."""
    args = _from_function(call)
    return _called(args[0], args[1:], call.line) if len(args) > 1 else None


def invoked_by_element(call: Call) -> Call | None:
    """Return what an element of a container calls that a call makes, if it is of such a type; None of other calls."""
    callee = call.callee
    if not isinstance(callee, Member) or not makes_element(callee):
        return None
    return perhaps_invoked(Op("[]", (callee.base, Number(0))), call.args, call.line)


PERHAPS: Final = Name("<where it runs>")
"""Is called with an object, and with what that calls if it is one of a type that runs what it is made with."""


def runs_function(written: str) -> bool:
    """Tell whether an object of a type calls the function that it is made with."""
    return written in _table().running.names


def makes_element(callee: Expr) -> bool:
    """Tell whether a method makes an element of a container of what it is given."""
    return isinstance(callee, Member) and callee.name in _table().emplacing.names


def perhaps_invoked(made: Expr, args: Sequence[Expr], line: int) -> Call | None:
    """Return what an object calls that is made with a function by its address, where only the tree tells its type."""
    address = args[0] if len(args) > 1 else None
    is_address = isinstance(address, Op) and address.op == "&"
    called = _called(address, tuple(args[1:]), line) if address is not None and is_address else None
    return Call(PERHAPS, (made, called, address), (), (), line) if called is not None and address else None


def called_by(call: Call) -> Expr | None:
    """Return the argument of a call that `invoked` tells the call of; None of others."""
    return _from_function(call)[0] if invoked(call) is not None else None


def _from_function(call: Call) -> tuple[Expr, ...]:
    """The function that a call calls, and what it gives that; nothing of calls that call none."""
    before = _before(call.callee.id, call.types) if isinstance(call.callee, Name) else None
    args = call.args if before is not None else ()
    if before == [_ANY]:
        return args[1:]
    while before and args and isinstance(args[0], Name) and _is_before(args[0].id, before):
        args = args[1:]
    return args


def with_copies(call: Call, mark: str) -> tuple[Call, Mapping[str, Expr]]:
    """Return such a call as its function runs it, and what it has copies of, by the names of these.

    Args:
        call: the call.
        mark: begins those names.
    """
    if call.callee == PERHAPS and isinstance(call.args[1], Call):
        called, copies = with_copies(call.args[1], mark)
        return msgspec.structs.replace(call, args=(call.args[0], called, call.args[2])), copies
    copied = {f"{mark}::{arg.id}": arg for arg in call.args if isinstance(arg, Name) and _is_copied(arg)}
    return msgspec.structs.replace(call, args=tuple([_given(arg, mark) for arg in call.args])), copied


def _given(arg: Expr, mark: str) -> Expr:
    """What a function gets: a copy of a variable, or what a reference refers to."""
    if isinstance(arg, Call) and _refers(arg):
        return arg.args[0]
    return Name(f"{mark}::{arg.id}") if isinstance(arg, Name) and _is_copied(arg) else arg


def _is_copied(name: Name) -> bool:
    return name != THIS and "::" not in name.id and not _is_placeholder(name)


def _refers(call: Call) -> bool:
    referring = _table().referring.names
    return isinstance(call.callee, Name) and call.callee.id in referring and len(call.args) == 1


def _before(callee: str, types: Sequence[str]) -> Sequence[str] | None:
    """What may stand before the function that a call calls; None of calls that call none."""
    made = types[0] if callee in _table().making.names and types else callee
    return _table().calling.get(made)


def _is_before(written: str, before: Sequence[str]) -> bool:
    return any(name == _ANY or written.startswith(f"{name}::") for name in before)


def _called(function: Expr, args: tuple[Expr, ...], line: int) -> Call | None:
    is_address = isinstance(function, Op) and function.op == "&"
    pointed = function.operands[0] if isinstance(function, Op) and is_address else function
    if not isinstance(pointed, Name):
        return None
    owner = _object(args[0]) if is_address and "::" in pointed.id else None
    given = args if owner is None else args[1:]
    callee = pointed if owner is None else Op("->*", (owner, pointed))
    return Call(callee, given, (), (), line) if not all(map(_is_placeholder, given)) else None


def _object(expr: Expr) -> Expr | None:
    """What a method is called on that is certainly an object: the one at hand, or what there is an address of."""
    if isinstance(expr, Op) and expr.op == "&" and len(expr.operands) == 1:
        return expr.operands[0]
    callee = expr.callee if isinstance(expr, Call) and not expr.args else None
    name = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
    return THIS if expr == THIS or name in _OWN else None


def _is_placeholder(expr: Expr) -> bool:
    return isinstance(expr, Name) and _is_named_placeholder(expr.id)


def _is_named_placeholder(name: str) -> bool:
    return name.rpartition("::")[2] in _table().placeholders.names
