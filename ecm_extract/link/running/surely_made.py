"""Conditions of Python that ask whether a variable holds anything: an object that a class makes is not None."""

from __future__ import annotations

from collections.abc import Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name, Op

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls, File
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OF_LIBRARIES: Final = shipped_names("link/code/library_values.toml", "objects")
_CONSTANTS: Final = shipped_names("link/code/library_values.toml", "object_constants")
_NONE: Final = Constant("null")
_SAYING_OTHERWISE: Final = frozenset({"__eq__", "__bool__", "__len__", "__new__"})
"""Methods by which an object compares, or counts as false, as it likes; or by which a call makes something else."""


class SurelyMade:
    """Tells where a variable surely holds an object that is true and not None."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def holds(self, test: Expr, env: Env) -> bool | None:
        """Tell whether `x`, `x is None` or `x is not None` holds for what a class makes; None of all else."""
        if isinstance(test, Op) and test.op in {"==", "!="} and _NONE in test.operands:
            asked = next((operand for operand in test.operands if operand != _NONE), _NONE)
            return test.op == "!=" if self._is_made(asked, env) else None
        return True if self._is_made(test, env) else None

    def _is_made(self, expr: Expr, env: Env) -> bool:
        if not isinstance(expr, Name | Member):
            return False
        helds = list(self.folder.origins.of(expr, env))
        return bool(helds) and all(self._makes(held) for held in helds)

    def _makes(self, held: Held) -> bool:
        made = held.expr.callee if isinstance(held.expr, Call) else held.expr
        if held.how != "value" or held.env is None or not isinstance(made, Name | Member):
            return False
        written, file = dotted_name(made), held.env.func.file
        cls = self.folder.program.class_named(written, file, held.env.scope) if written else None
        if cls is not None:
            return isinstance(held.expr, Call) and self._is_plain(cls)
        table = _OF_LIBRARIES if isinstance(held.expr, Call) else _CONSTANTS
        return bool(written) and self._is_any(table, written, file)

    def _is_any(self, table: Set[str], written: str, file: File) -> bool:
        """Whether a name means one of a library, which a star may bring."""
        outside = self.folder.program.outside(written, file)
        stars = (entry.module for entry in file.facts.imports if entry.name == "*" and not outside)
        return outside in table or any(f"{module}.{written}" in table for module in stars)

    def _is_plain(self, cls: Cls) -> bool:
        """Whether all that a class is made of is known, and none of it says when an object counts as nothing."""
        program = self.folder.program
        lineage = program.ancestry(cls)
        return all(len(program.bases(entry)) == len(entry.fact.bases) for entry in lineage) and not any(
            method.fact.name in _SAYING_OTHERWISE for entry in lineage for method in entry.methods
        )
