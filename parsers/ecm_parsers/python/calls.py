"""Calls of Python: functions and classes of the file and of its modules, and what libraries make."""

from __future__ import annotations

import ast
import builtins
import sys
from abc import abstractmethod
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, TypeAlias

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.classes import filled_fields, is_instance, is_substitution, made_by_base, member, super_of
from ecm_parsers.python.expressions import Expressions
from ecm_parsers.python.imports import Imports
from ecm_parsers.python.methods import call_builtin
from ecm_parsers.python.models import Models
from ecm_parsers.python.reading import exists, globbed, loaded
from ecm_parsers.python.sources import NoSources, Sources
from ecm_parsers.python.spelling import source_of
from ecm_parsers.python.values import (
    Class,
    Function,
    Many,
    Method,
    Module,
    Object,
    Reference,
    Scope,
    Super,
    Text,
    Unknown,
    Value,
)
from ecm_parsers.python.watching import Watcher
from ecm_parsers.template import Template

MAX_CALLS = 20
Returned: TypeAlias = list[tuple[Template | None, Value]]
"""What statements return, each with the condition under which."""
_OF_DATA = frozenset({"get", "items", "keys", "values"})
_OF_PATHS: Mapping[str, Callable[[Sources, Value, Value], Value]] = MappingProxyType(
    {
        "exists": lambda sources, path, _: exists(sources, path),
        "is_file": lambda sources, path, _: exists(sources, path),
        "glob": globbed,
    }
)


class Calls(Expressions):
    """Evaluates calls; whoever reads statements runs the bodies. `module` holds the names of the file."""

    def __init__(
        self, models: Models, names: dict[str, Value], sources: Sources | None = None, watcher: Watcher | None = None
    ) -> None:
        super().__init__(models, watcher)
        self.sources = sources or NoSources()
        self.imports = Imports(self.sources, models, self._module)
        self.module = Scope(names)
        self._depth = 0
        self._guard: Template | None = None
        self._site = 0

    @abstractmethod
    def returned(self, found: Returned, line: int) -> Value:
        """Return what a function gives of what it returns, each with the condition under which."""

    @abstractmethod
    def run(self, body: list[ast.stmt], scope: Scope) -> Returned:
        """Read statements; returns what they return, each with the condition under which."""

    def loaded(self, value: Value) -> Value:
        """Return the data of a YAML file that a value names, else the value."""
        return loaded(self.sources, value)

    def _module(self, tree: ast.Module, scope: Scope) -> None:
        """Read the statements of an imported module."""
        outer, self._guard = self._guard, None
        self.run(tree.body, scope)
        self._guard = outer

    def call_of(self, node: ast.Call, scope: Scope) -> Value:
        """Return what a call gives."""
        callee = self.value(node.func, scope)
        given = self._arguments(node, scope)
        if isinstance(callee, Function):
            return self.call(callee, given)
        if isinstance(callee, Method):
            return self._method(callee, given, node.func)
        if isinstance(callee, Class):
            return self._object(callee, given)
        if isinstance(callee, Reference):
            found = super_of(scope) if callee.path == "super" else self._referenced(callee, given)
            if not isinstance(found, Unknown):
                return found
            self.watcher.unread(callee.path, given)
        return Unknown(source_of(node), 0 if _starts_nothing(node.func) else given.line)

    def _object(self, cls: Class, given: Arguments) -> Value:
        made = Object(cls, given.line)
        start = member(cls, "__init__", made)
        if isinstance(start, Function):
            self.call(start, given)
        else:
            made.made = made_by_base(cls, given, self.models)
            filled_fields(made, given)
        performed = member(cls, "perform", made) if made.made is None and is_substitution(cls) else None
        if isinstance(performed, Function):
            text = self.call(performed, Arguments((Unknown("context"),), {}, given.line))
            made.made = text if isinstance(text, str | Text) else None
        return made

    def _super_method(self, owner: Super, name: str, given: Arguments) -> Value:
        above = member(owner.cls, name, owner.holder, above=True)
        if isinstance(above, Function):
            return self.call(above, given)
        if name == "__init__" and isinstance(owner.holder, Object):
            owner.holder.made = made_by_base(owner.cls, given, self.models, above=True)
        return None

    def _method(self, callee: Method, given: Arguments, written: ast.expr) -> Value:
        if isinstance(callee.owner, Module):
            return callee.owner
        if isinstance(callee.owner, Super):
            return self._super_method(callee.owner, callee.name, given)
        if isinstance(callee.owner, Text | str) and callee.name in _OF_PATHS:
            return _OF_PATHS[callee.name](self.sources, callee.owner, given.get("", 0))
        owner = self.loaded(callee.owner) if callee.name in _OF_DATA else callee.owner
        return self.method(owner, callee.name, given, written)

    def _referenced(self, callee: Reference, given: Arguments) -> Value:
        special = self.SPECIAL.get(callee.last)
        if special is not None:
            return special(self, given)
        table = self.models.tables.get(callee.path.removesuffix(".get").rpartition(".")[2])
        if table is not None and callee.last == "get":
            return table(given)
        if callee.last == "__init__" and isinstance(given.get("", 0), Object):
            return self._initialised(callee, given)
        constructor = self.models.calls.get(callee.last)
        if constructor is not None:
            return self.made(constructor(given))
        if callee.last in self.models.loaders:
            return self.imports.at(given.template("path", self.models.loaders[callee.last])) or Unknown(callee.last)
        return self._imported_call(callee, given) if "." in callee.path else call_builtin(callee.path, given)

    def made(self, value: Value) -> Value:
        """Return what a call of a library makes, after taking note of it."""
        return value

    def _initialised(self, callee: Reference, given: Arguments) -> None:
        """`Node.__init__(self, ...)`, as `super().__init__(...)` was written."""
        constructor = self.models.calls.get(callee.path.split(".")[-2])
        if constructor is not None:
            given.positional[0].made = constructor(Arguments(given.positional[1:], given.keywords, given.line))

    def _imported_call(self, callee: Reference, given: Arguments) -> Value:
        """A function by the dotted name of its module."""
        origin, _, name = callee.path.rpartition(".")
        found = self.imports.member(origin, name)
        if isinstance(found, Function):
            return self.call(found, given)
        return self._object(found, given) if isinstance(found, Class) else Unknown(callee.path)

    def _getattr(self, given: Arguments) -> Value:
        otherwise = given.get("", 2)
        found = self.attribute(given.get("", 0), str(given.get("", 1)), given.line)
        return otherwise if isinstance(found, Unknown | Reference | Method) and otherwise is not None else found

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
                keywords.update({str(_perhaps(name)): entry for name, entry in value.items()})
        return Arguments(tuple(positional), keywords, self._site or node.lineno)

    def call(self, function: Function, given: Arguments) -> Value:
        """Return what a function returns; several returns are joined under their conditions."""
        if self._depth >= MAX_CALLS:
            return Unknown("deep call")
        given = Arguments((*function.first, *given.positional), given.keywords, given.line)
        scope = Scope(self._bound(function, given), function.scope)
        if function.owner is not None:
            scope.names.update({"__class__": function.owner, "__holder__": (*function.first, None)[0]})
        if isinstance(function.node, ast.Lambda):
            return self.value(function.node.body, scope)
        outer = self._guard
        self._guard = outer if self.IS_STRICT else None
        site, self._site = self._site, self._site or (given.line if self._is_foreign(function) else 0)
        self._depth += 1
        try:
            returned = self.run(function.node.body, scope)
        finally:
            self._depth -= 1
            self._guard, self._site = outer, site
        sure = [(None if guard is outer else guard, value) for guard, value in returned]
        return self.returned(sure, given.line)

    def _is_foreign(self, function: Function) -> bool:
        """Lines of another file say nothing in this one: what its functions make is placed where they are called."""
        scope: Scope | None = function.scope
        while scope is not None and scope is not self.module:
            scope = scope.parent
        return scope is None

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

    SPECIAL: dict[str, Callable[[Any, Arguments], Value]] = {  # noqa: RUF012  # read only, one row per function
        "getattr": _getattr,
        "isinstance": lambda _, given: is_instance(given.get("", 0), given.get("", 1)),
        "exists": lambda self, given: exists(self.sources, given.get("path", 0)),
        "isfile": lambda self, given: exists(self.sources, given.get("path", 0)),
        "module_from_spec": lambda _, given: given.get("spec", 0),
    }


def _perhaps(name: Value) -> Value:
    return name.each if isinstance(name, Many) else name


def _starts_nothing(callee: ast.expr) -> bool:
    """Tell whether a call is one of Python itself: `print`, `os.remove`."""
    while isinstance(callee, ast.Attribute):
        callee = callee.value
    return isinstance(callee, ast.Name) and (callee.id in sys.stdlib_module_names or hasattr(builtins, callee.id))
