"""Members of objects that variables of modules and classes of Python are: `CONFIG = Config()`, and `CONFIG.topic`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member
from ecm_parsers.source.python_dataclasses import is_unchangeable

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.stated_objects import StatedObjects
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ModuleObjects:
    """Tells members that nobody but the constructor of such an object gives anything."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._stated = StatedObjects(folder)

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what a member has; empty where it is none of such an object, or may be given something else."""
        bound = self.of(expr, env)
        return demoted(self.folder.fold(bound.expr, bound.env)) if bound is not None else ()

    def of(self, expr: Member, env: Env) -> Bound | None:
        """Return the member, asked of the call that makes its object; None of others."""
        made = self._stated.made(expr.base, env) if not isinstance(expr.base, Call) else None
        cls = self.folder.objects.class_of(made.expr, made.env) if made is not None else None
        if made is None or cls is None or self.folder.shifting.member(expr.name, cls):
            return None
        return Bound(Member(made.expr, expr.name), made.env) if not self._is_assigned(expr.name, cls) else None

    def _is_assigned(self, name: str, cls: Cls) -> bool:
        """Whether somebody else than the methods of a class may assign a member of one of its objects."""
        program = self.folder.program
        lineage = {*program.ancestry(cls), *program.derived(cls)}
        if all(is_unchangeable(each.fact, each.file.facts.imports) for each in lineage):
            return False
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
