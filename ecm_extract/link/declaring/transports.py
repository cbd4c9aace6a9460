"""Subscriptions whose topic depends on a transport: see transports.toml."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Opaque, Text
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.texts import written_type
from ecm_extract.link.code.walk import last_of
from ecm_extract.link.declaring.forms import Form
from ecm_extract.link.declaring.match import name_argument, positions
from ecm_extract.shipped import shipped

HINTS: Final = "hints"
"""In the column `transport` of a form: an object among the arguments tells the transport."""
_OPEN: Final = Opaque("transport")
_PRIVATE: Final = Call(Name("ros::NodeHandle"), (Text("~"),))


@cache
def _table() -> Mapping[str, Any]:
    return shipped("link/declaring/transports.toml")


def transported(call: Invocation, form: Form) -> tuple[Invocation, Form]:
    """Return a call of a form with the topic of its transport as name, and the form with the type of that."""
    name = name_argument(form, call) if form.transport else None
    given = _transport(call, form) if name is not None else None
    if name is None or given is None or given == Text(_table()["plain"]):
        return call, form
    asked = given.args[-1] if isinstance(given, Call) and given.args else given  # a parameter, with its default
    kind = _table()["types"].get(asked.value, "") if isinstance(asked, Text) else ""
    args = [Op("+", (arg, _behind(given))) if arg is name else arg for arg in call.args]
    return replace(call, args=tuple(args)), replace(form, type=kind)


def _behind(transport: Expr) -> Expr:
    """What stands behind the name of the plain topic; of a choice on each side what it is there."""
    if isinstance(transport, Op) and transport.op == "?:":
        test, *sides = transport.operands
        return Op("?:", (test, *map(_behind, sides)))
    if transport == Text(_table()["plain"]):
        return Text("")
    below = Op("+", (Text("/"), transport))
    is_plain = Op("==", (transport, Text(_table()["plain"])))
    return below if isinstance(transport, Text) else Op("?:", (is_plain, Text(""), below))


def _transport(call: Invocation, form: Form) -> Expr | None:
    """The transport that a call gives; None where it gives none."""
    if form.transport == HINTS:
        found = (_hints(arg, call) for arg in call.args)
        return next((each for each in found if each is not None), None)
    given = next(positions(form.transport, call), None)
    asked = given.callee if isinstance(given, Call) else None
    is_of_hints = isinstance(asked, Member) and asked.name in _table()["hints"]["asking"]
    return _hints(asked.base, call) if is_of_hints and isinstance(asked, Member) else given


def _hints(arg: Expr, call: Invocation) -> Expr | None:
    """The parameter that an object reads which tells a transport; None of other arguments."""
    given = arg.operands[0] if isinstance(arg, Op) and arg.op == "&" else arg
    if isinstance(given, Call):
        return _read(given, call) if last_of(given.callee) == _table()["hints"]["class"] else None
    if last_name(plain(written_type(given, call.func))) != _table()["hints"]["class"]:
        return None
    made = [each for each in call.func.fact.body if each.target == given]
    if len(made) != 1 or made[0].kind != "let":
        return _OPEN
    value = made[0].value or Call(Name(_table()["hints"]["class"]), ())
    return _read(value, call) if isinstance(value, Call) else _OPEN


def _read(hints: Call, call: Invocation) -> Expr:
    """The read of the parameter that an object is made for."""
    places = _table()["hints"][f"ros{call.func.file.ros or 1}"]
    given = dict(enumerate(hints.args))
    default = given.get(places["default"], Text(_table()["plain"]))
    named = given.get(places["parameter"], Text(_table()["hints"]["parameter"]))
    node = given.get(places["node"], _PRIVATE if call.func.file.ros == 1 else THIS)
    return Call(Member(node, places["method"]), (named, default), (), ("std::string",), call.line)
