"""Variables that a function gives something once, and that nobody gives anything else: `use = True`, `self.use = True`.

What tests them in the same function asks for what the source fixes, where that is a literal.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Constant, Expr, Member, Name, Number, Op, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.outline import Outline
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_GIVING = frozenset({"let", "set"})
_Literal = Constant | Number | Text


class GivenOnce:
    """Puts what they are given into the tests that ask for them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def put_in(self, expr: Expr, func: Func, before: Sequence[int]) -> Expr:
        """Return what a test asks, with what statements that ran before gave such variables in their place."""
        if isinstance(expr, Op):
            return Op(expr.op, tuple(self.put_in(part, func, before) for part in expr.operands))
        given = self._value(expr, func, before) if isinstance(expr, Name | Member) else None
        return given if given is not None else expr

    def _value(self, expr: Name | Member, func: Func, before: Sequence[int]) -> Expr | None:
        """What a local variable, or a member of an object of Python, was surely given; None for all others."""
        outline = self.folder.flow.outline(func)
        key = outline.effects.key(expr)
        ran = (func.fact.body[at] for at in before)
        found = next((entry for entry in ran if entry.target == expr), None)
        if found is None or not isinstance(found.value, _Literal) or not _is_plain(found):
            return None
        if not key or not _is_given_once(key, outline):
            return None
        own = self._is_member(expr, func) if isinstance(expr, Member) else self._is_local(expr, func)
        return found.value if own else None

    def _is_local(self, expr: Name, func: Func) -> bool:
        outline = self.folder.flow.outline(func)
        if outline.python or expr.id not in outline.effects.own:
            return expr.id in outline.effects.own
        lets = (entry for entry in func.fact.body if entry.kind in {"let", "each"} and entry.type.endswith("&"))
        return outline.is_one(expr.id) and not any(entry.value == expr for entry in lets)

    def _is_member(self, expr: Member, func: Func) -> bool:
        """Whether a member of an object of Python is one that no other method and nobody outside can give anything."""
        cls = func.cls
        if cls is None or expr.base != THIS or func.file.language != "python":
            return False
        if any(self._gives(expr.name, each, func) for each in self.folder.program.related(cls)):
            return False
        return not self.folder.changed_outside.may_be_changed(expr.name, cls)

    def _gives(self, name: str, cls: Cls, func: Func) -> bool:
        """Whether a class says what a member is in another way than by a function."""
        if self.folder.python_fields.any_is_given(cls) or any(each.fact.name == name for each in cls.methods):
            return True
        others = (each for each in self.folder.scope.changing(name, cls) if each is not func)
        outlines = map(self.folder.flow.outline, others)
        return any(f".{name}" in outline.given | outline.by_other_names for outline in outlines)


def _is_given_once(key: str, outline: Outline) -> bool:
    """Whether one statement of a function gives a variable something; who is handed a literal of Python leaves it."""
    if not outline.python:
        return outline.changes.get(key) == 1 and key not in outline.exposed
    giving = (entry for entry in outline.func.fact.body if entry.kind != "do" and entry.target is not None)
    count = sum(key in outline.bound_keys(entry.target) for entry in giving)
    return count == 1 and key not in outline.escaped | outline.by_other_names


def _is_plain(entry: Statement) -> bool:
    """Whether a statement gives all of a variable something, and adds nothing to it."""
    return entry.kind in _GIVING and not entry.type.endswith("=")
