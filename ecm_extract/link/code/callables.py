"""What Python calls by another name: `p = self.declare_parameter`, `make = partial(self.create_publisher, String)`.

Source: functools.partial of the Python library: what it is given stands before what its call is given, and a keyword of
the call before one of its own. What it keeps is read where it is made (`ecm_parsers.source.python_partials`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Table, Text
from ecm_parsers.source.facts import Function, Statement

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.left_alone import reads_only
from ecm_extract.link.code.walk import children, dotted

MAX_NAMES: Final = 8
"""Names that stand for one another."""
_PARTIAL: Final = "functools.partial"


class Callables(NamedTuple):
    """What names stand for that a function calls: its variables, members of its object; `imported` tells who is who."""

    variables: Mapping[str, Expr]
    members: Mapping[str, Expr]
    imported: Mapping[str, str]

    def meant(self, call: Call) -> Call:
        """Return a call of what a name stands for, with what that keeps; any other call as it is."""
        for _ in range(MAX_NAMES):
            callee = self._stands_for(call.callee)
            if isinstance(callee, Call):
                call = _completed(callee, call)
            elif callee is not None and not isinstance(callee, Table):
                call = _of(callee, call)
            else:
                break
        return call

    def _stands_for(self, callee: Expr) -> Expr | None:
        """What is called by a name, an element of a table or a call; None of what is called as it is."""
        if isinstance(callee, Name):
            return self.variables.get(callee.id)
        if isinstance(callee, Member):
            return self.members.get(callee.name) if callee.base == THIS and self.members else None
        if isinstance(callee, Call):
            return callable_of(callee, self.imported) or self._element(callee)
        return self._element(callee) if isinstance(callee, Op) else None

    def _element(self, callee: Call | Op) -> Expr | None:
        """`makers["pub"]`, `makers.get("pub")`."""
        base, key = element_of(callee)
        table = self.variables.get(base.id) if isinstance(base, Name) else base
        entries = table.entries if isinstance(table, Table) and key is not None else ()
        if not all(isinstance(each, Text) for each, _ in entries):
            return None
        found = next((value for each, value in reversed(entries) if each == key), None)
        return None if found is None else callable_of(found, self.imported) or _name_of(found)


def callable_of(value: Expr | None, imported: Mapping[str, str]) -> Expr | None:
    """Return the method or the partial that an expression is; None of anything else."""
    if isinstance(value, Member):
        return value if object_of(value) else None
    if not isinstance(value, Call):
        return None
    if (
        value.callee == Name("getattr")
        and len(value.args) == 2
        and not value.keywords
        and (name := text_of(value.args[1])) is not None
    ):
        return Member(value.args[0], name) if object_of(value.args[0]) else None
    return value if value.args and full_name(dotted(value.callee) or "", imported) == _PARTIAL else None


def text_of(expr: Expr) -> str | None:
    """Return a text, be it put together of several: `"create_" + "client"`; None of anything else."""
    if isinstance(expr, Op) and expr.op == "+":
        parts = [text_of(each) for each in expr.operands]
        return None if None in parts else "".join(each for each in parts if each is not None)
    return expr.value if isinstance(expr, Text) else None


def element_of(expr: Call | Op) -> tuple[Expr | None, Text | None]:
    """Return the table and the key of `makers["pub"]` and `makers.get("pub")`; nothing of anything else."""
    if isinstance(expr, Op):
        base, key = expr.operands if expr.op == "[]" and len(expr.operands) == 2 else (None, None)
    else:
        gets = isinstance(expr.callee, Member) and expr.callee.name == "get" and len(expr.args) == 1
        base, key = (
            (expr.callee.base, expr.args[0])
            if gets and isinstance(expr.callee, Member) and not expr.keywords
            else (None, None)
        )
    return (base, key) if isinstance(key, Text) else (None, None)


def held_callables(function: Function, imported: Mapping[str, str]) -> Mapping[str, Expr]:
    """Return what variables hold that can be called, where their only assignments say so and that stays the same."""
    given = Counter(assigned(function))
    given.update(parameter.name.lstrip("*") for parameter in function.params)
    given.update(function.shared)
    found: dict[str, Expr] = {}
    for statement in function.body:
        target = statement.target
        if statement.kind in {"let", "set"} and isinstance(target, Name) and given[target.id] == 1:
            held = callable_of(statement.value, imported) or _table(function, statement, target)
            if held is not None and all(given[name] <= 1 for name in _objects(held)):
                found[target.id] = held
    return found


def seen_callables(
    function: Function, beside: Sequence[Function], around: Mapping[str, Expr], imported: Mapping[str, str]
) -> Mapping[str, Expr]:
    """Return what variables hold that a function sees: its own, those of functions around it, those of its module."""
    chain = [function]
    while len(chain) < MAX_NAMES:
        scope = chain[-1].scope
        outer = [each for each in beside if scope and f"{each.scope}::{each.name}".removeprefix("::") == scope]
        if len(outer) != 1:
            break
        chain.append(outer[0])
    found = dict(around)
    for each in reversed(chain):
        hidden = {*assigned(each), *(parameter.name.lstrip("*") for parameter in each.params)}
        inner = _within(each, beside)
        own = held_callables(each, imported).items()
        found = {name: held for name, held in found.items() if name not in hidden}
        found |= {name: held for name, held in own if not any(_changes(other, name, held) for other in inner)}
    return found


def _within(function: Function, beside: Sequence[Function]) -> Sequence[Function]:
    """The functions that one declares, and those that these declare."""
    scope = f"{function.scope}::{function.name}::".removeprefix("::")
    return [each for each in beside if f"{each.scope}::".startswith(scope)]


def _changes(function: Function, name: str, held: Expr) -> bool:
    """Whether a function within another may give a variable something else, or change the table that it holds."""
    changed = isinstance(held, Table) and not all(reads_only(step, name) for step in function.body)
    return name in function.shared or changed


def assigned(function: Function) -> Iterator[str]:
    """Yield the names that a function gives something, each time it does."""
    for statement in function.body:
        yield from _names(statement.target)


def object_of(expr: Expr) -> str:
    """Return the name in front of `a.b.c`; empty of what a call or an element gives, which is another each time."""
    while isinstance(expr, Member):
        expr = expr.base
    return expr.id if isinstance(expr, Name) else ""


def _table(function: Function, statement: Statement, target: Name) -> Table | None:
    """A table that a variable holds, and that nobody changes."""
    value = statement.value
    others = [step for step in function.body if step is not statement]
    return value if isinstance(value, Table) and all(reads_only(step, target.id) for step in others) else None


def _objects(held: Expr) -> Iterator[str]:
    if isinstance(held, Table):
        for _, value in held.entries:
            yield from _objects(value)
    else:
        yield object_of(held.args[0] if isinstance(held, Call) and held.args else held)


def _completed(partial: Call, call: Call) -> Call:
    """A call of what a partial is of, with what that keeps."""
    given = dict(call.keywords)
    kept = [(name, value) for name, value in partial.keywords if name not in given]
    return Call(partial.args[0], (*partial.args[1:], *call.args), (*kept, *call.keywords), call.types, call.line)


def _of(callee: Expr, call: Call) -> Call:
    return Call(callee, call.args, call.keywords, call.types, call.line, call.keyword_lines)


def _name_of(value: Expr) -> Name | None:
    return value if isinstance(value, Name) else None


def _names(target: Expr | None) -> Iterator[str]:
    if isinstance(target, Name):
        yield target.id
    elif target is not None and not isinstance(target, Member):
        for each in children(target):
            yield from _names(each)
