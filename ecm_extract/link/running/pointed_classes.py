"""Of which classes objects of C++ are that a pointer may point to: all that makes one of them tells it."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Expr, Member, Name

from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_FOLLOWED: Final = 24
"""Variables that hand an object on, each to the next, and makers of it."""


class PointedClasses:
    """Follows pointers to the calls that make what they point to."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, expr: Expr, env: Env) -> frozenset[Cls]:
        """Return the classes of which an object may be; none where one of its makers is not known."""
        found: set[Cls] = set()
        pending, seen = deque([Bound(expr, env)]), set[tuple[Expr, Env]]()
        while pending:
            bound = pending.popleft()
            if (bound.expr, bound.env) in seen:
                continue
            seen.add((bound.expr, bound.env))
            cls = self._made(bound)
            before = self._before(bound) if cls is None and len(seen) < MAX_FOLLOWED else ()
            if cls is None and not before:
                return frozenset()
            found.update([cls] if cls is not None else ())
            pending.extend(before)
        return frozenset(found)

    def _made(self, bound: Bound) -> Cls | None:
        """The class that an expression itself makes an object of."""
        written = pointed(bound.expr)
        return self.folder.objects.class_written(written, bound.env) if written else None

    def _before(self, bound: Bound) -> Iterable[Bound]:
        """What may have given a variable the object; nothing where not all is known."""
        expr, env = bound.expr, bound.env
        if env.depth > MAX_DEPTH:
            return ()
        if isinstance(expr, Member) and expr.base == THIS:
            return self._given_to_member(expr, env)
        if not isinstance(expr, Name):
            return ()
        helds = self.folder.origins.held(expr, env)
        known = [Bound(held.expr, held.env) for held in helds if held.how == "value" and held.expr and held.env]
        return known if len(known) == len(helds) else ()

    def _given_to_member(self, expr: Member, env: Env) -> Iterable[Bound]:
        """What the class at hand gives a member; nothing where a derived one, or somebody else, may give it more."""
        cls, folder = env.this or env.func.cls, self.folder
        if cls is None or folder.changed_outside.is_changed(expr.name, cls):
            return ()
        derived = any(folder.scope.members(expr.name, each) for each in folder.program.derived(cls))
        return () if derived else folder.origins.makers(expr, env) or ()
