"""Objects of C++ whose class says itself what a copy is: a copy is made by that constructor, as any other object."""

from __future__ import annotations

from collections.abc import Set
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import by_value, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.constructions import given_of
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


_ASSIGNMENT: Final = "operator="


class OwnCopies:
    """Tells which objects are copied so; each class is looked at once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._copying: dict[Cls, bool] = {}

    def given(self, name: Expr, whole: Bound, func: Func) -> Bound:
        """Return what makes the object in a variable that is given one: a reference is that one itself."""
        written = func.written_types.get(name.id, "") if isinstance(name, Name) else ""
        return whole if written.endswith(("&", "*")) else self._made(whole)

    def of_element(self, element: Bound | None) -> Bound | None:
        """Return what makes an element of a list."""
        return self._made(element) if element is not None else None

    def copied(self, made: Bound) -> Bound:
        """Return the object of which another one is made as a copy, where no constructor says that: `Row(row)`."""
        cls = self.folder.structures.class_called(made.expr, made.env)
        given = given_of(made.expr) if isinstance(made.expr, Call) else ()
        if cls is None or cls.file.language != "cpp" or len(given) != 1 or cls.constructors:
            return made
        return Bound(given[0], made.env) if self.folder.objects.class_of(given[0], made.env) is cls else made

    def _made(self, whole: Bound) -> Bound:
        """What makes a copy of an object, where its class says that; else the object as it is."""
        if whole.env.func.file.language != "cpp" or not isinstance(whole.expr, Name | Member):
            return whole
        cls = self._class_of(whole.expr, whole.env)
        if cls is None or not self._copies(cls):
            return whole
        helds = {held for way in self.folder.flow.ways(whole.expr, whole.env) for held in way}
        if any(held.expr is not None and pointed(held.expr) for held in helds):
            return whole
        return Bound(Call(Name(cls.fact.name), (whole.expr,)), whole.env)

    def is_assigned(self, target: Expr | None, env: Env) -> bool:
        """Tell whether the class of an object says what an assignment to it does."""
        if not self._assigning or not isinstance(target, Name | Member):
            return False
        last = target.id if isinstance(target, Name) else target.name
        written = self.folder.scope.declared_type(last, env) if not isinstance(target, Member) else ""
        written = written or self.folder.objects.type_of(target, env)
        named = by_value(written.removesuffix("&").strip()) and plain(written).rpartition("::")[2] in self._assigning
        cls = self.folder.objects.class_written(written, env) if named else None
        return cls is not None and any(each.fact.name == _ASSIGNMENT and _is_own(each) for each in cls.methods)

    @cached_property
    def _assigning(self) -> Set[str]:
        """The names of the classes that say what an assignment does."""
        named = self.folder.program.functions.get(_ASSIGNMENT, ())
        return frozenset(each.cls.fact.name for each in named if each.cls is not None and _is_own(each))

    def _class_of(self, expr: Name | Member, env: Env) -> Cls | None:
        """The class of an object that a variable or field is, behind no pointer that is declared."""
        written = self.folder.objects.type_of(expr, env)
        by_itself = bool(written) and by_value(written.removesuffix("&").strip())
        return self.folder.objects.class_written(written, env) if by_itself else None

    def _copies(self, cls: Cls) -> bool:
        known = self._copying.get(cls)
        if known is None:
            makers = (each for each in cls.methods if each.is_constructor and _is_own(each))
            known = self._copying[cls] = any(_takes_own(each, cls) for each in makers)
        return known


def _is_own(method: Func) -> bool:
    """Whether a class says what a method does, here or where that is not seen: `= default` has no statement."""
    return bool(method.fact.body) or "declaration" in method.fact.traits


def _takes_own(maker: Func, cls: Cls) -> bool:
    """Whether a constructor is given an object of its class."""
    first = maker.fact.params[0].type if len(maker.fact.params) == 1 else ""
    return first.endswith("&") and plain(first).rpartition("::")[2] == cls.fact.name
