"""Variables of a function, or of a module's own body, that one statement gives a literal and nobody anything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Constant, Expr, Name, Number, Op, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.units import Func

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class SoleValues:
    """Finds their literals, whatever stands around the one statement."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def in_place(self, expr: Expr, func: Func) -> Expr:
        """Return an expression with their literals in the place of such variables."""
        if isinstance(expr, Op):
            return Op(expr.op, tuple(self.in_place(part, func) for part in expr.operands))
        found = self._of(expr.id, func) if isinstance(expr, Name) else None
        return found if found is not None else expr

    def _of(self, name: str, func: Func) -> Expr | None:
        outline = self.folder.flow.outline(func)
        if name not in outline.effects.own or any(entry.name == name for entry in func.fact.params):
            return None
        if outline.changes.get(name) != 1 or name in outline.exposed or self._is_shared(name, func):
            return None
        return next((entry.value for entry in func.fact.body if _begins(entry, name, func)), None)

    def _is_shared(self, name: str, func: Func) -> bool:
        """Whether a block of C++ may hide the variable by another one, or another name of it change it."""
        if func.file.language == "python":
            return False
        lets = (entry for entry in func.fact.body if entry.kind in {"let", "each"} and entry.type.endswith("&"))
        return not self.folder.flow.outline(func).is_one(name) or any(entry.value == Name(name) for entry in lets)


def _begins(entry: Statement, name: str, func: Func) -> bool:
    """Whether a statement gives a variable a literal; in C++ that which declares it, before which it holds nothing."""
    declares = entry.kind == "let" if func.file.language == "cpp" else not entry.type.endswith("=")
    return declares and entry.target == Name(name) and isinstance(entry.value, Constant | Number | Text)
