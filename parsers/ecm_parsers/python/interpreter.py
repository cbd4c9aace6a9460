"""Python files, read statement by statement over values that may be unknown.

Nothing is run or imported. A branch whose condition is not known is read both ways. Steps, calls and loops are bounded.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.calls import Calls, Returned
from ecm_parsers.python.classes import class_of
from ecm_parsers.python.expressions import source_of
from ecm_parsers.python.operators import binary, truth
from ecm_parsers.python.values import Function, Many, Object, Reference, Scope, Unknown, Value, is_counted
from ecm_parsers.template import Substitution, Template, both, negated


class Interpreter(Calls):
    """Reads one file and what it imports."""

    def run(self, body: list[ast.stmt], scope: Scope) -> Returned:
        """Read statements; returns what they return, each with the condition under which."""
        returned: Returned = []
        self._block(body, scope, returned)
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

    def _while(self, node: ast.While, scope: Scope, returned: Returned) -> bool:
        return truth(self.value(node.test, scope)) is not False and self._perhaps(node.body, node.test, scope, returned)

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
        return self._either(holds, (node.body, node.orelse), scope, returned)

    def _either(
        self,
        holds: Template,
        sides: tuple[list[ast.stmt], list[ast.stmt]],
        scope: Scope,
        returned: Returned,
    ) -> bool:
        outer, before = self._guard, dict(scope.names)
        self._guard = both(outer, holds)
        first = self._block(sides[0], scope, returned)
        taken, scope.names = scope.names, before
        self._guard = both(outer, negated(holds))
        second = self._block(sides[1], scope, returned)
        self._join(scope, taken, holds, gone=(first, second))
        self._guard = outer
        if first != second:  # what follows runs only where the other branch was taken
            self._guard = both(outer, negated(holds) if first else holds)
        return first and second

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
        for item in self.rounds(node.iter, node.target, scope):
            self.assign(node.target, item.each if isinstance(item, Many) else item, scope)
            if isinstance(item, Many):
                self._perhaps(node.body, node.iter, scope, returned)
            else:
                self._block(node.body, scope, returned)
        return False

    def _try(self, node: ast.Try, scope: Scope, returned: Returned) -> bool:
        gone = self._block([*node.body, *node.orelse], scope, returned)
        for handler in node.handlers if self.IS_STRICT else ():
            self._perhaps(handler.body, handler.type, scope, returned)
        return self._block(node.finalbody, scope, returned) or gone

    def _perhaps(self, body: list[ast.stmt], why: ast.expr | None, scope: Scope, returned: Returned) -> bool:
        """Read what is taken any number of times; False, since what follows it is reached."""
        holds = (Substitution("unknown", ((source_of(why) if why is not None else "",),)),)
        return self._either(holds, (body, []), scope, returned) and False

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
        }
    )
    """True where what follows is not reached."""
