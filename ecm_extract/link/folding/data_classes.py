"""Fields of data classes as Python lists them: `fields(Config)`, `asdict(config)`, `Config.model_fields`.

Source: docs.python.org, "dataclasses"; docs.pydantic.dev, "Models"; attrs.org, "API". An element of what lists fields
has the name and the default of one, whatever objects hold; `asdict` gives what an object holds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

import msgspec
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Opaque, Text

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.folding.declared_fields import FieldsOfClasses, Listed, ListedField
from ecm_extract.link.running.env import Bound, Env, invocation_of
from ecm_extract.link.running.values import Value, demoted, unknown
from ecm_extract.shipped import shipped_as

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_FIELD: Final = Name("*field")
"""Stands for what makes an element of `fields`; no class has such a name."""
_UNSEEN: Final = Opaque("default")
Pair = tuple[Bound, Bound]


class _Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    gives: str
    of: frozenset[str] = frozenset()


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    functions: Mapping[str, str]
    members: Mapping[str, _Row]
    methods: Mapping[str, _Row]
    field: Mapping[str, Sequence[str]]
    private: Mapping[str, Sequence[str]]
    missing: Mapping[str, frozenset[str]]


class _Asked(NamedTuple):
    """What is listed, of which class or object."""

    row: _Row
    given: Expr


def _table() -> _Table:
    return shipped_as("link/folding/field_listings.toml", _Table)


class DataClasses:
    """Takes data classes apart."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._table = _table()
        self._fields = FieldsOfClasses(folder)

    def elements(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the elements of `fields(Config)`, or of an object of it; None where they are not all known."""
        asked = self._asked(expr, env)
        if asked is None:
            return None
        if asked.row.gives in {"fields", "names"}:
            listed = self._listed(asked, env)
            return [_element(each, asked.row.gives) for each in listed.fields] if listed is not None else None
        entries = self._entries(asked, env)
        return [key for key, _ in entries] if entries is not None else None

    def entries(self, expr: Expr, env: Env) -> list[Pair] | None:
        """Return the entries of `asdict(config)`, of what the object holds there, or of `Config.model_fields`."""
        asked = self._asked(expr, env)
        return self._entries(asked, env) if asked is not None else None

    def of_field(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return the name or the default of an element of `fields`; empty of anything else."""
        found = self._part(expr, env)
        if found is None:
            return ()
        if found.expr == _UNSEEN:
            return (unknown("default"),)
        return demoted(self.folder.fold(found.expr, found.env.deeper(max(env.depth, found.env.depth) + 1)))

    def compared(self, test: Expr, env: Env) -> bool | None:
        """Tell what comes of asking whether a field has no default: `each.default is MISSING`; None of other tests."""
        if not isinstance(test, Op) or test.op not in {"==", "!="} or env.func.file.language != "python":
            return None
        parts = [each for each in test.operands if isinstance(each, Member)]
        marks = [self.folder.program.canonical(dotted_name(each), env.func.file) for each in test.operands]
        found = [part for each in parts if (part := self._part(each, env)) is not None]
        if len(found) != 1 or found[0].expr == _UNSEEN or self._table.missing["names"].isdisjoint(marks):
            return None
        return test.op == "!="

    def _part(self, expr: Member, env: Env) -> Bound | None:
        """The name or the default of an element of `fields`, where that stands."""
        at = next((at for at, part in enumerate(("name", "default")) if expr.name in self._table.field[part]), None)
        if at is None or not isinstance(expr.base, Name) or env.func.file.language != "python":
            return None
        helds = {held for way in self.folder.flow.ways(expr.base, env) for held in way}
        made = [held.expr for held in helds if held.how == "value" and isinstance(held.expr, Call)]
        place = next(iter(helds)).env if len(helds) == 1 else None
        return Bound(made[0].args[at], place) if len(made) == 1 and place and made[0].callee == _FIELD else None

    def _asked(self, expr: Expr, env: Env) -> _Asked | None:
        """What an expression lists; None of one that lists no fields."""
        if env.func.file.language != "python":
            return None
        if isinstance(expr, Member):
            row = self._table.members.get(expr.name)
            return _Asked(row, expr.base) if row is not None else None
        if not isinstance(expr, Call):
            return None
        callee = expr.callee
        if isinstance(callee, Member) and callee.name in self._table.methods and not (expr.args or expr.keywords):
            return _Asked(self._table.methods[callee.name], callee.base)
        gives = self._table.functions.get(invocation_of(expr, env).path)
        return _Asked(_Row(gives), expr.args[0]) if gives and len(expr.args) == 1 and not expr.keywords else None

    def _listed(self, asked: _Asked, env: Env) -> Listed | None:
        gives = asked.row.gives
        held = gives == "values"
        found = self._fields.held(asked.given, env) if held else self._fields.named(asked.given, env, gives == "types")
        return found if found is not None and self._fields.is_of(found.cls, asked.row.of) else None

    def _entries(self, asked: _Asked, env: Env) -> list[Pair] | None:
        gives = asked.row.gives
        listed = self._listed(asked, env) if gives in {"table", "defaults", "types", "values"} else None
        if listed is None:
            return None
        if gives == "values":
            return [(Bound(Text(each.name), env), Bound(Member(asked.given, each.name), env)) for each in listed.fields]
        given = [each for each in listed.fields if gives != "defaults" or each.default is not None]
        return [(_element(each, "names"), _element(each, gives)) for each in given]


def _element(field: ListedField, gives: str) -> Bound:
    """What stands for a field among those that are listed."""
    if gives == "names":
        return Bound(Text(field.name), field.place)
    default = field.default or _UNSEEN
    whole = Call(_FIELD, (Text(field.name), default))
    return Bound({"defaults": default, "types": Opaque("type")}.get(gives, whole), field.place)
