"""Classes of which modules make objects, or that they are."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.modules import Module
from ecm_extract.link.owning.reach import Reach


class MadeClasses:
    """Tells them; each family of classes is asked about once a module."""

    def __init__(self, sites: Sites, reach: Reach) -> None:
        self.sites = sites
        self.reach = reach
        self._known: dict[tuple[Module, Cls], Sequence[Cls]] = {}

    def of(self, module: Module, cls: Cls) -> Sequence[Cls]:
        """Return a class and those that derive from it, as far as a module makes objects of just them, or is one."""
        asked = (module, cls)
        if asked not in self._known:
            family = (cls, *self.sites.program.derived(cls))
            own = [each for each in family if each is module.cls]
            self._known[asked] = own or [each for each in family if self._makes(module, each)]
        return self._known[asked]

    def _makes(self, module: Module, cls: Cls) -> bool:
        if self.sites.other_makers.has(cls):
            return True
        makers = (call.func for call in self.sites.makers(cls) if not self.sites.making.is_base_of(call, cls))
        return any(self.reach.reaches(module, [maker]) for maker in makers)
