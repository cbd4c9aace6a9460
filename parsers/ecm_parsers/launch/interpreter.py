"""Python launch files, read statement by statement over values that may be unknown.

Nothing is run or imported. A branch whose condition is known at launch only is read both ways: its actions carry the
condition. Steps, calls and loops are bounded.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from ecm_parsers.launch.constructors import CONSTRUCTORS, Arguments
from ecm_parsers.launch.markup import both
from ecm_parsers.launch.methods import call_builtin, call_method, hashable
from ecm_parsers.launch.model import Action, Group, Substitution, Template
from ecm_parsers.launch.operators import binary, compare, negated, subscript, truth
from ecm_parsers.launch.values import (
    MAX_ITEMS,
    Condition,
    Description,
    Function,
    Method,
    Reference,
    Scope,
    Text,
    Unknown,
    Value,
    actions_of,
    guarded,
    merged_text,
    template_of,
)

MAX_STEPS = 60_000
MAX_CALLS = 20
MAX_SHOWN = 60


class TooLongError(Exception):
    """The file takes more steps to read than any launch file needs."""


class Interpreter:
    """Reads one file. `steps` counts evaluated nodes."""

    def __init__(self) -> None:
        self.steps = 0
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
        self._step()
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
                    self._assign(item.optional_vars, opened, scope)
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
                self._assign(target, value, scope)
        elif isinstance(node, ast.AnnAssign) and node.value is not None:
            self._assign(node.target, self.value(node.value, scope), scope)
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
            scope.names[name] = value if name not in scope.names else _choice(holds, value, other)

    def _for(self, node: ast.For, scope: Scope, returned: list[tuple[Template | None, Value]]) -> bool:
        items = self._items(self.value(node.iter, scope))
        outer = self._guard
        if items is None:
            items = [Unknown(_source(node.target))]
            self._guard = both(outer, (Substitution("unknown", ((_source(node.iter),),)),))
        for item in items:
            self._assign(node.target, item, scope)
            self._block(node.body, scope, returned)
        self._guard = outer
        return False

    def _assign(self, target: ast.expr, value: Value, scope: Scope) -> None:
        if isinstance(target, ast.Name):
            scope.names[target.id] = value
        elif isinstance(target, ast.Tuple | ast.List):
            values = value if isinstance(value, list | tuple) and len(value) == len(target.elts) else None
            for at, element in enumerate(target.elts):
                self._assign(element, Unknown(_source(element)) if values is None else values[at], scope)
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
            self._assign(node.target, binary(node.op, current, added), scope)

    # --- expressions -----------------------------------------------------------------------------------------

    def value(self, node: ast.expr | None, scope: Scope) -> Value:
        """Return the value of an expression."""
        if node is None:
            return None
        self._step()
        reader = self._EXPRESSIONS.get(type(node))
        return reader(self, node, scope) if reader is not None else Unknown(_source(node))

    def _name(self, node: ast.Name, scope: Scope) -> Value:
        found = scope.find(node.id)
        known = found is not None or _is_set(node.id, scope)
        return found if known else Reference(node.id)

    def _attribute(self, node: ast.Attribute, scope: Scope) -> Value:
        owner = self.value(node.value, scope)
        if isinstance(owner, Reference):
            return Reference(f"{owner.path}.{node.attr}")
        if node.attr == "parent" and isinstance(owner, Text | str):
            return CONSTRUCTORS["dirname"](Arguments((owner,), {}, node.lineno))
        if node.attr == "launch_configurations":
            return Reference("launch_configurations")
        if isinstance(owner, Unknown):
            return Unknown(_source(node))
        return Method(owner, node.attr)

    def _subscript(self, node: ast.Subscript, scope: Scope) -> Value:
        owner, key = self.value(node.value, scope), self.value(node.slice, scope)
        if isinstance(owner, Reference) and owner.last in {"environ", "launch_configurations"}:
            return Text((Substitution("env" if owner.last == "environ" else "arg", (template_of(key),)),))
        found = subscript(owner, key)
        return Unknown(_source(node)) if isinstance(found, Unknown) else found

    def _slice(self, node: ast.Slice, scope: Scope) -> Value:
        bounds = [self.value(part, scope) for part in (node.lower, node.upper, node.step)]
        fine = all(bound is None or isinstance(bound, int) for bound in bounds) and bounds[2] != 0
        return slice(*bounds) if fine else Unknown("slice")

    def _list(self, node: ast.List | ast.Tuple | ast.Set, scope: Scope) -> Value:
        items: list[Value] = []
        for element in node.elts:
            if isinstance(element, ast.Starred):
                items += self._items(self.value(element.value, scope)) or []
            else:
                items.append(self.value(element, scope))
        return tuple(items) if isinstance(node, ast.Tuple) else items

    def _dict(self, node: ast.Dict, scope: Scope) -> Value:
        table: dict[Value, Value] = {}
        for key_node, value_node in zip(node.keys, node.values, strict=True):
            value = self.value(value_node, scope)
            if key_node is None:
                table.update(value if isinstance(value, dict) else {})
                continue
            key = self.value(key_node, scope)
            if isinstance(key, list | tuple):
                key = merged_text(template_of(key))
            if hashable(key):
                table[key] = value
        return table

    def _comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp, scope: Scope) -> Value:
        return [self.value(node.elt, inner) for inner in self._loops(node.generators, Scope({}, scope))]

    def _dict_comprehension(self, node: ast.DictComp, scope: Scope) -> Value:
        table: dict[Value, Value] = {}
        for inner in self._loops(node.generators, Scope({}, scope)):
            key = self.value(node.key, inner)
            if hashable(key):
                table[key] = self.value(node.value, inner)
        return table

    def _loops(self, generators: list[ast.comprehension], scope: Scope) -> Iterator[Scope]:
        if not generators:
            yield scope
            return
        first, *rest = generators
        items = self._items(self.value(first.iter, scope))
        for item in [Unknown(_source(first.target))] if items is None else items:
            self._assign(first.target, item, scope)
            if all(truth(self.value(test, scope)) is not False for test in first.ifs):
                yield from self._loops(rest, scope)

    def _binary(self, node: ast.BinOp, scope: Scope) -> Value:
        return binary(node.op, self.value(node.left, scope), self.value(node.right, scope))

    def _bool(self, node: ast.BoolOp, scope: Scope) -> Value:
        conjunction = isinstance(node.op, ast.And)
        open_parts: list[Template] = []
        value: Value = conjunction
        for part in node.values:
            value = self.value(part, scope)
            holds = truth(value)
            if isinstance(holds, bool):
                if holds is not conjunction:
                    return value
                continue
            open_parts.append(holds)
        if not open_parts:
            return value
        return Text((Substitution("and" if conjunction else "or", tuple(open_parts)),))

    def _unary(self, node: ast.UnaryOp, scope: Scope) -> Value:
        value = self.value(node.operand, scope)
        if isinstance(node.op, ast.Not):
            holds = truth(value)
            return not holds if isinstance(holds, bool) else Text(negated(holds))
        if isinstance(node.op, ast.USub) and isinstance(value, int | float):
            return -value
        return Unknown(_source(node))

    def _compare(self, node: ast.Compare, scope: Scope) -> Value:
        values = [self.value(part, scope) for part in (node.left, *node.comparators)]
        results = [compare(op, values[at], values[at + 1]) for at, op in enumerate(node.ops)]
        return results[0] if len(results) == 1 else Unknown(_source(node))

    def _if_expression(self, node: ast.IfExp, scope: Scope) -> Value:
        holds = truth(self.value(node.test, scope))
        if isinstance(holds, bool):
            return self.value(node.body if holds else node.orelse, scope)
        return _choice(holds, self.value(node.body, scope), self.value(node.orelse, scope))

    def _joined(self, node: ast.JoinedStr, scope: Scope) -> Value:
        return merged_text(tuple(part for value in node.values for part in template_of(self.value(value, scope))))

    def _call(self, node: ast.Call, scope: Scope) -> Value:
        callee = self.value(node.func, scope)
        given = self._arguments(node, scope)
        if isinstance(callee, Function):
            return self.call(callee, given)
        if isinstance(callee, Method):
            return self._method(callee, given)
        if isinstance(callee, Reference):
            return self._referenced(callee, given, node)
        return Unknown(_source(node))

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
            return Unknown(_source(node)) if isinstance(found, Unknown) else found
        return Unknown(_source(node))

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
                positional += self._items(self.value(part.value, scope)) or []
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

    def _items(self, value: Value) -> list[Value] | None:
        """Return what a loop goes over, None when that is not known."""
        if isinstance(value, Description):
            return value.actions[:MAX_ITEMS]
        return list(value)[:MAX_ITEMS] if isinstance(value, list | tuple | dict) else None

    def _step(self) -> None:
        self.steps += 1
        if self.steps > MAX_STEPS:
            raise TooLongError

    _EXPRESSIONS: dict[type[ast.expr], Callable[..., Value]] = {  # noqa: RUF012  # read only, one row per node
        ast.Constant: lambda _, node, __: node.value,
        ast.Name: _name,
        ast.Attribute: _attribute,
        ast.Subscript: _subscript,
        ast.Slice: _slice,
        ast.List: _list,
        ast.Tuple: _list,
        ast.Set: _list,
        ast.Dict: _dict,
        ast.ListComp: _comprehension,
        ast.GeneratorExp: _comprehension,
        ast.SetComp: _comprehension,
        ast.DictComp: _dict_comprehension,
        ast.BinOp: _binary,
        ast.BoolOp: _bool,
        ast.UnaryOp: _unary,
        ast.Compare: _compare,
        ast.IfExp: _if_expression,
        ast.JoinedStr: _joined,
        ast.FormattedValue: lambda self, node, scope: self.value(node.value, scope),
        ast.Call: _call,
        ast.Lambda: lambda _, node, scope: Function(node, scope),
    }


def _imported(node: ast.Import | ast.ImportFrom) -> Iterator[tuple[str, Reference]]:
    for alias in node.names:
        if isinstance(node, ast.ImportFrom):
            yield alias.asname or alias.name, Reference(f"{node.module or ''}.{alias.name}")
            continue
        name = alias.asname or alias.name.split(".")[0]
        yield name, Reference(alias.name if alias.asname else name)


def _is_set(name: str, scope: Scope) -> bool:
    current: Scope | None = scope
    while current is not None:
        if name in current.names:
            return True
        current = current.parent
    return False


def _choice(holds: Template, first: Value, second: Value) -> Value:
    """Return a value that depends on a condition; lists are joined, since all their items can occur."""
    if isinstance(first, list) and isinstance(second, list):
        return [*first, *(item for item in second if not any(item is known for known in first))]
    if isinstance(first, Action) and (second is None or isinstance(second, Action)):
        either = (*guarded((first,), holds, first.line), *guarded(actions_of(second), negated(holds), first.line))
        return Group(line=first.line, actions=either, scoped=False)
    if isinstance(first, dict) and isinstance(second, dict):
        return {**second, **first}
    if all(isinstance(value, str | Text | int | float | bool) for value in (first, second)):
        return Text((Substitution("if", (holds, template_of(first), template_of(second))),))
    if isinstance(first, Condition) or isinstance(second, Condition):
        return first if isinstance(first, Condition) else second
    return first if not isinstance(first, Unknown | type(None)) else second


def _returned(returned: list[tuple[Template | None, Value]], line: int) -> Value:
    if not returned:
        return None
    if len(returned) == 1:
        return returned[0][1]
    if any(actions_of(value) for _, value in returned):
        return [action for guard, value in returned for action in guarded(actions_of(value), guard, line)]
    result = returned[-1][1]
    for guard, value in reversed(returned[:-1]):
        result = value if guard is None else _choice(guard, value, result)
    return result


def _source(node: ast.AST) -> str:
    """Return what an expression looks like, cut short."""
    if isinstance(node, ast.Name):
        return node.id
    try:
        return ast.unparse(node)[:MAX_SHOWN]  # type: ignore[no-untyped-call,unused-ignore]
    except (RecursionError, ValueError):
        return type(node).__name__
