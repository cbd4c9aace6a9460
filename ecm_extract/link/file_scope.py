"""Variables outside of functions and classes of C++: their type, and what functions assign to them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

from ecm_parsers.source.expr import Member, Name

from ecm_extract.infer.effects import calls_of
from ecm_extract.link.env import Env
from ecm_extract.link.program import Program
from ecm_extract.link.scope import Definition, Scope
from ecm_extract.link.units import Func


class FileScope:
    """Looks up variables of namespaces; built on the first question."""

    def __init__(self, program: Program, scope: Scope) -> None:
        self.program = program
        self.scope = scope
        self._called: Mapping[str, list[Func]] | None = None
        self._assigned: dict[str, list[Definition]] | None = None

    def type_of(self, name: str, env: Env) -> str:
        """Return the type of a variable as declared, empty when none of that name is visible."""
        if env.func.file.language != "cpp":
            return ""
        last = name.rsplit("::", 1)[-1]
        near = [
            (self.program.nearness(file, env.func.file), constant.type)
            for file, constant in self.program.constants.get(last, ())
            if constant.type and file.language == "cpp" and "enum" not in constant.traits
        ]
        return max((entry for entry in near if entry[0]), key=lambda entry: entry[0], default=(0, ""))[1]

    def definitions(self, name: str, env: Env) -> list[Definition]:
        """Return the assignments of a variable in all functions that see it."""
        if not self.type_of(name, env):
            return []
        if self._assigned is None:
            self._assigned = self._index()
        found = self._assigned.get(name.rsplit("::", 1)[-1], [])
        return [entry for entry in found if self.program.nearness(entry.func.file, env.func.file)]

    def is_changed(self, name: str, env: Env) -> bool:
        """Tell whether a function that sees a variable assigns it, or calls a method of it."""
        if self.definitions(name, env):
            return True
        if self._called is None:
            self._called = self._receivers()
        found = self._called.get(name.rsplit("::", 1)[-1], ())
        return any(self.program.nearness(func.file, env.func.file) for func in found)

    def _receivers(self) -> Mapping[str, list[Func]]:
        """Variable -> the functions that call a method of it which changes it, or that take its address."""
        found: Mapping[str, list[Func]] = defaultdict(list)
        known = calls_of("cpp")
        for functions in self.program.functions.values():
            for func in functions:
                for call in (call for calls in func.calls for call in calls) if func.file.language == "cpp" else ():
                    callee = call.callee
                    if isinstance(callee, Member) and isinstance(callee.base, Name) and callee.name in known.changing:
                        found[callee.base.id.rsplit("::", 1)[-1]].append(func)
                    last = callee.id.rsplit("::", 1)[-1] if isinstance(callee, Name) else ""
                    harmless = isinstance(callee, Member) or last in known.reading or last[:1].isupper()
                    for arg in call.args if not harmless else ():
                        if isinstance(arg, Name) and arg.id.rsplit("::", 1)[-1] in self.program.constants:
                            found[arg.id.rsplit("::", 1)[-1]] += [func] * (not self._hides(func, arg.id))
        return found

    def _index(self) -> dict[str, list[Definition]]:
        index: dict[str, list[Definition]] = defaultdict(list)
        for functions in self.program.functions.values():
            for func in functions:
                if func.file.language == "cpp":
                    for name, definition in self._assignments(func):
                        index[name].append(definition)
        return index

    def _assignments(self, func: Func) -> list[tuple[str, Definition]]:
        found = []
        for at, statement in enumerate(func.fact.body):
            if statement.kind != "set" or not isinstance(statement.target, Name) or statement.value is None:
                continue
            name = statement.target.id.rsplit("::", 1)[-1]
            if name in self.program.constants and not self._hides(func, name):
                found.append((name, Definition(func, at)))
        return found

    def _hides(self, func: Func, name: str) -> bool:
        """Tell whether the name is a local, a parameter or a member there."""
        body = func.fact.body
        if any(body[at].kind != "set" for at in self.scope.locals_of(func).get(name, ())):
            return True
        own = any(parameter.name == name for parameter in func.fact.params)
        return own or bool(self.scope.member_type(name, func.cls))
