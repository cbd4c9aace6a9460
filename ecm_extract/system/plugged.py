"""Modules of a node: its own, and plugins, which are called as the parameters of the node call them."""

from __future__ import annotations

from typing import NamedTuple

from ecm_checker.hub.local_name import LocalName, joined
from ecm_checker.hub.running import RunningModule


class Plugged(NamedTuple):
    """A module of a node; `name` is what the node's parameters call a plugin, empty for the node's own module."""

    module: RunningModule
    name: str = ""

    def called(self, local: LocalName) -> LocalName:
        """Return a name of the plugin with its own name put in."""
        if not self.name:
            return local
        parts = (part if isinstance(part, str) or part.of != "plugin" else self.name for part in local.parts)
        return LocalName(joined(parts), local.space)
