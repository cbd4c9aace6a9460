"""Which callers get to what a function declares, where their arguments decide a branch on the way to it.

`Manager("multi")` makes one of two endpoints: it is of the programs that say so, and of no other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_parsers.source.expr import Expr, Name

from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children
from ecm_extract.link.declaring.site import Site, overrides
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.references import References


class Decided:
    """Asks the callers of functions, each site once."""

    def __init__(self, sites: Sites, references: References) -> None:
        self.sites = sites
        self.references = references

    def callers(self, site: Site) -> Sequence[Func] | None:
        """Return the functions whose calls get to a site; None where no argument decides, or others may call it."""
        if self._is_open(site) or not self._depends(site):
            return None
        entered = list(self.sites.entering(site))
        if all(reached for _, reached in entered):
            return None
        return [func for func, reached in entered if reached]

    def _depends(self, site: Site) -> bool:
        """Whether a branch on the way asks for a parameter of the outermost function, or for what holds one."""
        given = _given(site.root)
        env = site.places[0] if site.places else site.env
        if not given or env.func is not site.root:
            return False
        flow = self.sites.folder.flow
        turns = [turn for state in flow.reached(env) for turn in flow.decisions.turns(state.path)]
        return any(turn.test is not None and given & set(_names(turn.test)) for turn in turns)

    def _is_open(self, site: Site) -> bool:
        """Whether others than those that the tree shows may enter the outermost function."""
        cls = site.root.cls
        if site.root.is_constructor:
            derived = cls is None or bool(self.sites.program.derived(cls))
            return derived or cls in self.sites.plugins
        return overrides(site.root) or self.references.hands(site.root.fact.name)


def _given(func: Func) -> set[str]:
    """The names of the parameters of a function, and of variables and members that it gives one of them."""
    given = {parameter.name for parameter in func.fact.params}
    for statement in func.fact.body if given else ():
        if statement.target is not None and statement.value is not None and given & set(_names(statement.value)):
            given |= set(_names(statement.target))
    return given


def _names(expr: Expr) -> Iterator[str]:
    if isinstance(expr, Name):
        yield expr.id
    if is_own_member(expr):
        yield expr.name
    for part in children(expr):
        yield from _names(part)
