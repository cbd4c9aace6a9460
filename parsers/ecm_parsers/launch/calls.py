"""Calls of Python launch files: functions and classes of the file and of its modules, and what `launch` makes."""

from __future__ import annotations

import ast
import builtins
import sys
from abc import abstractmethod
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ecm_parsers.launch.arguments import Arguments
from ecm_parsers.launch.classes import filled_fields, is_instance, is_substitution, made_by_base, member, super_of
from ecm_parsers.launch.constructors import CONSTRUCTORS
from ecm_parsers.launch.expressions import Expressions, choice, source_of
from ecm_parsers.launch.imports import LOADERS, Imports
from ecm_parsers.launch.methods import call_builtin, call_method
from ecm_parsers.launch.model import Action, Argument, Group, Substitution, Template
from ecm_parsers.launch.reading import exists, globbed, loaded, virtual_joints
from ecm_parsers.launch.sources import NoSources, Sources
from ecm_parsers.launch.values import (
    Class,
    Function,
    Method,
    Module,
    Object,
    Reference,
    Scope,
    Super,
    Text,
    Unknown,
    Value,
    actions_of,
    as_str,
    guarded,
    starts_something,
)

MAX_CALLS = 20
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

    def __init__(self, sources: Sources | None = None) -> None:
        super().__init__()
        self.sources = sources or NoSources()
        self.imports = Imports(self.sources, self._module)
        self.module = Scope({"__file__": Text((Substitution("dirname"), "/launch.py"))})
        self._depth = 0
        self._guard: Template | None = None
        self._site = 0

    @abstractmethod
    def run(self, body: list[ast.stmt], scope: Scope) -> list[tuple[Template | None, Value]]:
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
            return self._method(callee, given)
        if isinstance(callee, Class):
            return self._object(callee, given)
        if isinstance(callee, Reference):
            found = super_of(scope) if callee.path == "super" else self._referenced(callee, given)
            if not isinstance(found, Unknown):
                return found
        return Unknown(source_of(node), 0 if _starts_nothing(node.func) else given.line)

    def _object(self, cls: Class, given: Arguments) -> Value:
        made = Object(cls, given.line)
        start = member(cls, "__init__", made)
        if isinstance(start, Function):
            self.call(start, given)
        else:
            made.made = made_by_base(cls, given)
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
            owner.holder.made = made_by_base(owner.cls, given, above=True)
        return None

    def _method(self, callee: Method, given: Arguments) -> Value:
        if callee.name in {"append", "add_action", "extend", "insert"} and self._guard is not None:
            positional = tuple(self._under_guard(value, given.line) for value in given.positional)
            given = Arguments(positional, given.keywords, given.line)
        if isinstance(callee.owner, Module):
            return callee.owner
        if isinstance(callee.owner, Super):
            return self._super_method(callee.owner, callee.name, given)
        if isinstance(callee.owner, Action) or callee.name == "get_package_share_directory":
            return Unknown(callee.name)
        if isinstance(callee.owner, Text | str) and callee.name in _OF_PATHS:
            return _OF_PATHS[callee.name](self.sources, callee.owner, given.get("", 0))
        owner = self.loaded(callee.owner) if callee.name in _OF_DATA else callee.owner
        return call_method(owner, callee.name, given)

    def _under_guard(self, value: Value, line: int) -> Value:
        if isinstance(value, list | tuple):
            return [self._under_guard(item, line) for item in value]
        if not isinstance(value, Action | Object):
            return value
        found = guarded(actions_of(value), self._guard, line)
        return found[0]

    def _referenced(self, callee: Reference, given: Arguments) -> Value:
        special = self._SPECIAL.get(callee.last)
        if special is not None:
            return special(self, given)
        if callee.path.endswith("environ.get"):
            return as_str(CONSTRUCTORS["getenv"](given))
        if callee.path == "launch_configurations.get":
            return as_str(CONSTRUCTORS["LaunchConfiguration"](given))
        if callee.last == "__init__" and isinstance(given.get("", 0), Object):
            return self._initialised(callee, given)
        constructor = CONSTRUCTORS.get(callee.last)
        if constructor is not None:
            return self._noted(constructor(given))
        if callee.last in LOADERS:
            return self.imports.at(given.template("path", LOADERS[callee.last])) or Unknown(callee.last)
        return self._imported_call(callee, given) if "." in callee.path else call_builtin(callee.path, given)

    def _noted(self, made: Value) -> Value:
        if isinstance(made, Argument) and made.default is not None:
            self.sources.declared(made.name, made.default)
        return made

    def _initialised(self, callee: Reference, given: Arguments) -> None:
        """`Node.__init__(self, ...)`, as `super().__init__(...)` was written."""
        constructor = CONSTRUCTORS.get(callee.path.split(".")[-2])
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

    def _opaque(self, given: Arguments) -> Value:
        function = given.get("function", 0)
        extra = given.get("args", default=()) or ()
        if not isinstance(function, Function):
            unread = actions_of(Unknown(_called(function), given.line))
            return Group(line=given.line, condition=given.condition, actions=unread, scoped=False)
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
        outer, self._guard = self._guard, None
        site, self._site = self._site, self._site or (given.line if self._is_foreign(function) else 0)
        self._depth += 1
        try:
            returned = self.run(function.node.body, scope)
        finally:
            self._depth -= 1
            self._guard, self._site = outer, site
        return _returned(returned, given.line)

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

    _SPECIAL: dict[str, Callable[[Calls, Arguments], Value]] = {  # noqa: RUF012  # read only, one row per function
        "OpaqueFunction": _opaque,
        "getattr": _getattr,
        "isinstance": lambda _, given: is_instance(given.get("", 0), given.get("", 1)),
        "exists": lambda self, given: exists(self.sources, given.get("path", 0)),
        "isfile": lambda self, given: exists(self.sources, given.get("path", 0)),
        "srdf_virtual_joints": lambda self, given: virtual_joints(self.sources, given.get("", 0)),
        "perform_substitution": lambda _, given: as_str(given.get("", 0)),
        "getenv": lambda _, given: as_str(CONSTRUCTORS["getenv"](given)),
        "module_from_spec": lambda _, given: given.get("spec", 0),
    }


def _called(value: Value) -> str:
    """How a function that is not of the tree is written."""
    return value.path if isinstance(value, Reference) else value.text if isinstance(value, Unknown) else "function"


def _starts_nothing(callee: ast.expr) -> bool:
    """Tell whether a call is one of Python itself: `print`, `os.remove`."""
    while isinstance(callee, ast.Attribute):
        callee = callee.value
    return isinstance(callee, ast.Name) and (callee.id in sys.stdlib_module_names or hasattr(builtins, callee.id))


def _returned(returned: list[tuple[Template | None, Value]], line: int) -> Value:
    if not returned:
        return None
    if len(returned) == 1:
        return returned[0][1]
    if any(starts_something(value) for _, value in returned):
        return [action for guard, value in returned for action in guarded(actions_of(value), guard, line)]
    result = returned[-1][1]
    for guard, value in reversed(returned[:-1]):
        result = value if guard is None else choice(guard, value, result)
    return result
