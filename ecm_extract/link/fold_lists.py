"""Lists: their elements, and the assignments behind a variable."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import (
    Call,
    Expr,
    Items,
    Member,
    Name,
    Number,
    Op,
    Table,
)

from ecm_extract.link.calls import invocations
from ecm_extract.link.env import MAX_DEPTH, Bound, Env, Instance
from ecm_extract.link.scope import Definition
from ecm_extract.link.units import Cls, Func
from ecm_extract.link.values import (
    MAX_ALTERNATIVES,
    Value,
    demoted,
    set_by,
    unique,
    unknown,
)

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


_WHOLE_PARAMETER = re.compile(r"\$\{([^={}]+)=(?:[^{}]|\{[^{}]*\})*\}")


_CONTAINER = re.compile(r"vector|map$")
_APPENDS = frozenset({"push_back", "emplace_back", "append"})


class ListFolder:
    """Takes lists apart."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._appending: dict[int, list[tuple[int, str, Expr]]] = {}
        self._searching: set[tuple[int, int, int]] = set()

    def elements(self, expr: Expr | None, env: Env, index: Expr | None = None) -> tuple[Value, ...]:
        """Return the values that the elements of a list, or one of them, can have."""
        items = self.items(expr, env)
        if items is None:
            return self._of_parameter(expr, env)
        if isinstance(index, Number) and isinstance(index.value, int) and -len(items) <= index.value < len(items):
            items = [items[index.value]]
        folded = [value for bound in items for value in self.folder.fold(bound.expr, bound.env.before(bound.env.at))]
        return unique(demoted(folded)) if folded else (unknown("item"),)

    def _of_parameter(self, expr: Expr | None, env: Env) -> tuple[Value, ...]:
        """An element of a list that a ROS parameter holds: not known here, but a launch may set it."""
        item = unknown("item")
        values = self.folder.fold(expr, env) if isinstance(expr, Name | Member) else ()
        matches = [match for value in values if (match := _WHOLE_PARAMETER.fullmatch(value.template or ""))]
        return tuple([value for match in matches for value in set_by(match[1], (item,))]) or (item,)

    def items(self, expr: Expr | None, env: Env) -> list[Bound] | None:
        """Return the elements of a list that an expression is, None when the tree does not show them."""
        if env.depth > MAX_DEPTH or expr is None or not self.folder.steps.take(env):
            return None
        with self.folder.steps:
            return self._items(expr, env)

    def _items(self, expr: Expr, env: Env) -> list[Bound] | None:
        if isinstance(expr, Items):
            return [Bound(item, env) for item in expr.items]
        if isinstance(expr, Table):
            return [Bound(value, env) for _, value in expr.entries]
        if isinstance(expr, Call) and len(expr.args) == 1 and isinstance(expr.args[0], Items):
            return self.items(expr.args[0], env)
        if isinstance(expr, Call) and isinstance(expr.callee, Name) and _CONTAINER.search(expr.callee.id):
            return [Bound(item, env) for item in expr.args]
        if isinstance(expr, Name) and expr.id in env.args:
            return self.items(env.args[expr.id].expr, env.args[expr.id].env.before(env.args[expr.id].env.at))
        found = self._assigned(expr, env)
        if found is not None:
            return found
        appended = self._appended(expr, env)
        if appended:
            return appended
        constant = self.folder.scope.constant(expr.id, env) if isinstance(expr, Name) else None
        return self.items(constant[0], env.before(env.at)) if constant is not None else None

    def _assigned(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the elements of the first list that is assigned to a variable or a member."""
        key = (id(expr), id(env.func), env.at)
        if key in self._searching:  # members that are set from each other: what was tried once gives nothing again
            return None
        outermost = not self._searching
        self._searching.add(key)
        try:
            for definition, inner in self.definitions(expr, env):
                value = definition.statement.value
                found = self.items(value, inner) if definition.statement.kind != "each" else None
                if found is not None:
                    return found
            return None
        finally:
            if outermost:
                self._searching.clear()

    def _appended(self, expr: Expr, env: Env) -> list[Bound]:
        """Return what the functions of a class, or the one at hand, append to a list that starts empty."""
        name = _variable(expr)
        if not name:
            return []
        cls = env.this or env.func.cls
        found = []
        is_local = any(s.kind == "let" and s.target == Name(name) for s in env.func.fact.body)
        for func in [env.func] if is_local else self._functions(cls, env):
            for at, target, value in self._appends(func):
                inner = Env(func, at, this=cls, depth=env.depth + 1)
                if target == name and not (func is env.func and at >= env.at):
                    found.append(Bound(value, inner))
        return found[:MAX_ALTERNATIVES]

    def _functions(self, cls: Cls | None, env: Env) -> list[Func]:
        methods = [method for entry in self.folder.program.ancestry(cls) for method in entry.methods] if cls else []
        return methods if env.func in methods else [env.func, *methods]

    def _appends(self, func: Func) -> list[tuple[int, str, Expr]]:
        """Return (statement, list, value) of the calls of a function that append to a list."""
        known = self._appending.get(id(func))
        if known is None:
            index = {id(statement): at for at, statement in enumerate(func.fact.body)}
            known = self._appending[id(func)] = [
                (index[id(call.statement)], _variable(call.receiver), call.args[-1])
                for call in invocations(func, _APPENDS)
                if call.receiver is not None and call.args
            ]
        return known

    def flat(self, expr: Expr, env: Env) -> list[Bound]:
        """Return the elements of a sequence with spread and concatenated ones in place."""
        if env.depth > MAX_DEPTH:
            return [Bound(expr, env)]
        if isinstance(expr, Items):
            return [bound for item in expr.items for bound in self.flat(item, env.before(env.at))]
        if isinstance(expr, Op) and expr.op == "+":
            return [bound for operand in expr.operands for bound in self.flat(operand, env.before(env.at))]
        if isinstance(expr, Name) and expr.id in env.args:
            given = env.args[expr.id]
            return self.flat(given.expr, given.env.before(given.env.at))
        return [Bound(expr, env)]

    def definitions(self, expr: Expr, env: Env) -> list[tuple[Definition, Env]]:
        """Return the assignments of a variable or of a member of `this`, with where each is evaluated."""
        name = (
            expr.id
            if isinstance(expr, Name)
            else expr.name
            if isinstance(expr, Member) and expr.base == Name("this")
            else ""
        )
        if not name:
            return []
        if isinstance(expr, Name):
            local = self.folder.scope.local(name, env)
            if local:
                return [(definition, env.before(definition.at)) for definition in local]
        found = self._member_definitions(name, env.this or env.func.cls, env)
        if found or not isinstance(expr, Name):
            return found
        outside = self.folder.objects.file_scope.definitions(name, env)
        return [(entry, Env(entry.func, entry.at, this=entry.func.cls, depth=env.depth + 1)) for entry in outside]

    def _member_definitions(self, name: str, cls: Cls | None, env: Env) -> list[tuple[Definition, Env]]:
        found: list[tuple[Definition, Env]] = []
        if cls is None:
            return found
        for entry in self.folder.program.ancestry(cls):
            for definition in self.folder.scope.members(name, entry):
                if not self.folder.objects.runs(definition.func, env.made):
                    continue
                made = env.made if env.made is not None and env.made.cls is cls else Instance(cls, {}, {})
                inner = Env(definition.func, definition.at, this=cls, made=made, depth=env.depth + 1)
                found.append((definition, inner))
        return found


def _variable(expr: Expr | None) -> str:
    """The name of a variable or of a member of `this`."""
    if isinstance(expr, Name):
        return expr.id
    return expr.name if isinstance(expr, Member) and expr.base == Name("this") else ""
