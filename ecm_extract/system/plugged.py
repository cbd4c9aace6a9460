"""Modules of a node: its own, and plugins, which are called as the parameters of the node call them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Final

from ecm_checker.hub.running import RunningModule

_LEADING: Final = re.compile(r"~?/?(\{[^{} ]*\})[./]")
"""What a name of a parameter begins with that is below a name which the source does not show."""
_NODE: Final = "{node}"


class Plugged:
    """A module of a node.

    Args:
        module: what runs.
        name: what the node's parameters call a plugin; empty for the node's own module.
        siblings: the plugins of the same base, itself among them: one method of that gives each of them its name.
    """

    def __init__(self, module: RunningModule, name: str = "", siblings: Iterable[RunningModule] = ()) -> None:
        self.module = module
        self.name = name
        self._own = frozenset(hole for sibling in siblings for hole in _own_holes(sibling)) if name else frozenset()

    def called(self, text: str) -> str:
        """Return a name of the plugin with the holes for its own name filled."""
        for hole in self._own:
            text = text.replace(hole, self.name)
        return text


def _own_holes(module: RunningModule) -> frozenset[str]:
    """Holes that stand for the name under which a plugin is loaded: a plugin has its parameters below that name."""
    named = (_LEADING.match(entry.raw_name or entry.name) for entry in module.endpoints if entry.row.value)
    return frozenset(match[1] for match in named if match is not None) - {_NODE}
