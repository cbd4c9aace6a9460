"""Private members of C++ that nobody gives anything but what they begin with: `bool debug_ = false;` and no more.

Only the class and its friends can name them, so all who might give them something else are in the tree.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Constant, Expr, Member, Name, Number, Op, Opaque
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ASKING: Final = frozenset({"!", "&&", "||", "==", "!=", "<", ">", "<=", ">=", "?:"})
"""Operators that leave their operands as they are, and give nobody a way to them."""

_BODILESS: Final = frozenset({"pure", "deleted"})
"""Traits of methods that have no body anywhere."""


class NeverSet:
    """Tells which members they are; each is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[Cls, str], bool] = {}

    def has(self, name: str, func: Func) -> bool:
        """Tell whether a name in a method means such a member."""
        if func.cls is None or func.file.language != "cpp" or name not in func.cls.fields:
            return False
        key = (func.cls, name)
        if key not in self._known:
            self._known[key] = self._is_left(name, func.cls)
        return self._known[key]

    def _is_left(self, name: str, cls: Cls) -> bool:
        field = cls.fields[name]
        number = by_value(field.type) and kind_of_type(field.type) == "number"
        if "private" not in field.traits or not number or cls.fact.template:
            return False
        methods = list(self._methods(cls))
        if not _are_read(methods) or self.folder.changed_outside.may_be_changed(name, cls):
            return False
        given = any(_gives(entry, name, method) for method in methods for entry in method.fact.body)
        return not given and _begins_fixed(name, cls)

    def _methods(self, cls: Cls) -> Iterator[Func]:
        """The methods of a class and of those that are declared in it, with the functions within them."""
        inside = f"{cls.qualified}::"
        for file in {cls.file: None, **{method.file: None for method in cls.methods}}:
            functions = self.folder.program.functions_in(file)
            yield from (func for func in functions if f"{func.fact.scope}::".startswith(inside))


def _are_read(methods: Sequence[Func]) -> bool:
    """Whether the tree has a body of each method that is declared."""
    read = {(each.cls, each.fact.name) for each in methods if "declaration" not in each.fact.traits}
    return all((each.cls, each.fact.name) in read for each in methods if not _BODILESS & set(each.fact.traits))


def _begins_fixed(name: str, cls: Cls) -> bool:
    """Whether an object begins with a literal in a member, whoever makes it."""
    declared = cls.fields[name].default
    inits = [entry for maker in cls.constructors for entry in maker.fact.body if entry.kind == "init"]
    begun = [entry.value for entry in inits if entry.target == Name(name)]
    if declared is None and len(begun) < max(1, len(cls.constructors)):
        return False
    return all(isinstance(value, Constant | Number) for value in (*begun, declared or Constant("false")))


def _gives(entry: Statement, name: str, method: Func) -> bool:
    """Whether a statement may give a member something, or somebody a way to it; one that begins it gives none."""
    if entry.target is not None and entry.kind != "init" and _means(entry.target, name):
        return True
    if entry.value is not None and _means(entry.value, name) and _is_shown(entry, method):
        return True
    return any(_lends(part, name) for part in (entry.target, entry.value) if part is not None)


def _is_shown(entry: Statement, method: Func) -> bool:
    """Whether a statement hands on what its value is, which may be a reference: all but copies."""
    if entry.kind == "return":
        return "reference" in method.fact.traits
    return entry.kind in {"each", "init"} or (entry.kind == "let" and not by_value(entry.type))


def _lends(expr: Expr, name: str) -> bool:
    """Whether an expression has the member in a place that does more than to ask for it."""
    if isinstance(expr, Opaque):
        return expr.may_name(name)
    asks = isinstance(expr, Op) and expr.op in _ASKING
    return any(not asks if _means(part, name) else _lends(part, name) for part in children(expr))


def _means(expr: Expr, name: str) -> bool:
    return expr == Name(name) or expr == Member(THIS, name)
