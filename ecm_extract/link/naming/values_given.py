"""What whoever makes a node gives it: values in the place of declared defaults, and other names for its endpoints."""

from __future__ import annotations

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.naming.handle import OWN, Handle
from ecm_extract.link.naming.names import endpoint_name, space_of
from ecm_extract.link.naming.node_names import NodeNames
from ecm_extract.link.naming.node_settings import Settings
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import Value, joined, literal, unknown


class ValuesGiven:
    """Knows what the nodes of ROS 2 are given; each is asked once until more is known of values."""

    def __init__(self, names: NodeNames) -> None:
        self.names = names
        self._known: dict[Cls | Func, Settings] = {}
        self._own: dict[Cls | Func, Settings] = {}

    def of(self, site: Site, name: str, default: Bound | None) -> Bound | None:
        """Return what a parameter begins with that is declared with a default; None where nobody knows."""
        if site.root.file.ros == 1 or not site.form.row.value:
            return default
        unit = site.owner or site.root
        if unit not in self._own:
            self._own[unit] = self.names.own_settings(unit)
        begun = self._own[unit].of_parameter(name, default)
        return self._of(site).parameters.get(name, begun)

    def renamed(self, site: Site, name: Value, handle: Handle, node: str | None) -> Value:
        """Return the name of an endpoint, or the one that a rule for it gives it instead."""
        if site.root.file.ros == 1 or site.form.row.value:
            return name
        own = endpoint_name(name, handle, node, 2).resolved
        for rule, target in self._of(site).rules.items():
            if endpoint_name(literal(rule), OWN, node, 2).resolved == own:
                return _absolute(target, space_of(OWN, node)) if target is not None else unknown("remapped")
        return name

    def _of(self, site: Site) -> Settings:
        unit = site.owner or site.root
        if unit not in self._known:
            self._known[unit] = self.names.settings_of(unit)
        return self._known[unit]

    def forget(self) -> None:
        """Drop what was asked, since more of the values is known now."""
        self._known.clear()
        self._own.clear()


def _absolute(target: Value, space: str) -> Value:
    """A name that no handle changes: one that is relative stands in the namespace of the node."""
    if target.text.startswith(("/", "~")):
        return target
    return joined([(literal(f"/{space}/" if space else "/"),), (target,)])[0]
