"""Parameters that are named by others: once it is known what those are by default, they are found again."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable

from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.declaring.unheard import heard
from ecm_extract.link.running.values import is_known

Place = tuple[Func, int]
"""A function, and a statement there by its index."""


def named_by_defaults(sites: Sites, declare: Callable[[Iterable[Site]], None]) -> list[Site]:
    """Return the sites of parameters; `declare` is told of them."""
    found = _heard(sites.find(parameters=True), sites)
    declare(found)
    opened = {_place(site) for site in found if not all(map(is_known, sites.names.of(site)))}
    if not opened:
        return found
    again = sites.find(parameters=True, among=opened)
    known = _heard(_in_their_place(found, again), sites)
    declare(site for site in known if _place(site) in opened)
    return known


def _heard(found: Iterable[Site], sites: Sites) -> list[Site]:
    return heard(found, sites.matcher.undeclared, sites.program)


def _in_their_place(found: Iterable[Site], again: Iterable[Site]) -> list[Site]:
    """The sites that were found first, those that were found again in place of what they were."""
    places = defaultdict[Place, list[Site]](list)
    for site in found:
        places[_place(site)].append(site)
    anew = defaultdict[Place, list[Site]](list)
    for site in again:
        anew[_place(site)].append(site)
    return [site for place in places for site in anew.get(place) or places[place]]


def _place(site: Site) -> Place:
    return site.call.func, site.call.at
