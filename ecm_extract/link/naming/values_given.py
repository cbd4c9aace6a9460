"""The values that parameters begin with: as they are declared, or as whoever makes the node gives them instead."""

from __future__ import annotations

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.naming.node_names import NodeNames
from ecm_extract.link.naming.node_settings import Settings
from ecm_extract.link.running.env import Bound


class ValuesGiven:
    """Knows what the nodes of ROS 2 are given; each is asked once until more is known of values."""

    def __init__(self, names: NodeNames) -> None:
        self.names = names
        self._known: dict[Cls | Func, Settings] = {}

    def of(self, site: Site, name: str, default: Bound | None) -> Bound | None:
        """Return what a parameter begins with that is declared with a default; None where nobody knows."""
        if site.root.file.ros == 1 or not site.form.row.value:
            return default
        unit = site.owner or site.root
        if unit not in self._known:
            self._known[unit] = self.names.settings_of(unit)
        return self._known[unit].of_parameter(name, default)

    def forget(self) -> None:
        """Drop what was asked, since more of the values is known now."""
        self._known.clear()
