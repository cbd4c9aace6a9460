"""Variables outside of functions and classes of C++: their type, and what functions assign to them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from ecm_parsers.source.expr import Member, Name

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.places import whole_of
from ecm_extract.link.code.units import Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.scope import Definition, Scope
from ecm_extract.resolve.cpp_constants import Stated


class Mention(NamedTuple):
    """A function that may change a variable, with how it writes that."""

    func: Func
    written: str


class FileScope:
    """Looks up variables of namespaces; built on the first question."""

    def __init__(self, program: Program, scope: Scope) -> None:
        self.program = program
        self.scope = scope
        self._called: Mapping[str, list[Mention]] | None = None
        self._assigned: dict[str, list[Definition]] | None = None

    def type_of(self, name: str, env: Env) -> str:
        """Return the type of a variable as declared, empty when none of that name is visible."""
        if env.func.file.language != "cpp":
            return ""
        found = self.meant(name, env.func)
        return found.constant.type if found is not None and "enum" not in found.constant.traits else ""

    def meant(self, name: str, func: Func) -> Stated | None:
        """Return the constant or variable of a namespace that a name means in a function."""
        if name.rsplit("::", 1)[-1] not in self.program.constants:
            return None
        return self.program.constant_named(name, func.file, func.scope)

    def is_outside(self, name: str, func: Func) -> bool:
        """Tell whether a name in a method, or in a lambda of one, means a variable of a namespace."""
        cls = self.scope.nesting.object_of(func) if name.rpartition("::")[2] in self.program.constants else None
        if cls is None or any(name in entry.fields for entry in self.program.ancestry(cls)):
            return False
        return self.meant(name, func) is not None

    def definitions(self, name: str, env: Env) -> list[Definition]:
        """Return the assignments of a variable in all functions that see it."""
        if not self.type_of(name, env):
            return []
        if self._assigned is None:
            self._assigned = self._index()
        assigned = self._assigned.get(name.rsplit("::", 1)[-1], [])
        own = self.meant(name, env.func)
        return [entry for entry in assigned if self.meant(_target(entry), entry.func) == own]

    def is_changed(self, name: str, env: Env) -> bool:
        """Tell whether a function that sees a variable assigns it or a part of it, or calls a method of it."""
        if self.definitions(name, env):
            return True
        if self._called is None:
            self._called = self._receivers()
        found = self._called.get(name.rsplit("::", 1)[-1], ())
        own = self.meant(name, env.func)
        return any(self.meant(mention.written, mention.func) == own for mention in found)

    def _receivers(self) -> Mapping[str, list[Mention]]:
        """Variable -> the functions that call a method of it which changes it, give it parts, or take its address."""
        found: Mapping[str, list[Mention]] = defaultdict(list)
        known = calls_of("cpp")
        for functions in self.program.functions.values():
            for func in functions:
                for written in self._partly(func) if func.file.language == "cpp" else ():
                    found[written.rsplit("::", 1)[-1]].append(Mention(func, written))
                for call in (call for calls in func.calls for call in calls) if func.file.language == "cpp" else ():
                    callee = call.callee
                    if isinstance(callee, Member) and isinstance(callee.base, Name) and callee.name in known.changing:
                        found[callee.base.id.rsplit("::", 1)[-1]].append(Mention(func, callee.base.id))
                    last = callee.id.rsplit("::", 1)[-1] if isinstance(callee, Name) else ""
                    harmless = isinstance(callee, Member) or last in known.reading or last[:1].isupper()
                    for arg in call.args if not harmless else ():
                        if isinstance(arg, Name) and arg.id.rsplit("::", 1)[-1] in self.program.constants:
                            known_here = [] if self._hides(func, arg.id) else [Mention(func, arg.id)]
                            found[arg.id.rsplit("::", 1)[-1]] += known_here
        return found

    def _partly(self, func: Func) -> Iterator[str]:
        """The variables of namespaces that a function gives a field or an element."""
        for statement in func.fact.body:
            root = whole_of(statement.target) if statement.target is not None and statement.kind == "set" else None
            while root is not None and not isinstance(root, Name):
                root = whole_of(root)
            if isinstance(root, Name) and root.id.rsplit("::", 1)[-1] in self.program.constants:
                yield from [] if self._hides(func, root.id) else [root.id]

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
            if name in self.program.constants and not self._hides(func, statement.target.id):
                found.append((name, Definition(func, at)))
        return found

    def _hides(self, func: Func, name: str) -> bool:
        """Tell whether the name is a local, a parameter or a member there."""
        body = func.fact.body
        if any(body[at].kind != "set" for at in self.scope.locals_of(func).get(name, ())):
            return True
        own = any(parameter.name == name for parameter in func.fact.params)
        lineage = self.program.ancestry(func.cls) if func.cls is not None else ()
        field = next((each.fields[name] for each in lineage if name in each.fields), None)
        return own or (field is not None and "static" not in field.traits)


def _target(definition: Definition) -> str:
    target = definition.statement.target
    return target.id if isinstance(target, Name) else ""
