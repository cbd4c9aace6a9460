"""Python files, read statement by statement over values that may be unknown.

Nothing is run or imported. A branch whose condition is not known is read both ways. Steps, calls and loops are bounded.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from types import MappingProxyType

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.calls import Calls, Returned
from ecm_parsers.python.classes import class_of
from ecm_parsers.python.models import Models
from ecm_parsers.python.operators import binary, truth
from ecm_parsers.python.sources import Sources
from ecm_parsers.python.spelling import source_of
from ecm_parsers.python.values import Function, Many, Object, Reference, Scope, Unknown, Value, is_counted
from ecm_parsers.python.watching import Watcher
from ecm_parsers.template import Substitution, Template, both, negated


@dataclass(slots=True)
class _Loop:
    """A loop that is read.

    Attributes:
        guard: the condition under which a round is read.
        is_left, is_perhaps_left: whether a `break` was met.
        has_ended: whether a `break` or `continue` was met in this round.
        ends: what names hold where that depends on a condition.
    """

    guard: Template | None = None
    is_left: bool = False
    is_perhaps_left: bool = False
    has_ended: bool = False
    ends: list[dict[str, Value]] = field(default_factory=list)


class Interpreter(Calls):
    """Reads one file and what it imports."""

    def __init__(
        self, models: Models, names: dict[str, Value], sources: Sources | None = None, watcher: Watcher | None = None
    ) -> None:
        super().__init__(models, names, sources, watcher)
        self._loop = _Loop()

    def run(self, body: list[ast.stmt], scope: Scope) -> Returned:
        """Read statements; returns what they return, each with the condition under which."""
        returned: Returned = []
        if not self._block(body, scope, returned) and returned:
            returned.append((self._guard, None))
        return returned

    def _block(self, body: list[ast.stmt], scope: Scope, returned: Returned) -> bool:
        """Read statements; True when none after them is reached."""
        outer = self._guard
        try:
            return any(self._statement(statement, scope, returned) for statement in body)
        finally:
            self._guard = outer

    def _statement(self, node: ast.stmt, scope: Scope, returned: Returned) -> bool:
        self.line = node.lineno
        self.step()
        reader = self._STATEMENTS.get(type(node))
        return reader is not None and bool(reader(self, node, scope, returned))

    def _return(self, node: ast.Return, scope: Scope, returned: Returned) -> bool:
        returned.append((self._guard, self.value(node.value, scope)))
        return True

    def _with(self, node: ast.With, scope: Scope, returned: Returned) -> bool:
        for item in node.items:
            opened = self.value(item.context_expr, scope)
            if item.optional_vars is not None:
                self.assign(item.optional_vars, opened, scope)
        return self._block(node.body, scope, returned)

    def _while(self, node: ast.While, scope: Scope, returned: Returned) -> None:
        if truth(self.value(node.test, scope)) is False:
            return
        outer, self._loop = self._loop, _Loop(self._guard)
        self._perhaps(node.test, scope, lambda: self._round(node.body, scope, returned))
        self._loop = outer

    def _expression(self, node: ast.Expr, scope: Scope, _: Returned) -> None:
        self.value(node.value, scope)

    def _assign(self, node: ast.Assign, scope: Scope, _: Returned) -> None:
        value = self.value(node.value, scope)
        self.watcher.bound(node, value)
        for target in node.targets:
            self.assign(target, value, scope)

    def _annotated(self, node: ast.AnnAssign, scope: Scope, _: Returned) -> None:
        if node.value is not None:
            self.assign(node.target, self.value(node.value, scope), scope)

    def _import(self, node: ast.Import | ast.ImportFrom, scope: Scope, _: Returned) -> None:
        name = scope.find("__name__") or ""
        scope.names.update(self.imports.bound(node, str(name).rpartition(".")[0]))

    def _function(self, node: ast.FunctionDef | ast.AsyncFunctionDef, scope: Scope, _: Returned) -> None:
        scope.names[node.name] = Function(node, scope)

    def _class(self, node: ast.ClassDef, scope: Scope, _: Returned) -> None:
        body = Scope({}, scope)
        self.run(node.body, body)
        scope.names[node.name] = class_of(node, tuple(self.value(base, scope) for base in node.bases), body)

    def _delete(self, node: ast.Delete, scope: Scope, _: Returned) -> None:
        for target in node.targets:
            if isinstance(target, ast.Subscript):
                given = Arguments((self.value(target.slice, scope),), {}, target.lineno)
                self.method(self.value(target.value, scope), "__delitem__", given, target)

    def _if(self, node: ast.If, scope: Scope, returned: Returned) -> bool:
        tested = self.value(node.test, scope)
        self.watcher.tested(tested, node.lineno)
        holds = truth(tested)
        if isinstance(holds, bool):
            return self._block(node.body if holds else node.orelse, scope, returned)
        return self._either(
            holds,
            scope,
            lambda: self._block(node.body, scope, returned),
            lambda: self._block(node.orelse, scope, returned),
        )

    def _either(self, holds: Template, scope: Scope, one: Callable[[], bool], other: Callable[[], bool]) -> bool:
        """Read two branches of which one is taken; True when none goes on."""
        outer, before = self._guard, dict(scope.names)
        self._guard = both(outer, holds)
        first = one()
        taken, scope.names = scope.names, before
        self._guard = both(outer, negated(holds))
        second = other()
        self._join(scope, taken, holds, gone=(first, second))
        self._guard = outer
        if first != second:  # what follows runs only where the other branch was taken
            self._guard = both(outer, negated(holds) if first else holds)
        return first and second

    def _perhaps(self, why: ast.expr | None, scope: Scope, body: Callable[[], bool]) -> None:
        """Read what is taken any number of times."""
        holds = (Substitution("unknown", ((source_of(why) if why is not None else "",),)),)
        self._either(holds, scope, body, lambda: False)

    def _join(self, scope: Scope, taken: dict[str, Value], holds: Template, gone: tuple[bool, bool]) -> None:
        """Give names that the two branches set differently a value that depends on the condition."""
        if gone[1]:
            scope.names = taken
        if any(gone):
            return
        for name, value in taken.items():
            other = scope.names.get(name)
            if other is value:
                continue
            scope.names[name] = value if name not in scope.names else self.chosen(holds, value, other, name)

    def _for(self, node: ast.For, scope: Scope, returned: Returned) -> bool:
        outer, self._loop = self._loop, _Loop(self._guard)
        gone = False
        for item in self.rounds(node.iter, node.target, scope):
            if gone or self._loop.is_left:
                break
            gone = self._round_of(node, item, scope, returned)
        is_left, self._loop = self._loop.is_left, outer
        return gone or (not is_left and self._block(node.orelse, scope, returned))

    def _round_of(self, node: ast.For, item: Value, scope: Scope, returned: Returned) -> bool:
        """Read one round, or what may be any number of them; True when nothing behind the loop is reached."""

        def body() -> bool:
            self.assign(node.target, item.each if isinstance(item, Many) else item, scope)
            return self._round(node.body, scope, returned)

        if not isinstance(item, Many) and not self._loop.is_perhaps_left:
            return body()
        self._perhaps(node.iter, scope, body)
        return False

    def _round(self, body: list[ast.stmt], scope: Scope, returned: Returned) -> bool:
        """Read the body of a loop; what was set where it may have ended earlier is what names may hold behind it."""
        loop = self._loop
        loop.guard, loop.has_ended = self._guard, False
        gone = self._block(body, scope, returned)
        for names in loop.ends:
            self._join(scope, names, (Substitution("unknown", (("break",),)),), gone=(False, False))
        loop.ends.clear()
        return gone and not loop.has_ended

    def _end(self, node: ast.Break | ast.Continue, scope: Scope, _: Returned) -> bool:
        loop, is_break = self._loop, isinstance(node, ast.Break)
        loop.has_ended = True
        if self._guard is not loop.guard:
            loop.ends.append(dict(scope.names))
            loop.is_perhaps_left |= is_break
        else:
            loop.is_left |= is_break
        return True

    def _try(self, node: ast.Try, scope: Scope, returned: Returned) -> bool:
        gone = self._block([*node.body, *node.orelse], scope, returned)
        for handler in node.handlers if self.IS_STRICT else ():
            self._perhaps(handler.type, scope, partial(self._block, handler.body, scope, returned))
        return self._block(node.finalbody, scope, returned) or gone

    def assign(self, target: ast.expr, value: Value, scope: Scope) -> None:
        """Bind a value to what stands on the left side."""
        if isinstance(target, ast.Name):
            scope.names[target.id] = value
        elif isinstance(target, ast.Tuple | ast.List):
            fits = isinstance(value, list | tuple) and len(value) == len(target.elts) and is_counted(value)
            values = value if fits else None
            for at, element in enumerate(target.elts):
                self.assign(element, Unknown(source_of(element)) if values is None else values[at], scope)
        elif isinstance(target, ast.Subscript):
            entry = (self.value(target.slice, scope), value)
            self.method(self.value(target.value, scope), "__setitem__", Arguments(entry, {}, target.lineno), target)
        elif isinstance(target, ast.Attribute):
            owner = self.value(target.value, scope)
            held = owner.attributes if isinstance(owner, Object) else self.attributes
            name = f"{owner.path}.{target.attr}" if isinstance(owner, Reference) else target.attr
            if isinstance(owner, Object | Reference):
                self.keep(held, name, value)

    def keep(self, held: dict[str, Value], name: str, value: Value) -> None:
        """Let an attribute hold a value; in a branch that is not decided it may hold what it did."""
        perhaps = self.IS_STRICT and self._guard is not None and name in held
        held[name] = self.chosen(self._guard or (), value, held[name], name) if perhaps else value

    def _augment(self, node: ast.AugAssign, scope: Scope, _: Returned) -> None:
        current = self.value(node.target, scope)
        added = self.value(node.value, scope)
        if isinstance(current, list) and isinstance(node.op, ast.Add) and isinstance(added, list | tuple):
            self.method(current, "extend", Arguments((added,), {}, node.lineno), node.target)
        else:
            self.assign(node.target, binary(node.op, current, added), scope)

    _STATEMENTS: Mapping[type[ast.stmt], Callable[..., bool | None]] = MappingProxyType(
        {
            ast.Return: _return,
            ast.If: _if,
            ast.For: _for,
            ast.Try: _try,
            ast.With: _with,
            ast.While: _while,
            ast.Expr: _expression,
            ast.Assign: _assign,
            ast.AnnAssign: _annotated,
            ast.AugAssign: _augment,
            ast.Delete: _delete,
            ast.FunctionDef: _function,
            ast.AsyncFunctionDef: _function,
            ast.ClassDef: _class,
            ast.Import: _import,
            ast.ImportFrom: _import,
            ast.Raise: lambda *_: True,
            ast.Continue: _end,
            ast.Break: _end,
        }
    )
    """True where what follows is not reached."""
