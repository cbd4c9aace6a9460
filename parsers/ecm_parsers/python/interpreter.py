"""Python files, read statement by statement over values that may be unknown.

Nothing is run or imported. A branch whose condition is not known is read both ways. Steps, calls and loops are bounded.
"""

from __future__ import annotations

import ast

from ecm_parsers.python.calls import Calls
from ecm_parsers.python.classes import class_of
from ecm_parsers.python.expressions import source_of
from ecm_parsers.python.methods import hashable
from ecm_parsers.python.operators import binary, truth
from ecm_parsers.python.values import MAX_ITEMS, Function, Object, Scope, Unknown, Value
from ecm_parsers.template import Substitution, Template, both, negated


class Interpreter(Calls):
    """Reads one file and what it imports."""

    def run(self, body: list[ast.stmt], scope: Scope) -> list[tuple[Template | None, Value]]:
        """Read statements; returns what they return, each with the condition under which."""
        returned: list[tuple[Template | None, Value]] = []
        self._block(body, scope, returned)
        return returned

    def _block(self, body: list[ast.stmt], scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        """Read statements; True when none after them is reached."""
        outer = self._guard
        try:
            return any(self._statement(statement, scope, returned) for statement in body)
        finally:
            self._guard = outer

    def _statement(self, node: ast.stmt, scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        self.line = node.lineno
        self.step()
        if isinstance(node, ast.Return):
            returned.append((self._guard, self.value(node.value, scope)))
            return True
        if isinstance(node, ast.If):
            return self._if(node, scope, returned)
        if isinstance(node, ast.For):
            return self._for(node, scope, returned)
        if isinstance(node, ast.Try):
            return self._block([*node.body, *node.orelse, *node.finalbody], scope, returned)
        if isinstance(node, ast.With):
            for item in node.items:
                opened = self.value(item.context_expr, scope)
                if item.optional_vars is not None:
                    self.assign(item.optional_vars, opened, scope)
            return self._block(node.body, scope, returned)
        if isinstance(node, ast.While):
            return self._block(node.body, scope, returned) and False
        self._simple(node, scope)
        return isinstance(node, ast.Raise)

    def _simple(self, node: ast.stmt, scope: Scope) -> None:
        if isinstance(node, ast.Expr):
            self.value(node.value, scope)
        elif isinstance(node, ast.Assign):
            value = self.value(node.value, scope)
            self.watcher.bound(node, value)
            for target in node.targets:
                self.assign(target, value, scope)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            self.assign(node.target, self.value(node.value, scope), scope)
        elif isinstance(node, ast.AugAssign):
            self._augment(node, scope)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            scope.names[node.name] = Function(node, scope)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            name = scope.find("__name__") or ""
            scope.names.update(self.imports.bound(node, str(name).rpartition(".")[0]))
        elif isinstance(node, ast.ClassDef):
            body = Scope({}, scope)
            self.run(node.body, body)
            scope.names[node.name] = class_of(node, tuple(self.value(base, scope) for base in node.bases), body)

    def _if(self, node: ast.If, scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        tested = self.value(node.test, scope)
        self.watcher.tested(tested, node.lineno)
        holds = truth(tested)
        if isinstance(holds, bool):
            return self._block(node.body if holds else node.orelse, scope, returned)
        outer, before = self._guard, dict(scope.names)
        self._guard = both(outer, holds)
        first = self._block(node.body, scope, returned)
        taken, scope.names = scope.names, before
        self._guard = both(outer, negated(holds))
        second = self._block(node.orelse, scope, returned)
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

    def _for(self, node: ast.For, scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        items = self.items(self.value(node.iter, scope))
        outer = self._guard
        if items is None:
            items = [Unknown(source_of(node.target))]
            self._guard = both(outer, (Substitution("unknown", ((source_of(node.iter),),)),))
        for item in items:
            self.assign(node.target, item, scope)
            self._block(node.body, scope, returned)
        self._guard = outer
        return False

    def assign(self, target: ast.expr, value: Value, scope: Scope) -> None:
        """Bind a value to what stands on the left side."""
        if isinstance(target, ast.Name):
            scope.names[target.id] = value
        elif isinstance(target, ast.Tuple | ast.List):
            values = value if isinstance(value, list | tuple) and len(value) == len(target.elts) else None
            for at, element in enumerate(target.elts):
                self.assign(element, Unknown(source_of(element)) if values is None else values[at], scope)
        elif isinstance(target, ast.Subscript):
            owner, key = self.value(target.value, scope), self.value(target.slice, scope)
            if isinstance(owner, dict) and hashable(key) and len(owner) < MAX_ITEMS:
                owner[key] = value
        elif isinstance(target, ast.Attribute):
            owner = self.value(target.value, scope)
            if isinstance(owner, Object):
                owner.attributes[target.attr] = value

    def _augment(self, node: ast.AugAssign, scope: Scope) -> None:
        current = self.value(node.target, scope)
        added = self.value(node.value, scope)
        if isinstance(current, list) and isinstance(node.op, ast.Add) and isinstance(added, list | tuple):
            current.extend(self.under_guard(item, node.lineno) for item in added)
        else:
            self.assign(node.target, binary(node.op, current, added), scope)
