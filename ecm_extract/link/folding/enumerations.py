"""Enumerations of Python: the members of a class that derives from `Enum`, one by one, and what they are called."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, alternatives, literal

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_BASES: Final = frozenset({"Enum", "IntEnum", "StrEnum", "ReprEnum"})
"""Classes of `enum` whose members are gone through in the order in which they stand."""


class Enumerations:
    """Tells members of enumerations."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._members: dict[Cls, tuple[str, ...]] = {}

    def elements(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return what a loop over an enumeration goes through; None for what is none, or has members twice."""
        cls = self._meant(expr, env)
        return [Bound(Member(expr, name), env) for name in self._of(cls)] or None if cls is not None else None

    def named(self, expr: Expr, env: Env) -> tuple[Value, ...]:
        """Return what `expr.name` is where all that the expression may be are members of enumerations."""
        found = self._called(expr, env)
        if found is None:
            for held in self.folder.origins.of(expr, env):
                one = self._called(held.expr, held.env) if held.how == "value" and held.expr and held.env else None
                if one is None:
                    return ()
                found = (*(found or ()), *one)
        return alternatives(found or ())

    def _called(self, expr: Expr, env: Env) -> tuple[Value, ...] | None:
        cls = self._meant(expr.base, env) if isinstance(expr, Member) else None
        known = cls is not None and isinstance(expr, Member) and expr.name in self._of(cls)
        return (literal(expr.name),) if known and isinstance(expr, Member) else None

    def _meant(self, expr: Expr, env: Env) -> Cls | None:
        """The enumeration that a name means."""
        written = dotted_name(expr) if env.func.file.language == "python" else ""
        if not written or (isinstance(expr, Name) and self.folder.flow.ways(expr, env)):
            return None
        cls = self.folder.program.class_named(written, env.func.file, env.scope)
        if cls is None:
            return None
        bases = (base for each in self.folder.program.ancestry(cls) for base in each.fact.bases)
        return cls if any(last_name(plain(base)) in _BASES for base in bases) else None

    def _of(self, cls: Cls) -> tuple[str, ...]:
        """The names of its members; empty where two have one value, as the second is no member then."""
        if cls not in self._members:
            stated = [each for each in cls.file.facts.constants if each.scope == cls.qualified]
            shown = [each for each in stated if not each.name.startswith("_") and each.value is not None]
            values = [each.value for each in shown]
            alone = all(value not in values[:at] for at, value in enumerate(values))
            self._members[cls] = tuple([each.name for each in shown]) if alone else ()
        return self._members[cls]
