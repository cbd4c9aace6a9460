"""Members of objects that variables of modules and classes of Python are: `CONFIG = Config()`, and `CONFIG.topic`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.python_dataclasses import is_unchangeable
from ecm_parsers.source.python_literal import NULL

from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.chosen_objects import sides_of
from ecm_extract.link.folding.stated_objects import StatedObjects
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Value, alternatives, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ModuleObjects:
    """Tells members that nobody but the constructor of such an object gives anything."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._stated = StatedObjects(folder)

    def member(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what a member has; empty where it is none of such an object, or may be given something else."""
        given = [self.folder.fold(bound.expr, bound.env) for bound in self.each(expr, env)]
        return alternatives(demoted([value for values in given for value in values])) if given else ()

    def each(self, expr: Member, env: Env) -> list[Bound]:
        """Return the member of each object that this may be, asked of the call that makes it; none of others."""
        objects = [] if isinstance(expr.base, Call) else self._objects(expr.base, env)
        found = [self._of_made(made, expr.name) for made in objects]
        known = [bound for bound in found if bound is not None]
        return known if len(known) == len(found) else []

    def _of_made(self, made: Bound, name: str) -> Bound | None:
        cls = self.folder.objects.class_of(made.expr, made.env)
        if cls is None or self.folder.shifting.member(name, cls) or self._is_assigned(name, cls):
            return None
        return Bound(Member(made.expr, name), made.env)

    def _objects(self, expr: Expr, env: Env) -> list[Bound]:
        """The calls that make the objects of which this is one; none where it may be another one."""
        made = self._stated.made(expr, env)
        if made is not None or env.func.file.language != "python":
            return [made] if made is not None else []
        found = [self._stated.made(each.expr, each.env) for each in self._given(expr, env)]
        known = [each for each in found if each is not None]
        return known if len(known) == len(found) else []

    def _given(self, expr: Expr, env: Env) -> list[Bound]:
        """What a variable of a function, or a member that only methods of the class at hand give anything, is given."""
        if not (is_own_member(expr) and self._is_own(expr.name, env)) and not isinstance(expr, Name):
            return []
        makers = self.folder.origins.makers(expr, env.deeper(env.depth + 1)) if env.depth < MAX_DEPTH else None
        sides = [side for made in makers or () for side in sides_of(made, self.folder)]
        return sides if all(isinstance(side.expr, Name | Member) for side in sides) else []

    def _is_own(self, name: str, env: Env) -> bool:
        """Whether methods of the class at hand and its bases give a member what it has, and nobody else."""
        cls, program = env.this or env.func.cls, self.folder.program
        if cls is None or self.folder.members.is_given(name, cls) or self.folder.redefined.is_hidden(name, cls, env):
            return False
        stated = (each.fields[name].default for each in program.ancestry(cls) if name in each.fields)
        return all(each is None or each == NULL for each in stated) and not any(
            each.fields.get(name) or self.folder.scope.members(name, each) for each in program.derived(cls)
        )

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
