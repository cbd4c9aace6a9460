"""Whose the endpoints of a site are, where calls make the object that has them.

What a program gives its node is the node's, not the program's. An object that is no node of its own works for its
maker too, as a plugin does that another plugin makes.
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.owning.modules import Modules
from ecm_extract.link.owning.references import Unit

_NODES = frozenset({"node", "component"})


def units_of(site: Site, sites: Sites, modules: Modules) -> tuple[Unit, ...]:
    """Return the classes and functions that have what a site declares."""
    outer: Unit = site.owner or site.root
    made = _made(site, sites, modules)
    if made is None or made is outer:
        return (outer,)
    shared = site.owner is not None and modules.by_class[made].kind not in _NODES
    return (made, outer) if shared else (made,)


def _made(site: Site, sites: Sites, modules: Modules) -> Cls | None:
    """The class with a contract of its own that the calls of a site make, the innermost of several."""
    followed = (*site.chain[1:], site.call)
    for call, inner in reversed(list(zip(site.chain, followed, strict=False))):
        for cls in _run_on(inner, site, sites):
            if cls in modules.by_class and _is_home(call, cls) and sites.making.makes(call, cls):
                return cls
    return None


def _run_on(inner: Invocation, site: Site, sites: Sites) -> Iterator[Cls]:
    """The class whose function a call stands in, and the one of the object at hand where that derives from it."""
    own, exact = inner.func.cls, site.exact
    if own is not None:
        yield own
    if own is not None and exact is not None and exact is not own and own in sites.program.ancestry(exact):
        yield exact


def _is_home(call: Invocation, cls: Cls) -> bool:
    """Tell whether a class is made in its own package: what another package gives it is no promise of its own."""
    return call.func.file.package == cls.file.package
