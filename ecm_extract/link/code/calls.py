"""Calls as the forms see them: a path, a receiver, arguments; object constructions in one shape."""

from __future__ import annotations

from collections.abc import Container, Iterator
from itertools import takewhile
from typing import Final, NamedTuple

import msgspec
from ecm_parsers.source.expr import (
    THIS,
    Call,
    Expr,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Text,
)
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.left_alone import SPREAD, is_spread
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.pointed import given_to_pointed, makes_pointed
from ecm_extract.link.code.spelling import (
    by_value,
    is_node_interface,
    last_name,
    plain,
    pointee,
    template_arguments,
)
from ecm_extract.link.code.units import Func


class Step(NamedTuple):
    """One statement of a function, and where in its body it stands: at its end what no body has."""

    func: Func
    at: int
    statement: Statement


class Invocation(msgspec.Struct, frozen=True, eq=False):
    """One call in one function; two that are written alike are two.

    Attributes:
        at: index of its statement in the body of the function; the length of the body for what stands in none.
        path: what is called, as written and with Python imports resolved; the class for a construction.
        receiver: the object whose method is called; None for functions, constructions and implicit `this`.
        types: template arguments, as written.
        made: whether the call certainly constructs an object (`new`, `make_shared`, declaration, initialiser).
    """

    func: Func
    at: int
    statement: Statement
    path: str
    receiver: Expr | None
    args: tuple[Expr, ...]
    keywords: tuple[tuple[str, Expr], ...]
    types: tuple[str, ...]
    line: int
    made: bool = False

    @property
    def last(self) -> str:
        """Last part of the path."""
        return last_name(self.path)

    @property
    def simple(self) -> bool:
        """Whether it is a bare name: an implicit method of `this`, or a function in scope."""
        return self.receiver is None and "::" not in self.path and "." not in self.path


def invocations(func: Func, wanted: Container[str] | None = None) -> Iterator[Invocation]:
    """Yield the calls of a function's body, inner calls first, constructions by initialiser included.

    Args:
        func: the function.
        wanted: only calls whose last name is in it; None for all.
    """
    for at, (statement, calls) in enumerate(zip(func.fact.body, func.calls, strict=True)):
        for call in calls:
            if wanted is None or _last_of(call, func) in wanted:
                yield invocation(Step(func, at, statement), call)
        if statement.value is None and statement.kind == "let" and by_value(statement.type):
            yield construction(Step(func, at, statement), statement.type, (), statement.line)
        implied = _implied(Step(func, at, statement)) if statement.kind == "init" else None
        if implied is not None:
            yield implied


def _last_of(call: Call, func: Func) -> str:
    """The last name of a call, without building its path; of an imported name that of what it stands for."""
    callee = func.meant(call).callee
    name = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
    if isinstance(callee, Name) and name in func.file.imported:
        return last_name(func.file.imported[name])
    last = name.rsplit("::", 1)[-1]
    if not makes_pointed(last):
        return last
    owner = call.types[0] if call.types else name.rsplit("::", 1)[0]
    return last_name(plain(owner))


def invocation(step: Step, call: Call) -> Invocation:
    """Return a call as the forms see it."""
    func, _, statement = step
    if func.file.language == "python":
        return _python(step, call)
    callee = call.callee
    args = one_node(func, call.args)
    if isinstance(callee, Member):
        return Invocation(*step, callee.name, callee.base, args, call.keywords, call.types, call.line)
    path = callee.id if isinstance(callee, Name) else ""
    last = path.rsplit("::", 1)[-1]
    if makes_pointed(last) and call.types:
        return construction(step, call.types[0], one_node(func, given_to_pointed(last, call.args)), call.line)
    if last == "make_shared" and "::" in path and path not in {"std::make_shared", "boost::make_shared"}:
        return Invocation(*step, path.rsplit("::", 1)[0], None, args, (), call.types, call.line, True)
    made = statement.kind == "let" and statement.value is call and plain(statement.type) == path
    return Invocation(*step, path, None, args, call.keywords, call.types, call.line, made)


def spreads(call: Invocation) -> bool:
    """Tell whether a call gives more arguments than are written there, or fewer."""
    if call.func.file.language != "python":
        return False
    return any(map(is_spread, call.args)) or any(name == SPREAD for name, _ in call.keywords)


_NODE: Final = "node"
"""Operator of several interfaces of a node that a call gives in the place of one."""
PLACEHOLDER: Final = "*"
"""Begins the names of arguments that stand for others; no variable has such a name."""


def placed_arguments(call: Invocation) -> tuple[Expr, ...]:
    """Return the arguments whose place among all that a call gives is known."""
    if not spreads(call):
        return call.args
    return tuple(takewhile(lambda arg: not is_spread(arg), call.args))


def unseen_argument(call: Invocation, by_name: bool) -> Expr | None:
    """Return what stands for arguments that a call spreads and that nothing shows; None where it spreads none.

    That of callers is a name; of others nothing is known.
    """
    if not spreads(call):
        return None
    placed = [arg.operands[0] for arg in call.args if isinstance(arg, Op) and is_spread(arg)]
    named = [value for name, value in call.keywords if name == SPREAD]
    found = next(iter([*named, *placed] if by_name else [*placed, *named]), None)
    return found if isinstance(found, Name) and found.id.startswith(PLACEHOLDER) else Opaque(SPREAD)


def one_node(func: Func, args: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Read several node interfaces in front as the one node that they stand for, like `Func.params`."""
    count = 0
    while count < len(args) and _is_interface(func, args[count]):
        count += 1
    return args if count < 2 else (node_of(args[:count]), *args[count:])


def node_of(interfaces: tuple[Expr, ...]) -> Expr:
    """Return the node that some interfaces stand for."""
    return Op(_NODE, interfaces)


def taken_by(func: Func, call: Invocation) -> tuple[Expr, ...]:
    """Return the arguments of a call as a function takes them: interfaces of a node as the node, where it says so."""
    first, merged = next(iter(call.args), None), len(func.fact.params) - len(func.params)
    if isinstance(first, Op) and first.op == _NODE:
        return call.args if merged else (*first.operands, *call.args[1:])
    if not merged or len(call.args) <= merged or gives_others(func, call):
        return call.args
    return (node_of(call.args[: merged + 1]), *call.args[merged + 1 :])


def gives_others(func: Func, call: Invocation) -> bool:
    """Tell whether a call gives a text, a number or a function where a function takes interfaces of a node."""
    first, merged = next(iter(call.args), None), len(func.fact.params) - len(func.params)
    if not merged or (isinstance(first, Op) and first.op == _NODE):
        return False
    return any(_is_plain(arg, call.func) for arg in call.args[: merged + 1])


def _is_plain(arg: Expr, caller: Func) -> bool:
    if isinstance(arg, Name):
        return arg.id not in caller.variously_typed and bool(kind_of_type(declared_type(arg.id, caller)))
    return isinstance(arg, Text | Number | Lambda)


def declared_type(name: str, func: Func) -> str:
    """The type that a variable or a member is declared with; empty where that is not seen."""
    field = func.cls.fields.get(name) if func.cls is not None else None
    return func.written_types.get(name) or (field.type if field is not None else "")


def _is_interface(func: Func, expr: Expr) -> bool:
    if isinstance(expr, Call) and isinstance(expr.callee, Member | Name):
        name = last_name(expr.callee.name if isinstance(expr.callee, Member) else expr.callee.id)
        return name.startswith("get_node_") and name.endswith("_interface")
    if not isinstance(expr, Name):
        return False
    written = declared_type(expr.id, func)
    if plain(written) != "auto":
        return is_node_interface(written)
    values = [s.value for s in func.fact.body if s.target == expr and s.kind == "let" and s.value is not None]
    return any(not isinstance(value, Name) and _is_interface(func, value) for value in values)


def construction(step: Step, written: str, args: tuple[Expr, ...], line: int) -> Invocation:
    """Return the construction of an object of a type as written."""
    return Invocation(*step, plain(written), None, args, (), template_arguments(written), line, True)


def _python(step: Step, call: Call) -> Invocation:
    call = step.func.meant(call)
    callee = call.callee
    dotted = dotted_name(callee)
    if dotted and dotted.rpartition(".")[0] not in step.func.file.variables:
        head, *rest = dotted.split(".")
        target = step.func.file.imported.get(head)
        if target is not None or not rest:
            path = ".".join([target or head, *rest])
            return Invocation(*step, path, None, call.args, call.keywords, (), call.line)
    if isinstance(callee, Member):
        inner = _inner_class(step.func, callee)
        receiver = None if inner else callee.base
        return Invocation(*step, inner or callee.name, receiver, call.args, call.keywords, (), call.line)
    return Invocation(*step, "", None, call.args, call.keywords, (), call.line)


def _inner_class(func: Func, callee: Member) -> str:
    """The class within a class of its file that an attribute of that class, or of its object, is; empty of others."""
    owner = func.cls.qualified if func.cls is not None and callee.base == THIS else dotted_name(callee.base)
    path = f"{owner}.{callee.name}"
    return path if path.replace(".", "::") in func.file.inner_classes else ""


def dotted_name(expr: Expr) -> str:
    """Return `a.b.c` for a chain of names, empty otherwise (also for what starts at `this`)."""
    if isinstance(expr, Name):
        return "" if expr.id == "this" else expr.id
    if isinstance(expr, Member):
        base = dotted_name(expr.base)
        return f"{base}.{expr.name}" if base else ""
    return ""


def _implied(step: Step) -> Invocation | None:
    """A member initialiser `sub_(nh, "x", 1)` constructs an object of the member's type."""
    func, _, statement = step
    if func.cls is None or not isinstance(statement.target, Name):
        return None
    field = func.cls.fields.get(statement.target.id)
    if field is None or not by_value(field.type):
        return None
    value = statement.value
    same = isinstance(value, Call) and value.callee == statement.target
    args = value.args if same and isinstance(value, Call) else (value,) if value is not None else ()
    return construction(step, pointee(field.type), one_node(func, args), statement.line)
