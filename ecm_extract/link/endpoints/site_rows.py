"""What one site declares: its endpoints with name, type, QoS and default, each as a row of the contract."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

from ecm_checker.contract import Evidence, Interface, Qos
from ecm_checker.hub.local_name import LocalName

from ecm_extract.link.declaring.listed import listed_parameters
from ecm_extract.link.declaring.match import is_callback, latch_argument
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.endpoints.endpoint_conditions import EndpointConditions
from ecm_extract.link.endpoints.endpoint_types import EndpointTypes, role_of
from ecm_extract.link.endpoints.fallbacks import default_of
from ecm_extract.link.endpoints.frames import frame_of
from ecm_extract.link.endpoints.needed import Needed
from ecm_extract.link.endpoints.qos import QosReader
from ecm_extract.link.folding.data import UNKNOWN
from ecm_extract.link.folding.placing import placed
from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.naming.implied_names import fixed_name, name_below, place_at
from ecm_extract.link.naming.local_names import local_name, local_parameter
from ecm_extract.link.naming.names import (
    is_below_handle,
    is_below_node,
    is_never_made,
    of_node,
    without_empty_default,
)
from ecm_extract.link.naming.values_given import ValuesGiven
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.own_names import known_beside
from ecm_extract.link.running.values import Value, settled, unknown, weaker

MAX_NAMES: Final = 40


class SiteRows:
    """Tells what a site declares.

    Args:
        sites: of the tree.
        given: what values are given from outside.
        conditions: under which sites count.
        needed: tells of which parameters a run needs a value.
        typing: tells the types.
    """

    def __init__(
        self, sites: Sites, given: ValuesGiven, conditions: EndpointConditions, needed: Needed, typing: EndpointTypes
    ) -> None:
        self.sites = sites
        self.folder = sites.folder
        self.given = given
        self.conditions = conditions
        self.needed = needed
        self.typing = typing
        self.qos = QosReader(sites.folder)

    def of(
        self, site: Site, handle: Handle, node: str | None, origin: str | None
    ) -> Iterator[tuple[Interface, LocalName]]:
        """Yield an endpoint, with its name for any namespace and node, for each name and all that the handle may be.

        Args:
            site: the call with its place.
            handle: by which it declares.
            node: name of the node below which it has what stands below no other one.
            origin: the class or function that it is inherited from; None for the module's own.
        """
        for each in handle.each():
            yield from self._below(self.conditions.below(each, site), site, node, origin)

    def _below(
        self, handle: Handle, site: Site, node: str | None, origin: str | None
    ) -> Iterator[tuple[Interface, LocalName]]:
        ros = site.root.file.ros
        evidence = tuple(Evidence(path, line) for path, line in site.lines())
        when = self.conditions.of(site)
        names = self._named(site)
        is_choice = any("one_of" in (named.confidence, named.beside) for named, _ in names)
        for written, default in names:
            named = written if site.form.row.value else without_empty_default(written)
            named = self.given.renamed(site, named, handle, node)
            value = of_node(named, node, ros)
            own = settled(named)
            local = local_parameter(own, handle, ros) if site.form.row.value else local_name(own, handle, node)
            name = name_below(site, value, handle, node)
            if is_never_made(value, name, ros) and not site.form.row.value:
                continue
            kind, data = self._begun(site, name.resolved, default)
            confidence = known_beside(value) if is_below_node(value) else value.confidence
            if not site.certain or (is_choice and named.confidence == "pattern"):
                confidence = weaker(confidence, "one_of")  # the name of the node settles a text, no choice
            if is_below_handle(value, handle):
                confidence = weaker(confidence, handle.surely)
            if (value.text == "" and not site.form.row.value) or "{" in name.resolved:
                confidence = "pattern"  # a name that has no text, or a handle of which not all is known
            interface = Interface(
                role=role_of(site.form.role, kind),
                name=name.resolved,
                raw_name=name.raw,
                type=kind,
                qos=self._qos(site, ros),
                frame=frame_of(site, self.folder),
                confidence=confidence,
                evidence=evidence,
                default=None if data is UNKNOWN or self.conditions.exclude(default, site) else data,
                inherited_from=origin,
                when=when,
                needed=data in (None, UNKNOWN) and self.needed.has(site),
            )
            yield interface, LocalName((name.resolved,)) if site.is_absolute else local

    def _begun(self, site: Site, name: str, default: Bound | None) -> tuple[str | None, Any]:
        """The type that a site declares, and what it begins with."""
        kind, data = self._typed(site, default)
        given = self.given.of(site, name, default)
        return kind, data if given is default else UNKNOWN if given is None else self._typed(site, given)[1]

    def _typed(self, site: Site, given: Bound | None) -> tuple[str | None, Any]:
        """The type and default of a site; where an object is made with these, what all places make it with."""
        default = given.expr if given is not None else None
        kind, data = self.typing.of(replace(site, env=given.env) if given is not None else site, default)
        if data is not UNKNOWN or given is None or given.env is not site.env or site.chain:
            return kind, data
        places = self.sites.makings(site.call.func, site.call.at)
        found = [self.typing.of(self.sites.placed(site, place), default) for place in places]
        agreed = found[0] if found and all(each == found[0] for each in found) else (kind, data)
        return agreed[0] or kind, agreed[1]

    def _named(self, site: Site) -> list[tuple[Value, Bound | None]]:
        """Return the names of a site with each default."""
        form = site.form
        if form.fixed:
            return [(fixed_name(site, self.folder), None)]
        if form.items:
            listed = [(each.name, each.default) for each in listed_parameters(site, self.folder)]
            return listed or [(unknown("parameters"), None)]
        values = self.sites.names.told(site, self.sites.handed_roots.has(site))
        expr = default_of(site, values, self.folder)
        default = Bound(expr, site.env) if expr is not None else None
        place = place_at(site, self.folder)
        return [(placed(self.conditions.left(value, site), place), default) for value in values[:MAX_NAMES]]

    def _qos(self, site: Site, ros: int | None) -> Qos | None:
        form = site.form
        if not form.row.streams and (ros == 1 or not form.profile):
            return None
        given = next((expr for expr in self.sites.handed_roots.profiles(site) if not is_callback(expr)), None)
        if ros == 1:
            return self.qos.depth(given, latch_argument(form, site.call), site.env, form.implied)
        return self.qos.read(given or form.implied, site.env)
