"""Sites whose outermost function anybody may hand anything: it was given away, or its class was (`other_makers`)."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Expr, Opaque

from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.other_makers import OtherMakers
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.running.given_functions import GivenFunctions


class HandedRoots:
    """Tells them, and what they leave open: defaults of parameters are one of the things that they may be handed."""

    def __init__(self, given: GivenFunctions, makers: OtherMakers) -> None:
        self._given = given
        self._makers = makers

    def has(self, site: Site) -> bool:
        """Tell whether whoever calls the outermost function of a site, or makes its object, may hand it anything."""
        made = site.root.is_constructor and site.owner is not None and self._makers.has(site.owner)
        return made or self._given.has(site.root)

    def profiles(self, site: Site) -> Iterator[Expr]:
        """Yield what a call takes for a profile, by the places of its form; what may be anything is open."""
        for expr in positions(site.form.qos, site.call):
            yield Opaque("handed") if site.takes(expr) and self.has(site) else expr
