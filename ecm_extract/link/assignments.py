"""The assignments behind a variable or a member, with the place where each is evaluated."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.env import Env, Instance
from ecm_extract.link.scope import Definition
from ecm_extract.link.units import Cls

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


class Assignments:
    """Looks up assignments."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def definitions(self, expr: Expr, env: Env) -> list[tuple[Definition, Env]]:
        """Return the assignments of a variable or of a member of `this`, with where each is evaluated."""
        name = (
            expr.id
            if isinstance(expr, Name)
            else expr.name
            if isinstance(expr, Member) and expr.base == Name("this")
            else ""
        )
        if not name:
            return []
        local = self.folder.scope.local(expr, env) if isinstance(expr, Name) else []
        if local:
            return [(definition, env.before(definition.at)) for definition in local]
        found = self._member_definitions(name, env.this or env.func.cls, env)
        if found or not isinstance(expr, Name):
            return found
        outside = self.folder.objects.file_scope.definitions(name, env)
        return [(entry, Env(entry.func, entry.at, this=entry.func.cls, depth=env.depth + 1)) for entry in outside]

    def reaching(self, expr: Name | Member, env: Env) -> list[tuple[Definition, Env]]:
        """Return the assignments of which one gave a variable what it holds at a place; of a member the first known."""
        local = self.folder.scope.reaching(expr, env) if isinstance(expr, Name) else []
        if local:
            return [(definition, env.before(definition.at)) for definition in local]
        return self.definitions(expr, env)[:1]

    def _member_definitions(self, name: str, cls: Cls | None, env: Env) -> list[tuple[Definition, Env]]:
        found: list[tuple[Definition, Env]] = []
        if cls is None:
            return found
        for entry in self.folder.program.ancestry(cls):
            for definition in self.folder.scope.members(name, entry):
                if not self.folder.objects.runs(definition.func, env.made):
                    continue
                made = env.made if env.made is not None and env.made.cls is cls else Instance(cls, {}, {})
                inner = Env(definition.func, definition.at, this=cls, made=made, depth=env.depth + 1)
                found.append((definition, inner))
        return found
