"""What holds wherever a function is entered: on the way to each call of it, directly or through others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Generic, TypeVar

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site, overrides
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.modules import Modules
from ecm_extract.link.running.env import Env

MAX_CALLERS = 32
"""Callers of one function that are looked at; what is called from more places is told without their conditions."""
_T = TypeVar("_T")


class Around(Generic[_T]):
    """Gathers it. A function that is handed over runs under what nobody here sees, and so does one that overrides.

    Args:
        sites: where callers are known.
        modules: which classes are made by others.
        at: tells what holds where a call is evaluated.
    """

    def __init__(self, sites: Sites, modules: Modules, at: Callable[[Invocation, Env], Iterable[_T]]) -> None:
        self.sites = sites
        self.modules = modules
        self._at = at
        self._known: dict[Func, tuple[_T, ...]] = {}

    def of(self, site: Site) -> tuple[_T, ...]:
        """Return what holds where a site is reached, each once, outermost first."""
        steps = (self._at(call, env) for call, env in site.steps())
        return tuple(dict.fromkeys(each for group in (self._by_callers(site.root), *steps) for each in group))

    def _by_callers(self, func: Func) -> tuple[_T, ...]:
        known = self._known.get(func)
        if known is None:
            self._known[func] = ()  # who asks in a circle
            calls = list(self._entries(func))
            known = common(self._before(call) for call in calls) if len(calls) <= MAX_CALLERS else ()
            self._known[func] = known
        return known

    def _before(self, call: Invocation) -> tuple[_T, ...]:
        return (*self._by_callers(call.func), *self._at(call, self.sites.root_env(call.func, call.at)))

    def _entries(self, func: Func) -> Iterable[Invocation]:
        """The calls that a function is entered by, nothing where others may enter it."""
        if func.is_constructor:
            return self._makers(func.cls) if func.cls is not None else ()
        if overrides(func) or self.modules.references.hands(func.fact.name):
            return ()
        return self.sites.callers(func)

    def _makers(self, cls: Cls) -> Iterable[Invocation]:
        """The calls that make a helper; a class with a contract of its own is made by whoever loads it."""
        if self.modules.is_module(cls) or self.sites.program.derived(cls):
            return ()
        made = list(self.sites.makers(cls))
        others = set(self.modules.references.handing(cls)) - {call.func for call in made}
        return () if others else made


def common(groups: Iterable[Sequence[_T]]) -> tuple[_T, ...]:
    """Return what holds in all of several groups."""
    rest = iter(groups)
    found = tuple(next(rest, ()))
    while found and (group := next(rest, None)) is not None:  # what no place tells is not asked of the others
        found = tuple(told for told in found if told in group)
    return found
