"""Python launch files, read statement by statement over values that may be unknown.

Nothing is run or imported. A branch whose condition is known at launch only is read both ways: its actions carry the
condition. Steps, calls and loops are bounded.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ecm_parsers.launch.arguments import Arguments
from ecm_parsers.launch.constructors import CONSTRUCTORS
from ecm_parsers.launch.expressions import Expressions, choice, source_of
from ecm_parsers.launch.markup import both
from ecm_parsers.launch.methods import call_builtin, call_method, hashable
from ecm_parsers.launch.model import Action, Group, Substitution, Template
from ecm_parsers.launch.operators import binary, negated, truth
from ecm_parsers.launch.values import (
    MAX_ITEMS,
    Function,
    Method,
    Reference,
    Scope,
    Text,
    Unknown,
    Value,
    actions_of,
    guarded,
)

MAX_CALLS = 20


class Interpreter(Expressions):
    """Reads one file. `module` holds the names of the file."""

    def __init__(self) -> None:
        super().__init__()
        self.module = Scope({"__file__": Text((Substitution("dirname"), "/launch.py"))})
        self._depth = 0
        self._guard: Template | None = None

    # --- statements ------------------------------------------------------------------------------------------

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
            for target in node.targets:
                self.assign(target, value, scope)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            self.assign(node.target, self.value(node.value, scope), scope)
        elif isinstance(node, ast.AugAssign):
            self._augment(node, scope)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            scope.names[node.name] = Function(node, scope)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            scope.names.update(_imported(node))

    def _if(self, node: ast.If, scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        holds = truth(self.value(node.test, scope))
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
            scope.names[name] = value if name not in scope.names else choice(holds, value, other)

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

    def _augment(self, node: ast.AugAssign, scope: Scope) -> None:
        current = self.value(node.target, scope)
        added = self.value(node.value, scope)
        if isinstance(current, list) and isinstance(node.op, ast.Add) and isinstance(added, list | tuple):
            current.extend(self._under_guard(item, node.lineno) for item in added[:MAX_ITEMS])
        else:
            self.assign(node.target, binary(node.op, current, added), scope)

    def call_of(self, node: ast.Call, scope: Scope) -> Value:
        """Return what a call gives."""
        callee = self.value(node.func, scope)
        given = self._arguments(node, scope)
        if isinstance(callee, Function):
            return self.call(callee, given)
        if isinstance(callee, Method):
            return self._method(callee, given)
        if isinstance(callee, Reference):
            return self._referenced(callee, given, node)
        return Unknown(source_of(node))

    def _method(self, callee: Method, given: Arguments) -> Value:
        if callee.name in {"append", "add_action", "extend", "insert"} and self._guard is not None:
            positional = tuple(self._under_guard(value, given.line) for value in given.positional)
            given = Arguments(positional, given.keywords, given.line)
        if isinstance(callee.owner, Action) or callee.name == "get_package_share_directory":
            return Unknown(callee.name)
        return call_method(callee.owner, callee.name, given)

    def _under_guard(self, value: Value, line: int) -> Value:
        if isinstance(value, list | tuple):
            return [self._under_guard(item, line) for item in value]
        if not isinstance(value, Action):
            return value
        found = guarded((value,), self._guard, line)
        return found[0]

    def _referenced(self, callee: Reference, given: Arguments, node: ast.Call) -> Value:
        if callee.last == "OpaqueFunction":
            return self._opaque(given)
        if callee.path.endswith("environ.get"):
            return CONSTRUCTORS["getenv"](given)
        if callee.path == "launch_configurations.get":
            return CONSTRUCTORS["LaunchConfiguration"](given)
        if callee.last == "perform_substitution":
            return given.get("", 0)
        constructor = CONSTRUCTORS.get(callee.last)
        if constructor is not None:
            return constructor(given)
        if "." not in callee.path:
            found = call_builtin(callee.path, given)
            return Unknown(source_of(node)) if isinstance(found, Unknown) else found
        return Unknown(source_of(node))

    def _opaque(self, given: Arguments) -> Value:
        function = given.get("function", 0)
        extra = given.get("args", default=()) or ()
        if not isinstance(function, Function):
            return Group(line=given.line, condition=given.condition, scoped=False)
        keywords = given.get("kwargs", default={}) or {}
        positional = (Unknown("context"), *(extra if isinstance(extra, list | tuple) else ()))
        made = self.call(function, Arguments(positional, keywords if isinstance(keywords, dict) else {}, given.line))
        return Group(line=given.line, condition=given.condition, actions=actions_of(made), scoped=False)

    def _arguments(self, node: ast.Call, scope: Scope) -> Arguments:
        positional: list[Value] = []
        for part in node.args:
            if isinstance(part, ast.Starred):
                positional += self.items(self.value(part.value, scope)) or []
            else:
                positional.append(self.value(part, scope))
        keywords: dict[str, Value] = {}
        for keyword in node.keywords:
            value = self.value(keyword.value, scope)
            if keyword.arg is not None:
                keywords[keyword.arg] = value
            elif isinstance(value, dict):
                keywords.update({str(name): entry for name, entry in value.items()})
        return Arguments(tuple(positional), keywords, node.lineno)

    def call(self, function: Function, given: Arguments) -> Value:
        """Return what a function of the file returns; several returns are joined under their conditions."""
        if self._depth >= MAX_CALLS:
            return Unknown("deep call")
        scope = Scope(self._bound(function, given), function.scope)
        if isinstance(function.node, ast.Lambda):
            return self.value(function.node.body, scope)
        self._depth += 1
        outer, self._guard = self._guard, None
        try:
            returned = self.run(function.node.body, scope)
        finally:
            self._depth -= 1
            self._guard = outer
        return _returned(returned, given.line)

    def _bound(self, function: Function, given: Arguments) -> dict[str, Value]:
        spec = function.node.args
        names = [entry.arg for entry in (*spec.posonlyargs, *spec.args)]
        bound: dict[str, Value] = {name: Unknown(name) for name in (*names, *(e.arg for e in spec.kwonlyargs))}
        for name, default in zip(names[len(names) - len(spec.defaults) :], spec.defaults, strict=True):
            bound[name] = self.value(default, function.scope)
        for entry, otherwise in zip(spec.kwonlyargs, spec.kw_defaults, strict=True):
            if otherwise is not None:
                bound[entry.arg] = self.value(otherwise, function.scope)
        bound.update(zip(names, given.positional, strict=False))
        bound.update({name: value for name, value in given.keywords.items() if name in bound})
        if spec.vararg is not None:
            bound[spec.vararg.arg] = given.positional[len(names) :]
        if spec.kwarg is not None:
            bound[spec.kwarg.arg] = {name: value for name, value in given.keywords.items() if name not in names}
        return bound


def _imported(node: ast.Import | ast.ImportFrom) -> Iterator[tuple[str, Reference]]:
    for alias in node.names:
        if isinstance(node, ast.ImportFrom):
            yield alias.asname or alias.name, Reference(f"{node.module or ''}.{alias.name}")
            continue
        name = alias.asname or alias.name.split(".")[0]
        yield name, Reference(alias.name if alias.asname else name)


def _returned(returned: list[tuple[Template | None, Value]], line: int) -> Value:
    if not returned:
        return None
    if len(returned) == 1:
        return returned[0][1]
    if any(actions_of(value) for _, value in returned):
        return [action for guard, value in returned for action in guarded(actions_of(value), guard, line)]
    result = returned[-1][1]
    for guard, value in reversed(returned[:-1]):
        result = value if guard is None else choice(guard, value, result)
    return result
