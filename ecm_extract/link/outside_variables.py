"""Variables of namespaces of C++ that one function alone changes, which programs run once: who changed them, and when.

Until that function changes such a variable it is as it was declared, and nobody that it calls changes it.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Set
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Name, Op

from ecm_extract.infer.places import whole_of
from ecm_extract.link.units import Func
from ecm_extract.link.walk import expressions
from ecm_extract.resolve.cpp_constants import Stated

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


class OutsideVariables:
    """Tells which functions change variables of namespaces; each variable is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._changers: dict[Stated, Set[Func] | None] = {}

    def is_followed(self, name: str, func: Func) -> bool:
        """Tell whether nobody but one function that runs once changes a variable, and that is the function at hand."""
        own = self._meant(name, func)
        changers = self._of(own) if own is not None else None
        return changers is not None and (not changers or (changers == {func} and self.folder.runs_once.of(func)))

    def _meant(self, name: str, func: Func) -> Stated | None:
        if func.file.language != "cpp":
            return None
        return self.folder.objects.file_scope.meant(name, func)

    def _of(self, variable: Stated) -> Set[Func] | None:
        """The functions that may change a variable and may run; None where it is not known who does."""
        if variable not in self._changers:
            self._changers[variable] = None  # who asks in a circle
            self._changers[variable] = self._found(variable)
        return self._changers[variable]

    def _found(self, variable: Stated) -> Set[Func] | None:
        found: set[Func] = set()
        for func, written in self._mentions.get(variable.constant.name, ()):
            if not self._may_mean(written, func, variable):
                continue
            if _is_given_out(written, func):
                return None
            outline = self.folder.flow.outline(func)
            changed = any(key == written or key.startswith(f"{written}.") for key in outline.changes)
            found.update([func] if changed and not self.folder.runs_once.never(func) else [])
        return frozenset(found)

    def _may_mean(self, written: str, func: Func, variable: Stated) -> bool:
        """Whether a name in a function may mean a variable: what is declared here may be defined in another file."""
        key = self.folder.flow.effects(func).key(Name(written))
        if key.startswith(".") or key in self.folder.flow.effects(func).own:
            return False
        meant = self._meant(written, func)
        return meant is None or meant.constant.scope == variable.constant.scope

    @cached_property
    def _mentions(self) -> Mapping[str, Set[tuple[Func, str]]]:
        """Last name of a constant or variable -> the functions that mention it, with how they write it."""
        found: dict[str, set[tuple[Func, str]]] = defaultdict(set)
        program = self.folder.program
        for func in (func for group in program.functions.values() for func in group if func.file.language == "cpp"):
            for written in _names(func):
                last = written.rsplit("::", 1)[-1]
                if last in program.constants:
                    found[last].add((func, written))
        return found


def _names(func: Func) -> Iterator[str]:
    for statement in func.fact.body:
        yield from (expr.id for expr, _ in expressions(statement) if isinstance(expr, Name))


def _is_given_out(name: str, func: Func) -> bool:
    """Whether a function takes the address of a variable, refers to it by another name, or returns a reference."""
    for statement in func.fact.body:
        root = _root(statement.value)
        refers = statement.kind in {"let", "each"} and statement.type.endswith(("&", "*"))
        returns = statement.kind == "return" and "reference" in func.fact.traits
        if root == name and (refers or returns):
            return True
        taken = (expr for expr, _ in expressions(statement) if isinstance(expr, Op) and expr.op == "&")
        if any(len(expr.operands) == 1 and _root(expr.operands[0]) == name for expr in taken):
            return True
    return False


def _root(expr: Expr | None) -> str:
    """The variable that an expression is, or is a part of."""
    while expr is not None and not isinstance(expr, Name):
        expr = whole_of(expr)
    return expr.id if expr is not None else ""
