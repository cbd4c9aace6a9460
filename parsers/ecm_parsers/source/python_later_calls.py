"""Calls of libraries that call a function later with arguments that they get for it: `Thread(target=f, args=(x,))`.

What is written there is read as the lambda that it means, `Thread(target=lambda: f(x))`; the arguments are what they
were, as those of a partial are (see `python_partials`).
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Final, NamedTuple

import msgspec
from tree_sitter import Node

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Lambda, Member, Name, Op, Table, Text
from ecm_parsers.source.facts import Parameter
from ecm_parsers.source.flow import Later
from ecm_parsers.source.python_dataclasses import Imported
from ecm_parsers.source.python_lambda import as_function, name_of_handed
from ecm_parsers.source.python_partials import kept
from ecm_parsers.source.python_scan import Scan

_REST: Final = "rest*"
"""What a partial is called with, beside what it keeps; no variable has such a name."""
Place = tuple[str, int]
"""The keyword of an argument, and which one it is without that."""


class _Function(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    function: Place
    args: Place
    kwargs: Place


class _Method(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    of: frozenset[str]


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    partials: frozenset[str]
    functions: dict[str, _Function]
    methods: dict[str, _Method]


class _Asked(NamedTuple):
    """What is called later, and with what."""

    function: Expr
    args: tuple[Expr, ...]
    keywords: tuple[tuple[str, Expr], ...]


@cache
def _table() -> _Table:
    text = files("ecm_parsers").joinpath("source", "python_later_calls.toml").read_text(encoding="utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


@cache
def _last_names() -> frozenset[str]:
    named = {*_table().functions, *_table().partials}
    return frozenset({name.rpartition(".")[2] for name in named} | _table().methods.keys())


def later_call(scan: Scan, node: Node, call: Call) -> Call | Lambda:
    """Return a call with the lambda that it gets, where it is one of those; any other as it is.

    A partial that somebody gets is one: `work(partial(f, x))` is `work(lambda *rest: f(x, *rest))`.
    """
    callee = call.callee
    last = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
    if last not in _last_names() or scan.frame.place == "class":
        return call
    imported = Imported.of(scan.imports)
    name = imported.full(scan.text(node.children[0]))
    row = _table().functions.get(name)
    if name in _table().partials:
        return _of_partial(scan, node, _as_one(call, imported), imported)
    if row is not None:
        asked = _of_function(call, row)
        return _with_lambda(scan, node, call, row, asked) if asked is not None else call
    if isinstance(callee, Member) and _is_method(scan, callee, imported) and _is_callable(call.args[:1]):
        asked = _Asked(call.args[0], call.args[1:], call.keywords)
        return msgspec.structs.replace(call, args=(_lambda(scan, node, asked), *call.args[1:]))
    return call


def _of_partial(scan: Scan, node: Node, call: Call, imported: Imported) -> Call | Lambda:
    if not _is_argument(node) or _is_within_partial(scan, node, imported) or not _is_callable(call.args[:1]):
        return call
    asked = _Asked(call.args[0], (*call.args[1:], Op("*", (Name(_REST),))), call.keywords)
    return _lambda(scan, node, asked, _REST)


def _as_one(call: Call, imported: Imported) -> Call:
    """`partial(partial(f, a), b)` as `partial(f, a, b)`."""
    inner = call.args[0] if call.args else None
    if not isinstance(inner, Call) or not inner.args or imported.full(_dotted(inner.callee)) not in _table().partials:
        return call
    given = dict(call.keywords)
    pairs = zip(inner.keywords, inner.keyword_lines, strict=True)
    kept = [(each, line) for each, line in pairs if each[0] == "**" or each[0] not in given]
    keywords = (*(each for each, _ in kept), *call.keywords)
    lines = (*(line for _, line in kept), *call.keyword_lines)
    args = (*inner.args, *call.args[1:])
    return msgspec.structs.replace(call, args=args, keywords=keywords, keyword_lines=lines)


def _is_within_partial(scan: Scan, node: Node, imported: Imported) -> bool:
    """Whether a call is what a partial is of."""
    listed = node.parent
    around = listed.parent if listed is not None and listed.type == "argument_list" else None
    callee = around.child_by_field_name("function") if around is not None else None
    first = listed is not None and listed.named_children[:1] == [node]
    return first and callee is not None and imported.full(scan.text(callee)) in _table().partials


def _is_argument(node: Node) -> bool:
    return node.parent is not None and node.parent.type in {"argument_list", "keyword_argument"}


def _is_of_function(node: Node) -> bool:
    """Whether an argument is one of a function; methods of the object keep it among what its own body does."""
    listed = node.parent if node.parent is not None and node.parent.type == "argument_list" else None
    called = listed.parent.child_by_field_name("function") if listed is not None and listed.parent is not None else None
    return called is not None and called.type == "identifier"


def _of_function(call: Call, row: _Function) -> _Asked | None:
    """What a call calls later; None where it does not show it."""
    function, args, kwargs = (_given(call, each) for each in (row.function, row.args, row.kwargs))
    if function is None or not _is_callable((function,)) or (args is None and kwargs is None):
        return None
    placed = args.items if isinstance(args, Items) else () if args is None else (Op("*", (args,)),)
    if isinstance(kwargs, Table) and all(isinstance(key, Text) for key, _ in kwargs.entries):
        named = ((key.value, each) for key, each in kwargs.entries if isinstance(key, Text))
        return _Asked(function, placed, tuple(named))
    return _Asked(function, placed, () if kwargs is None else (("**", kwargs),))


def _given(call: Call, place: Place) -> Expr | None:
    name, at = place
    return dict(call.keywords).get(name, call.args[at] if at < len(call.args) else None)


def _is_callable(given: tuple[Expr, ...]) -> bool:
    return len(given) == 1 and isinstance(given[0], Name | Member)


def _with_lambda(scan: Scan, node: Node, call: Call, row: _Function, asked: _Asked) -> Call:
    """The call with a lambda in place of the function; whoever gets the arguments, too, may change them."""
    (name, place), made = row.function, _lambda(scan, node, asked)
    args = tuple([made if at == place else each for at, each in enumerate(call.args)])
    keywords = tuple([(each, made if each == name else value) for each, value in call.keywords])
    return msgspec.structs.replace(call, args=args, keywords=keywords)


def _lambda(scan: Scan, node: Node, asked: _Asked, *names: str) -> Lambda:
    """What somebody calls later: a function of its own where functions of the tree may get it (`python_lambda`)."""
    row, column = node.start_point
    place = f"{row + 1}:{column + 1}"
    args = tuple([_kept(scan, node, f"value*{place}:{at}", each, names) for at, each in enumerate(asked.args)])
    keywords = tuple([(key, kept(scan, node, Name(f"{key}*{place}"), each)) for key, each in asked.keywords])
    body = Call(asked.function, args, keywords, (), row + 1, (row + 1,) * len(keywords))
    name = name_of_handed(scan, node) if names and _is_of_function(node) else ""
    if name:
        return as_function(scan, node, name, tuple([Parameter(f"*{each}") for each in names]), lambda: body)
    scan.frame.lambdas += 1
    scan.frame.flow.begin()
    scan.emit("do", node, body)
    scan.frame.flow.add(Later(scan.frame.flow.end(), names))
    scan.frame.lambdas -= 1
    return Lambda(("",) * len(names), tuple([f"*{each}" for each in names]), body)


def _kept(scan: Scan, node: Node, name: str, value: Expr, names: tuple[str, ...]) -> Expr:
    """An argument as it is when the call is written; what the lambda itself gets is not known there."""
    own = isinstance(value, Op) and value.op == "*" and any(value.operands == (Name(each),) for each in names)
    return value if own else kept(scan, node, Name(name), value)


def _is_method(scan: Scan, callee: Member, imported: Imported) -> bool:
    """Whether what a method is called on was made, in the function or by one of its object, by a class that has it."""
    makers = _table().methods.get(callee.name)
    made = (imported.full(_dotted(call.callee)) for call in _makers(scan, callee.base))
    return makers is not None and any(name in makers.of for name in made)


def _makers(scan: Scan, receiver: Expr) -> Iterator[Call]:
    bodies = [scan.frame.body]
    if isinstance(receiver, Member) and receiver.base == THIS:
        owner = scan.frame.scope.rpartition("::")[0]
        bodies += [list(function.body) for function in scan.functions if function.scope == owner]
    for body in bodies:
        yield from (entry.value for entry in body if entry.target == receiver and isinstance(entry.value, Call))


def _dotted(expr: Expr) -> str:
    if isinstance(expr, Member):
        return f"{_dotted(expr.base)}.{expr.name}"
    return expr.id if isinstance(expr, Name) else ""
