"""Fields of C++ objects that others than methods give something: who makes an object in braces, or assigns one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Items, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.scope import Definition

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class GivenFields:
    """Tells which fields others give values; each field of a class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[str, Cls], bool] = {}

    def is_given(self, name: str, cls: Cls) -> bool:
        """Tell whether a field of some object of a class may not be what the class declares it with."""
        known = self._known.get((name, cls))
        if known is None:
            self._known[name, cls] = False  # who asks in a circle
            known = self._known[name, cls] = self._in_braces(name, cls) or self._assigned(name, cls)
        return known

    def _in_braces(self, name: str, cls: Cls) -> bool:
        names = [field.name for field in cls.fact.fields]
        plainly = name in names and not any(method.is_constructor for method in cls.methods)
        return plainly and names.index(name) < self._most.get(cls.fact.name, 0)

    def _assigned(self, name: str, cls: Cls) -> bool:
        return any(self._is_of(entry, cls) for entry in self.folder.scope.assigned_outside(name, "cpp"))

    def is_reached_into(self, path: str) -> bool:
        """Tell whether somebody assigns `object.member.field`, of whatever object; `path` is `.member.field`."""
        targets = (entry.statement.target for entry in self.folder.scope.assigned_outside(last_name(path), "cpp"))
        written = (dotted_name(target) for target in targets if target is not None)
        return any(name.endswith(path) for name in written)

    def _is_of(self, entry: Definition, cls: Cls) -> bool:
        target = entry.statement.target
        place = Env(entry.func, entry.at)
        owner = self.folder.objects.class_of(target.base, place) if isinstance(target, Member) else None
        return owner is not None and cls in self.folder.program.ancestry(owner)

    @cached_property
    def _functions(self) -> Sequence[Func]:
        groups = self.folder.program.functions.values()
        return [func for group in groups for func in group if func.file.language == "cpp"]

    @cached_property
    def _most(self) -> Mapping[str, int]:
        """Name of a class -> the most values that an object of it is made from in a statement."""
        found: dict[str, int] = {}
        for func in self._functions:
            for statement, calls in zip(func.fact.body, func.calls, strict=True):
                made = [(last_name(call.callee.id), len(call.args)) for call in calls if isinstance(call.callee, Name)]
                if isinstance(statement.value, Items):
                    made.append((last_name(plain(statement.type)), len(statement.value.items)))
                for name, count in made:
                    if name in self.folder.program.classes:
                        found[name] = max(count, found.get(name, 0))
        return found
