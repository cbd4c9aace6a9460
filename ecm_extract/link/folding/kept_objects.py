"""Objects that Python keeps in members since another function handed them over: what their fields hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Member

from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Value

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class KeptObjects:
    """Follows them to who made them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def is_kept(self, expr: Expr, env: Env) -> bool:
        """Tell whether Python has an object in a member since another function: it may have become another one."""
        return env.func.file.language == "python" and isinstance(expr, Member) and not self.folder.flow.ways(expr, env)

    def class_of(self, expr: Member, env: Env) -> Cls | None:
        """Return the class of the object that a member is, which another function was handed.

        None where its field is given something at several places: which was last depends on when it is asked for.
        """
        handed = self._first_handed(expr.base, env)
        cls = self.folder.objects.class_of(handed.expr, handed.env) if handed is not None else None
        if cls is None or self.folder.members.is_given(expr.name, cls):
            return None
        given = [self.folder.scope.members(expr.name, each) for each in self.folder.program.ancestry(cls)]
        return cls if sum(map(len, given)) <= 1 else None

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what the methods of its class leave a field with, of the one object where one call makes it."""
        cls = self.class_of(expr, env)
        if cls is None:
            return ()
        maker = self.folder.makers.of_python(expr.base, env)
        made = maker.made if maker is not None and maker.this is cls else None
        place = Env(env.func, env.at, this=cls, made=made, depth=env.depth + 1)
        return self.folder.members.member_value(expr.name, cls, place)

    def _first_handed(self, expr: Expr, env: Env) -> Bound | None:
        """The object that is handed from one function to the next, as the first one has it."""
        found: Bound | None = None
        for _ in range(MAX_DEPTH):
            further = self.folder.structures.copied(expr, env)
            if further is None:
                break
            found, expr, env = further, further.expr, further.env
        return found
