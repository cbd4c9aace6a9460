"""Profiles that are picked out of something: an element of a table or a list, what an optional holds, an enumerator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Op

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.folding.popped import POP
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

PRESETS: Final = "QoSPresetProfiles"
"""The enumeration of rclpy that has presets (rclpy/qos.py)."""
_ENDS: Final = {"front": 0, "back": -1}
_OR: Final = "value_or"
_GET: Final = "get"


class PickedProfiles:
    """Finds what is picked."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def element(self, expr: Expr, env: Env) -> Bound | None:
        """Return what an expression picks out of a container; None where that is not known, and for all else."""
        if isinstance(expr, Member):
            return self.folder.searches.part(expr, env)
        if not isinstance(expr, Call | Op):
            return None
        found = self._of_method(expr.callee, expr, env) if isinstance(expr, Call) else None
        return found if found is not None else self.folder.tables.element(expr, env, likely=True)

    def _of_method(self, callee: Expr, call: Call, env: Env) -> Bound | None:
        """`table.get(key, profile)`, and `profiles.back()`, `given.value_or(profile)` of lists and optionals of C++."""
        if not isinstance(callee, Member):
            return None
        if env.func.file.language == "python":
            return self._of_table(callee, call, env) if call.args else None
        if callee.name in _ENDS and not call.args:
            items = self.folder.lists.items(callee.base, env)
            return items[_ENDS[callee.name]] if items else None
        full = self.folder.optionals.holds(callee.base, env) if callee.name == _OR and len(call.args) == 1 else None
        return None if full is None else Bound(callee.base if full else call.args[0], env)

    def _of_table(self, callee: Member, call: Call, env: Env) -> Bound | None:
        if callee.name == POP:
            return self.folder.popped.element(callee.base, call.args, env)
        return self.folder.tables.element_or(callee.base, call.args, env) if callee.name == _GET else None

    def enumerator(self, expr: Expr, env: Env) -> str:
        """Return a preset that is asked for by its name, `QoSPresetProfiles["SENSOR_DATA"]`; empty for all else."""
        if not isinstance(expr, Op) or expr.op != "[]" or len(expr.operands) != 2:
            return ""
        owner, name = expr.operands
        values = self.folder.fold(name, env) if dotted_name(owner).rpartition(".")[2] == PRESETS else ()
        return f"{PRESETS}.{values[0].text}" if len(values) == 1 else ""

    def likely_side(self, expr: Op, env: Env) -> tuple[Expr, ...]:
        """Return what a conditional can be: one side where its condition is known, as by the default of a parameter."""
        test, then, other = expr.operands
        values = {value.text.lower() for value in self.folder.fold(test, env)}
        known = {"true": True, "false": False}.get(values.pop()) if len(values) == 1 else None
        holds = self.folder.optionals.holds(test, env) if known is None else known
        return (then, other) if holds is None else (then if holds else other,)
