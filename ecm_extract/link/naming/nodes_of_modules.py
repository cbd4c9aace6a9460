"""The nodes of modules: the one that what a module has stands below, and those that its calls hand to others."""

from __future__ import annotations

from collections.abc import Mapping

from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.naming.handles import Handles
from ecm_extract.link.naming.node_names import NodeName, NodeNames
from ecm_extract.link.naming.nodes_handed import NodesHanded
from ecm_extract.link.naming.nodes_of_programs import NodesOfPrograms
from ecm_extract.link.owning.modules import Module, Modules


class NodesOfModules:
    """Knows them, each module once.

    Args:
        handles: tells what expressions are, whoever asks.
        names: what nodes are called.
        sites, modules: know the calls, and whose they are.
    """

    def __init__(self, handles: Handles, names: NodeNames, sites: Sites, modules: Modules) -> None:
        self._all = handles
        self._names = names
        self._sites = sites
        self._modules = modules
        self._programs = NodesOfPrograms(names, modules)
        self._handles: dict[Module, Handles] = {}

    def handles(self, module: Module) -> Handles:
        """Return what tells handles where the calls of a module say what parameters are."""
        if module not in self._handles:
            self._handles[module] = self._all.within(NodesHanded(self._sites, self._modules, module))
        return self._handles[module]

    def named(self, module: Module, classes: Mapping[Cls, NodeName]) -> NodeName | None:
        """Return the name that a module gives its node, by its class or by a call in its main file."""
        if module.cls is not None:
            return classes.get(module.cls)
        return self._names.of_program(module.main) if module.main is not None else None

    def around(self, module: Module, classes: Mapping[Cls, NodeName]) -> str | None:
        """Return the name of the node below which a module has what stands below no other one that is known."""
        if module.main is not None:
            return self._programs.of(module)
        node = self.named(module, classes)
        return node.in_graph if node is not None else None
