"""Fields of C++ objects that others than methods give something: who makes an object in braces, or assigns one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.scope import Definition
from ecm_extract.link.running.values import Value, lowered, set_by
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TAKEN: Final = shipped_names("link/code/library_values.toml", "parameter_values")


class GivenFields:
    """Tells which fields others give values; each field of a class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[str, Cls], bool] = {}
        self._read: dict[tuple[str, Cls], tuple[Value, ...]] = {}
        self._written: dict[tuple[str, str], frozenset[str]] = {}

    def is_given(self, name: str, cls: Cls) -> bool:
        """Tell whether a field of some object of a class may not be what the class declares it with."""
        known = self._known.get((name, cls))
        if known is None:
            self._known[name, cls] = False  # who asks in a circle
            given = self._in_braces(name, cls) or self._assigned(name, cls)
            known = self._known[name, cls] = given or self._is_changed(name, cls)
        return known

    def _is_changed(self, name: str, cls: Cls) -> bool:
        """Whether a function changes the field of some object in any other way, or points to it."""
        if cls.file.language != "cpp":
            return False
        others = self.folder.changed_outside
        return others.is_changed(name, cls) or others.is_pointed_to(name, cls) or self._is_shared(name, cls)

    def _is_shared(self, name: str, cls: Cls) -> bool:
        """Whether a field is one for all objects, and methods give it something, which other objects may run, too."""
        owner = next((each for each in self.folder.program.ancestry(cls) if name in each.fields), None)
        if owner is None or owner.file.language != "cpp" or "static" not in owner.fields[name].traits:
            return False
        touching = self.folder.scope.changing(name, owner)
        return any(f".{name}" in self.folder.flow.outline(method).given for method in touching)

    def _in_braces(self, name: str, cls: Cls) -> bool:
        names = [field.name for field in cls.fact.fields]
        plainly = name in names and not any(method.is_constructor for method in cls.methods)
        return plainly and names.index(name) < self._most.get(cls.fact.name, 0)

    def _assigned(self, name: str, cls: Cls) -> bool:
        return any(self._is_of(entry, cls) for entry in self.folder.scope.assigned_outside(name, "cpp"))

    def of_parameters(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        """Return what a field has as long as nobody sets a parameter: nothing but that parameter is assigned to it.

        Nothing is returned where anybody gives it anything else, or its objects are made with anything else.
        """
        known = self._read.get((name, cls))
        if known is None:
            self._read[name, cls] = ()  # who asks in a circle
            known = self._read[name, cls] = self._read_into(name, cls, env)
        return known

    def _read_into(self, name: str, cls: Cls, env: Env) -> tuple[Value, ...]:
        field = cls.fields.get(name)
        if field is None or self._in_braces(name, cls):
            return ()
        own = [entry for entry in self.folder.scope.assigned_outside(name, "cpp") if self._is_of(entry, cls)]
        kept = self._kept(name, cls, own, env)
        if kept:
            return kept
        found = [self._value(entry) for entry in own]
        both = zip(found, own, strict=True)
        read = [values for values, entry in both if not (_are_open(values) and self._is_taken(entry))]
        if not read or any(values != read[0] or len(values) != 1 for values in read):
            return ()
        begun = self.folder.fold(field.default, Env(env.func, this=cls)) if field.default is not None else read[0]
        is_read = bool(read[0][0].parameter) and read[0][0].confidence == "default"
        return read[0] if is_read and begun[0].parts == read[0][0].parts else ()

    def _kept(self, name: str, cls: Cls, own: Sequence[Definition], env: Env) -> tuple[Value, ...]:
        """What a field is declared with, where it is itself the default of the parameter that it is assigned."""
        default = cls.fields[name].default
        asked = {entry: self._asked(entry) for entry in own}
        others = [entry for entry, parameter in asked.items() if parameter is None]
        names = {parameter for parameter in asked.values() if parameter is not None}
        if default is None or len(names) != 1 or not all(map(self.is_set_later, others)) or self._is_replaced(cls):
            return ()
        return set_by(names.pop(), lowered(self.folder.fold(default, Env(env.func, this=cls)), "default"))

    def is_set_later(self, entry: Definition) -> bool:
        """Tell whether an assignment of C++ takes what somebody sets out of the parameter that he hands over."""
        return entry.func.file.language == "cpp" and self._is_taken(entry) and _are_open(self._value(entry))

    def _value(self, entry: Definition) -> tuple[Value, ...]:
        return self.folder.fold(entry.statement.value, Env(entry.func, entry.at))

    def _asked(self, entry: Definition) -> str | None:
        """The parameter that a field is given, whose default it is: `s.x = node.declare_parameter("x", s.x)`."""
        value, place = entry.statement.value, Env(entry.func, entry.at)
        read = self.folder.reads.read(invocation_of(value, place)) if isinstance(value, Call) else None
        if read is None or read.default is None or read.default != entry.statement.target:
            return None
        return self.folder.fold(read.name, place)[0].text

    def _is_replaced(self, cls: Cls) -> bool:
        """Whether somebody assigns a whole object of a class, or what may be one."""
        return any(
            self.folder.objects.class_of(statement.target, Env(func, at)) is cls
            for func in self._functions
            for at, statement in enumerate(func.fact.body)
            if statement.kind == "set" and isinstance(statement.target, Name | Member)
        )

    def _is_taken(self, entry: Definition) -> bool:
        """Whether an assignment takes what it gives out of a parameter that somebody hands over."""
        value = entry.statement.value
        if not isinstance(value, Call) or not isinstance(value.callee, Member) or value.callee.name not in _TAKEN:
            return False
        of = self.folder.objects.type_of(value.callee.base, Env(entry.func, entry.at))
        return last_name(plain(pointee(of))) == "Parameter"

    def is_reached_into(self, path: str, language: str = "cpp") -> bool:
        """Tell whether somebody assigns `object.member.field`, of whatever object; `path` is `.member.field`."""
        return any(name.endswith(path) for name in self._assigned_as(last_name(path), language))

    def _assigned_as(self, name: str, language: str) -> frozenset[str]:
        """How fields of one name are written where they are assigned, other than on the object at hand."""
        known = self._written.get((name, language))
        if known is None:
            targets = (entry.statement.target for entry in self.folder.scope.assigned_outside(name, language))
            known = frozenset(dotted_name(each) for each in targets if each is not None and not _is_own(each))
            self._written[name, language] = known
        return known

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


def _are_open(values: Sequence[Value]) -> bool:
    """Tell whether nothing shows what something is."""
    return all(each.confidence == "pattern" for each in values)


def _is_own(expr: Expr) -> bool:
    """Tell whether something is a part of the object at hand."""
    while isinstance(expr, Member):
        expr = expr.base
    return expr == THIS
