"""Enumerations of Python: which member an expression is, what it holds and is called (docs.python.org, enum)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op

from ecm_extract.infer.compute import UNKNOWN, is_number
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Value, data_in, demoted, is_proved, literal, unknown
from ecm_extract.shipped import shipped, shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TABLE: Final = "link/folding/enums.toml"
_AUTO: Final = frozenset({"enum.auto", "auto"})
_VALUE: Final = frozenset({"value", "_value_"})
_LOOKING_UP: Final = frozenset({"_missing_", "__new__", "__init__"})
"""Methods by which an enumeration says itself what a value stands for."""
_COMPARING: Final = frozenset({"__eq__", "__ne__"})
_NAME: Final = frozenset({"name", "_name_"})


class Enumerated(NamedTuple):
    """A member of an enumeration, by the first name that it has."""

    cls: Cls
    name: str


class EnumFolder:
    """Knows the members of enumerations; each class is looked at once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._members: dict[Cls, Mapping[str, Expr] | None] = {}

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what `member.value` or `member.name` is; empty of what is no member."""
        if env.func.file.language != "python" or expr.name not in _VALUE | _NAME:
            return ()
        if isinstance(expr.base, Member) and self._is_opaque(expr.base.base, env):
            return (unknown(expr.name),)
        found = self.member(expr.base, env)
        if found is None:
            return ()
        if expr.name in _NAME:
            known = self._first_names(found.cls, env)
            name = known.get(found.name) if known is not None else None
            return (_folded(name),) if name is not None else (unknown(expr.name),)
        return self._held(found, env)

    def text(self, expr: Expr, env: Env, formats: bool) -> tuple[Value, ...]:
        """Return what `str(member)`, or a format, makes of a member; empty of what is no member."""
        found = self.member(expr, env) if env.func.file.language == "python" else None
        if found is None:
            return ()
        lineage = self.folder.program.ancestry(found.cls)
        methods = [each for entry in lineage for each in entry.methods if each.fact.name in {"__str__", "__format__"}]
        bodies = [[each.value for each in method.fact.body] for method in methods]
        if methods:
            plain = len(methods) == 1 and methods[0].fact.name == "__str__" and bodies == [[Member(THIS, "value")]]
            return self._held(found, env) if plain else (unknown(found.name),)
        bases = set(self.folder.program.base_names(found.cls))
        if "enum.StrEnum" in bases:
            return self._held(found, env)
        if "enum.IntEnum" in bases or (formats and bases & {"str", "int"}):
            return (unknown(found.name),)  # which of both it is depends on the version of Python
        known = self._first_names(found.cls, env)
        return (_folded(f"{found.cls.fact.name}.{known[found.name]}"),) if known is not None else (unknown(found.name),)

    def items(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the members of the enumeration that an expression is, in order; None of others."""
        cls = self._class(expr, env)
        first = self._first_names(cls, env) if cls is not None else None
        return None if first is None else [Bound(Member(expr, name), env) for name in dict.fromkeys(first.values())]

    def compared(self, test: Expr, env: Env) -> bool | None:
        """Tell what comparing two members of one enumeration gives, whatever they hold (`auto()`); None of others."""
        if not isinstance(test, Op) or test.op not in {"==", "!="} or len(test.operands) != 2:
            return None
        first = self.member(test.operands[0], env)
        second = self.member(test.operands[1], env) if first is not None else None
        if first is None or second is None or first.cls is not second.cls or self._compares_itself(first.cls):
            return None
        names = self._first_names(first.cls, env)
        return (names[first.name] == names[second.name]) is (test.op == "==") if names is not None else None

    def _compares_itself(self, cls: Cls) -> bool:
        lineage = self.folder.program.ancestry(cls)
        return any(method.fact.name in _COMPARING for entry in lineage for method in entry.methods)

    def member(self, expr: Expr, env: Env) -> Enumerated | None:
        """Return the member that an expression is; None where that is not known."""
        if env.depth > MAX_DEPTH:
            return None
        if isinstance(expr, Member):
            cls = self._class(expr.base, env)
            members = self._of_class(cls) if cls is not None else None
            if cls is not None and members is not None and expr.name in members:
                return Enumerated(cls, expr.name)
        if isinstance(expr, Op) and expr.op == "[]":
            return self._by_name(expr, env)
        if isinstance(expr, Call):
            return self._by_value(expr, env)
        return self._of_variable(expr, env) if isinstance(expr, Name | Member) else None

    def _by_name(self, expr: Op, env: Env) -> Enumerated | None:
        cls = self._class(expr.operands[0], env)
        members = self._of_class(cls) if cls is not None else None
        name = self._data(expr.operands[1], env) if members is not None else UNKNOWN
        return Enumerated(cls, name) if cls is not None and isinstance(name, str) and name in (members or ()) else None

    def _by_value(self, expr: Call, env: Env) -> Enumerated | None:
        cls = self._class(expr.callee, env) if len(expr.args) == 1 and not expr.keywords else None
        data = self._all_data(cls, env) if cls is not None else None
        value = self._data(expr.args[0], env) if data is not None else UNKNOWN
        if cls is None or data is None or value is UNKNOWN:
            return None
        return next((Enumerated(cls, name) for name, each in data.items() if each == value), None)

    def lacks(self, call: Call, env: Env) -> bool | None:
        """Tell whether a call looks up a member by a value that none holds; None of other calls, and if not known."""
        cls = self._class(call.callee, env) if len(call.args) == 1 and not call.keywords else None
        data = self._all_data(cls, env) if cls is not None else None
        value = self._data(call.args[0], env) if data else UNKNOWN
        own = cls is not None and any(each.fact.name in _LOOKING_UP for each in cls.methods)
        return None if data is None or value is UNKNOWN or own else value not in data.values()

    def _of_variable(self, expr: Name | Member, env: Env) -> Enumerated | None:
        ways = self.folder.flow.ways(expr, env)
        helds = {held for way in ways for held in way}
        if all(held.how == "given" for held in helds):
            given = self.folder.names.argument(expr.id, env) if isinstance(expr, Name) else None
            return self.member(given.expr, given.env.deeper(env.depth + 1)) if given is not None else None
        held = helds.pop() if len(helds) == 1 else None
        if held is None or held.how != "value" or held.expr is None or held.env is None:
            return None
        return self.member(held.expr, held.env.deeper(env.depth + 1))

    # --- classes -----------------------------------------------------------------------------------------

    def _class(self, expr: Expr, env: Env) -> Cls | None:
        """The enumeration that an expression names."""
        written = dotted_name(expr)
        head = written.partition(".")[0]
        if not written or env.func.file.language != "python" or head in env.func.given:
            return None
        cls = self.folder.program.class_named(written, env.func.file, env.scope)
        if cls is None:
            cls = self.folder.program.class_named(self.folder.program.canonical(written, env.func.file), env.func.file)
        if cls is None or not _is_enum(cls, self.folder) or self.folder.flow.ways(Name(head), env):
            return None
        return cls

    def _is_opaque(self, expr: Expr, env: Env) -> bool:
        cls = self._class(expr, env)
        return cls is not None and self._of_class(cls) is None

    def _of_class(self, cls: Cls) -> Mapping[str, Expr] | None:
        """The members of a class with what is written for them; None of a class that may make others of them."""
        if cls not in self._members:
            self._members[cls] = self._found(cls)
        return self._members[cls]

    def _found(self, cls: Cls) -> Mapping[str, Expr] | None:
        lineage = self.folder.program.ancestry(cls)
        named = [each.fact.name for entry in lineage for each in entry.methods]
        fields = [field for entry in lineage for field in entry.fact.fields if field.default is not None]
        names = [field.name for field in fields]
        remade = any("remade" in entry.fact.traits for entry in lineage)
        own = shipped_names(_TABLE, "own").intersection((*named, *names))
        if remade or own or len(set(names)) < len(names) or set(names) & set(named):
            return None
        if any(_called(field.default, cls, self.folder) in shipped_names(_TABLE, "other") for field in fields):
            return None
        members = {each.name: each.default for each in fields if each.default is not None}
        return {name: value for name, value in members.items() if not name.startswith("__") and not _is_sunder(name)}

    def _held(self, found: Enumerated, env: Env) -> tuple[Value, ...]:
        """What a member holds: of one that is a text or a number only what that is."""
        written = (self._of_class(found.cls) or {}).get(found.name)
        if written is None or _called(written, found.cls, self.folder) in _AUTO:
            return (unknown(found.name),)
        place = Env(self.folder.names.at_file(found.cls.file, env).func, depth=env.depth + 1)
        values = demoted(self.folder.fold(written, place))
        kinds = {shipped(_TABLE)["beside"].get(base) for base in self.folder.program.base_names(found.cls)} - {None}
        if any(not _is_of(kind, value) for kind in kinds for value in values):
            return (unknown(found.name),)
        return values

    def _all_data(self, cls: Cls, env: Env) -> Mapping[str, Any] | None:
        """What all members hold, by name; None where one is not known."""
        found: dict[str, Any] = {}
        for name in self._of_class(cls) or ():
            values = self._held(Enumerated(cls, name), env)
            data = data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else UNKNOWN
            if data is UNKNOWN:
                return None
            found[name] = data
        return found

    def _first_names(self, cls: Cls, env: Env) -> Mapping[str, str] | None:
        """The name of each member: of several that hold the same it is the first one; None where that is not known."""
        members = self._of_class(cls)
        if members is None:
            return None
        if all(_called(value, cls, self.folder) in _AUTO for value in members.values()):
            return {name: name for name in members}
        data = self._all_data(cls, env)
        if data is None:
            return None
        return {name: next(first for first, other in data.items() if other == each) for name, each in data.items()}

    def _data(self, expr: Expr, env: Env) -> Any:
        values = self.folder.fold(expr, env)
        return data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else UNKNOWN


def _is_enum(cls: Cls, folder: Folder) -> bool:
    bases = set(folder.program.base_names(cls))
    known = shipped_names(_TABLE, "enums") | shipped(_TABLE)["beside"].keys()
    own = {entry.fact.name for entry in folder.program.ancestry(cls)}
    return bool(bases & shipped_names(_TABLE, "enums")) and all(base in known or base in own for base in bases)


def _called(expr: Expr | None, cls: Cls, folder: Folder) -> str:
    """The full name of what a call in the body of a class calls; empty of others."""
    written = dotted_name(expr.callee) if isinstance(expr, Call) else ""
    return folder.program.canonical(written, cls.file) if written else ""


def _is_of(kind: str, value: Value) -> bool:
    data = data_in(value)
    return data is UNKNOWN or (isinstance(data, str) if kind == "text" else is_number(data))


def _is_sunder(name: str) -> bool:
    return name.startswith("_") and name.endswith("_")


def _folded(text: str) -> Value:
    return literal(text)._replace(confidence="folded")
