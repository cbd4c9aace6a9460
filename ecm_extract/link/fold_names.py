"""Names: locals, parameters, members and constants that an identifier can mean."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import (
    Expr,
    Name,
)

from ecm_extract.link.env import Env, bind, invocation_of
from ecm_extract.link.scope import Definition
from ecm_extract.link.spelling import last_name
from ecm_extract.link.units import File
from ecm_extract.link.values import (
    Value,
    demoted,
    lowered,
    parameter,
    unique,
    unknown,
)

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


@cache
def outside_constants() -> Mapping[str, str]:
    """Return constants of public headers outside the tree by their own name."""
    text = (resources.files("ecm_extract.link") / "outside_constants.toml").read_text("utf-8")
    return MappingProxyType(tomllib.loads(text)["constants"])


class NameFolder:
    """Folds identifiers."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def name(self, expr: Name, env: Env) -> tuple[Value, ...]:
        """A variable, a parameter, a member of `this`, or a constant."""
        return self.folder.once(expr.id, env, lambda: self._name(expr.id, env))

    def _name(self, name: str, env: Env) -> tuple[Value, ...]:
        found = self._local(name, env)
        if found and self.folder.scope.is_certain(name, env):
            return found
        base = self._given(name, env)
        if found or base:
            return unique((*base, *found))
        return self._outside(name, env) or (unknown(name),)

    def _given(self, name: str, env: Env) -> tuple[Value, ...]:
        """What a name is before the function assigns it: its parameter, or a member of the object."""
        if any(entry.name.lstrip("*") == name for entry in env.func.fact.params):
            return self._parameter(name, env)
        cls = env.this or env.func.cls
        if cls is None or env.func.file.language != "cpp":
            return ()
        return self.folder.members.member_value(name, cls, env)

    def _local(self, name: str, env: Env) -> tuple[Value, ...]:
        values: list[Value] = []
        for definition in self.folder.scope.local(name, env):
            values += self._defined(definition, env.before(definition.at))
        for at, read, default in self.folder.reads.written(env.func, name):
            if at < env.at:
                values += self.folder.calls.parameter_value(read, default, env.before(at))
        return unique(values or self._by_reference(name, env)) if values or not env.args.get(name) else ()

    def _by_reference(self, name: str, env: Env) -> list[Value]:
        """What functions of the tree write to a local that they get by reference."""
        values: list[Value] = []
        for at, expr, index in self.folder.scope.passed(env.func, name):
            if at >= env.at:
                continue
            outer = env.before(at)
            call = invocation_of(expr, outer)
            callee = self.folder.objects.callee(call, outer)
            if callee is None or callee is env.func or index >= len(callee.fact.params):
                continue
            target = callee.fact.params[index]
            if target.type.endswith("&") and "const" not in target.type:
                given = {key: bound for key, bound in bind(callee, call, outer).items() if key != target.name}
                inner = Env(callee, args=given, this=env.this, made=env.made, depth=env.depth + 1)
                found = self._local(target.name, inner)
                always = any(entry.statement.depth == 0 for entry in self.folder.scope.local(target.name, inner))
                values += found if always else lowered(found, "default")
        return values

    def _defined(self, definition: Definition, env: Env) -> tuple[Value, ...]:
        statement = definition.statement
        if statement.kind == "each":
            return self.folder.lists.elements(statement.value, env)
        return demoted(self.folder.fold(statement.value, env))

    def _parameter(self, name: str, env: Env) -> tuple[Value, ...]:
        bound = env.args.get(name)
        if bound is not None:
            return demoted(self.folder.fold(bound.expr, bound.env.before(bound.env.at)))
        made = self._constructor_argument(name, env)
        if made:
            return made
        default = next((entry.default for entry in env.func.fact.params if entry.name == name), None)
        if default is not None and env.args:
            return lowered(self.folder.fold(default, env.before(0)), "default")
        return (parameter(name, env.func.is_constructor, self._fallback(default, env)),)

    def _fallback(self, default: Expr | None, env: Env) -> str | None:
        """The text of a parameter's default, when it is one."""
        value = self.folder.fold(default, Env(env.func, 0, depth=env.depth + 1))[0] if default is not None else None
        known = value is not None and value.confidence != "pattern" and value.text != "null"
        return value.text if value is not None and known else None

    def _constructor_argument(self, name: str, env: Env) -> tuple[Value, ...]:
        func = env.func
        if not func.is_constructor or env.made is None or func.cls is None:
            return ()
        instance = self.folder.objects.part(env.made, func.cls)
        bound = instance.args.get(name) if instance is not None else None
        return demoted(self.folder.fold(bound.expr, bound.env.before(bound.env.at))) if bound is not None else ()

    def _outside(self, name: str, env: Env) -> tuple[Value, ...]:
        constant = self.folder.scope.constant(name, env)
        if constant is not None:
            expr, _, file = constant
            inner = Env(self._file_env(file, env).func, depth=env.depth + 1)
            return demoted(self.folder.fold(expr, inner))
        if env.func.file.language == "python":
            return self.imported(name, env)
        text = outside_constants().get(last_name(name))
        return () if text is None else (Value((text,), "folded"),)

    def _file_env(self, file: File, env: Env) -> Env:
        func = next((f for f in self.folder.program.functions_in(file) if f.fact.name == "<module>"), None)
        return Env(func) if func is not None else env

    def imported(self, dotted: str, env: Env) -> tuple[Value, ...]:
        """A constant of another Python module, by its dotted name."""
        found = self.folder.program.constant_named(dotted, env.func.file)
        if found is None or found.constant.value is None:
            return ()
        inner = Env(self._file_env(found.file, env).func, depth=env.depth + 1)
        return demoted(self.folder.fold(found.constant.value, inner))
