"""Objects that variables of Python modules are: `CONFIG = Config()`, and `CONFIG.topic` in any module."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ModuleObjects:
    """Folds members that nobody but the constructor of such an object gives anything."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what a member has; empty where it is none of such an object, or may be given something else."""
        root = dotted_name(expr.base) if env.func.file.language == "python" else ""
        place, ways = self.folder.names.left_by_module(root, env) if root else (None, [])
        held = ways[0][0] if len(ways) == 1 and len(ways[0]) == 1 else None
        if place is None or held is None or held.how != "value" or not isinstance(held.expr, Call):
            return ()
        made = held.env or place
        cls = self.folder.objects.class_of(held.expr, made)
        if cls is None or self.folder.shifting.member(expr.name, cls) or self._is_assigned(expr.name, cls):
            return ()
        return demoted(self.folder.fold(Member(held.expr, expr.name), made))

    def _is_assigned(self, name: str, cls: Cls) -> bool:
        """Whether somebody else than the methods of a class may assign a member of one of its objects."""
        program = self.folder.program
        lineage = {*program.ancestry(cls), *program.derived(cls)}
        for each in self.folder.scope.assigned_outside(name, "python"):
            target = each.statement.target
            owner = target.base if isinstance(target, Member) else None
            found = self.folder.objects.class_of(owner, Env(each.func, each.at)) if owner is not None else None
            if found in lineage or (found is None and self._may_have(each.func, cls)):
                return True
        return False

    def _may_have(self, func: Func, cls: Cls) -> bool:
        """Whether a function can come by an object of a class: one of their packages sees the other."""
        sees = self.folder.program.sees
        return sees(func.file, cls.file) or sees(cls.file, func.file)
