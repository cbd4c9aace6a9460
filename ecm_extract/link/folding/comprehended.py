"""Comprehensions: the elements that they give, each at a place where their loops have bound their targets."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Comprehension, Expr, Items, Name, Opaque

from ecm_extract.infer.unpacking import taken
from ecm_extract.link.folding.python_lists import MAX_ITEMS
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Comprehended:
    """Runs comprehensions element by element."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def elements(self, expr: Comprehension, env: Env) -> list[Bound] | None:
        """`[f(x) for x in xs if g(x)]` element by element."""
        places = [env]
        for loop in expr.loops:
            each = env.func.fact.body[loop] if loop < len(env.func.fact.body) else None
            wider: list[Env] = []
            for place in places:
                items = self.folder.lists.items(each.value, place) if each is not None else None
                if items is None or len(items) * len(places) > MAX_ITEMS:
                    return None
                wider += [self._bound_to(each.target, item, place) for item in items if each is not None]
            places = wider
        return self._passing(expr, places)

    def _bound_to(self, target: Expr | None, item: Bound, env: Env) -> Env:
        """A place at which a loop has bound its target to an element."""
        if isinstance(target, Name):
            return self.folder.flow.naming(env, {target.id: item})
        given: dict[str, Bound] = {}
        for part, value in taken(target.items if isinstance(target, Items) else (), item.expr):
            if isinstance(part, Name):
                given[part.id] = Bound(value if value is not None else Opaque(part.id), item.env)
        return self.folder.flow.naming(env, given)

    def _passing(self, expr: Comprehension, places: Iterable[Env]) -> list[Bound] | None:
        kept: list[Bound] = []
        for place in places:
            tests = [self.folder.flow.truth(test, place) for test in expr.tests]
            if None in tests and False not in tests:
                return None
            if False not in tests:
                kept.append(Bound(expr.element, place))
        return kept
