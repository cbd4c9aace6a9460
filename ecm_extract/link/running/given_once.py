"""Variables that a function gives something once, and that nobody gives anything else: `use = True`, `self.use = True`.

What tests them in the same function asks for what the source fixes, where that is a literal.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Constant, Expr, Member, Name, Number, Op, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_GIVING = frozenset({"let", "set"})


class GivenOnce:
    """Puts what they are given into the tests that ask for them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def put_in(self, expr: Expr, func: Func, at: int) -> Expr:
        """Return what a test asks at a statement, with what such variables were given before in their place."""
        if isinstance(expr, Op):
            return Op(expr.op, tuple(self.put_in(part, func, at) for part in expr.operands))
        given = self._value(expr, func, at) if isinstance(expr, Name | Member) else None
        return given if isinstance(given, Constant | Number | Text) else expr

    def _value(self, expr: Name | Member, func: Func, at: int) -> Expr | None:
        """What a local variable, or a member of an object of Python, was surely given; None for all others."""
        outline = self.folder.flow.outline(func)
        key = outline.effects.key(expr)
        if not key or outline.changes.get(key) != 1 or key in outline.exposed | outline.escaped:
            return None
        if not (self._is_member(expr, func) if isinstance(expr, Member) else self._is_local(expr, func)):
            return None
        before = (func.fact.body[place] for place in sorted(outline.certain) if place < at)
        found = next((entry for entry in before if entry.target == expr), None)
        return found.value if found is not None and _is_plain(found) else None

    def _is_local(self, expr: Name, func: Func) -> bool:
        outline = self.folder.flow.outline(func)
        return expr.id in outline.effects.own and (outline.python or outline.is_one(expr.id))

    def _is_member(self, expr: Member, func: Func) -> bool:
        """Whether a member of an object of Python is one that no other method and nobody outside can give anything."""
        cls = func.cls
        if cls is None or expr.base != THIS or func.file.language != "python":
            return False
        family = {*self.folder.program.ancestry(cls), *self.folder.program.derived(cls)}
        if any(self._gives(expr.name, each, func) for each in family):
            return False
        return not self.folder.changed_outside.may_be_changed(expr.name, cls)

    def _gives(self, name: str, cls: Cls, func: Func) -> bool:
        """Whether a class says what a member is in another way than by a function."""
        if self.folder.python_fields.any_is_given(cls) or any(each.fact.name == name for each in cls.methods):
            return True
        return any(each is not func for each in self.folder.scope.changing(name, cls))


def _is_plain(entry: Statement) -> bool:
    """Whether a statement gives all of a variable something, and adds nothing to it."""
    return entry.kind in _GIVING and not entry.type.endswith("=")
