"""Which class of Python an expression means, and the fields that its annotations and those of its bases make.

Source: docs.python.org, "dataclasses" (fields of bases come first, one of a name stays in its place), "typing".
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name
from ecm_parsers.source.python_dataclasses import DeclaredField, declared_fields, has_written_fields, is_known_base

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.folding.stated_objects import StatedObjects
from ecm_extract.link.index.own_class import is_own_class
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PRIVATE: Final = shipped_names("link/folding/field_listings.toml", "private")
"""Bases whose classes have no fields that begin with an underscore (docs.pydantic.dev, "Models")."""


class ListedField(NamedTuple):
    """A field, with its default and where that is evaluated."""

    name: str
    default: Expr | None
    place: Env


class Listed(NamedTuple):
    """The fields of a class."""

    cls: Cls
    fields: tuple[ListedField, ...]


class FieldsOfClasses:
    """Finds them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._stated = StatedObjects(folder)

    def named(self, expr: Expr, env: Env, plain: bool = False) -> Listed | None:
        """Return the fields of the class that an expression names or that its object has; plain: of any class."""
        expr, place = self._handed(expr, env)
        cls = self._class(expr, place) or self._of_made(expr, place)
        named = cls or self._of_object(expr, place)
        if named is None or (cls is None and self.folder.program.derived(named)):
            return None  # an object may be of a derived class, which has more
        return self._listed(named, env, plain)

    def held(self, expr: Expr, env: Env) -> Listed | None:
        """Return the fields of an object that hold all that it has; None of what is no object of a known class."""
        if not isinstance(expr, Name | Member | Call) or self._class(expr, env) is not None:
            return None
        made = self._of_made(expr, env)
        cls = made or self.folder.objects.class_of(expr, env)
        if cls is None or (made is None and self.folder.program.derived(cls)):
            return None
        listed = self._listed(cls, env, plain=False)
        return listed if listed is not None and not self._has_others(listed) else None

    def is_of(self, cls: Cls, bases: Set[str]) -> bool:
        """Tell whether a class derives from one of some classes of libraries; any does from one of none."""
        return not bases or not bases.isdisjoint(self._outside(cls))

    def _listed(self, cls: Cls, env: Env, plain: bool) -> Listed | None:
        lineage = self.folder.program.ancestry(cls)
        written = {each: has_written_fields(each.fact, each.file.facts.imports) for each in lineage}
        alone = plain and not cls.fact.decorators and len(lineage) == 1
        known = all(map(self._is_whole, lineage)) and None not in written.values()
        if not known or not (alone or any(written.values())):
            return None
        private = self.is_of(cls, _PRIVATE)
        making = [each for each in reversed(lineage) if written[each] or private or alone]
        rows = [(each, declared_fields(each.fact, each.file.facts.imports)) for each in making]
        found = {row.name: row for owner, fields in rows for row in self._placed(owner, fields or (), env)}
        if any(fields is None for _, fields in rows):
            return None
        return Listed(cls, tuple([row for row in found.values() if not (private and row.name.startswith("_"))]))

    def _placed(self, owner: Cls, fields: Sequence[DeclaredField], env: Env) -> list[ListedField]:
        place = self.folder.names.at_file(owner.file, env)
        return [ListedField(each.name, each.default, place) for each in fields]

    def _is_whole(self, cls: Cls) -> bool:
        """Whether every base of a class is one of the tree, or one of a library that has no fields."""
        known = len(self.folder.program.bases(cls))
        outside = [each for each in cls.fact.bases if is_known_base(each, cls.file.facts.imports)]
        return known + len(outside) == len(cls.fact.bases)

    def _outside(self, cls: Cls) -> Set[str]:
        program = self.folder.program
        lineage = program.ancestry(cls)
        return {program.canonical(base, each.file) for each in lineage for base in each.fact.bases}

    def _has_others(self, listed: Listed) -> bool:
        """Whether a method gives an object something that is no field of it."""
        names = {each.name for each in listed.fields}
        methods = (each for cls in self.folder.program.ancestry(listed.cls) for each in cls.methods)
        targets = (each.target for method in methods for each in method.fact.body)
        return any(isinstance(each, Member) and each.base == THIS and each.name not in names for each in targets)

    def _handed(self, expr: Expr, env: Env) -> tuple[Expr, Env]:
        """What callers write for a class or an object that a function is handed; anything else as it is."""
        bound = self.folder.names.argument(expr.id, env) if isinstance(expr, Name) and env.depth < MAX_DEPTH else None
        return self._handed(bound.expr, bound.env.deeper(env.depth + 1)) if bound is not None else (expr, env)

    def _class(self, expr: Expr, env: Env) -> Cls | None:
        """The class that an expression names."""
        if is_own_class(expr, env.func):
            return None
        if isinstance(expr, Member) and expr.base == THIS:
            return self._inner(expr.name, env)
        dotted = dotted_name(expr)
        if not dotted or dotted.partition(".")[0] in env.func.given:
            return None
        rebound = isinstance(expr, Name) and self.folder.flow.ways(expr, env)
        return self.folder.program.class_named(dotted, env.func.file, env.scope) if not rebound else None

    def _of_made(self, expr: Expr, env: Env) -> Cls | None:
        """The very class of an object that a call makes, here or where a module or a class states it."""
        made = Bound(expr, env) if isinstance(expr, Call) else self._stated.made(expr, env)
        call = made.expr if made is not None else None
        return self._class(call.callee, made.env) if made is not None and isinstance(call, Call) else None

    def _inner(self, name: str, env: Env) -> Cls | None:
        """The class that stands in the class of the object at hand, or in a base of it."""
        owner = env.this or env.func.cls
        for each in self.folder.program.ancestry(owner) if owner is not None else ():
            found = self.folder.program.class_named(f"{each.fact.name}.{name}", each.file)
            if found is not None:
                return found
        return None

    def _of_object(self, expr: Expr, env: Env) -> Cls | None:
        """The class of an object, also where it is asked of that: `type(config)`, `config.__class__`."""
        if is_own_class(expr, env.func):
            return env.this or env.func.cls
        if isinstance(expr, Call) and expr.callee == Name("type") and len(expr.args) == 1:
            return self.folder.objects.class_of(expr.args[0], env)
        if isinstance(expr, Member) and expr.name == "__class__":
            return self.folder.objects.class_of(expr.base, env)
        return self.folder.objects.class_of(expr, env)
