"""Which code runs while a module is brought to work: from its beginning by calls, never through a callback."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.shipped import shipped_names

_BEGINNINGS = frozenset({"main", "<module>"})
MAX_CALLERS = 2_000


class Activation:
    """Tells of calls whether they run before their module is active.

    Args:
        sites: know who calls whom.
        programs: the main functions of programs.
    """

    def __init__(self, sites: Sites, programs: Collection[Func]) -> None:
        self._sites = sites
        self._programs = programs
        self._known: dict[Func, bool] = {}

    def runs(self, call: Invocation) -> bool:
        """Tell whether a call is reached from a beginning by calls alone; a callback is called later, if ever."""
        if call.statement.deferred:
            return False
        known = self._known.get(call.func)
        if known is None:
            known = self._known[call.func] = self._is_reached(call.func)
        return known

    def _is_reached(self, func: Func) -> bool:
        seen, pending = {func}, [func]
        while pending and len(seen) < MAX_CALLERS:
            current = pending.pop()
            if self._begins(current):
                return True
            callers = [call.func for call in self._sites.callers(current) if not call.statement.deferred]
            pending += [caller for caller in callers if caller not in seen]
            seen.update(callers)
        return False

    def _begins(self, func: Func) -> bool:
        if func.is_constructor or func in self._programs:
            return True
        if func.cls is None:
            return func.fact.name in _BEGINNINGS
        return bool(func.cls.fact.bases) and func.fact.name in _methods()


@cache
def _methods() -> frozenset[str]:
    return shipped_names("link/owning/activation.toml", "methods")
