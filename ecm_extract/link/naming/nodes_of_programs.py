"""The node of a program: what it has that stands below none that is known may stand below any that it makes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Final

from ecm_extract.link.code.units import Func
from ecm_extract.link.naming.node_names import NodeName, NodeNames
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.owning.references import Unit

_ANY: Final = "{name}"
_ANYWHERE: Final = "{namespace}/{name}"


class NodesOfPrograms:
    """Gathers the nodes that programs make.

    Args:
        names: what nodes are called.
        modules: tells which program a function is of.
    """

    def __init__(self, names: NodeNames, modules: Modules) -> None:
        self._names = names
        self._modules = modules
        self._known: dict[Module, str | None] = {}

    def of(self, module: Module) -> str | None:
        """Return the name, with its namespace, on which all nodes of a program agree; None where it makes none."""
        if module not in self._known:
            self._known[module] = _agreed(self._stated(module), self._in(module))
        return self._known[module]

    def _stated(self, module: Module) -> NodeName | None:
        return self._names.of_program(module.main) if module.main is not None else None

    def _in(self, module: Module) -> list[NodeName | None]:
        if module.main is None or module.main.file.ros == 1:
            return []
        return [name for func, name in self._made if self._has(module, func.holder or func)]

    def _has(self, module: Module, unit: Unit) -> bool:
        """Whether a program runs a unit; to ask whose the main function of another one is would make a module of it."""
        if isinstance(unit, Func) and self._modules.is_program(unit):
            return unit is module.main
        return module in self._modules.owners(unit)

    @cached_property
    def _made(self) -> Sequence[tuple[Func, NodeName | None]]:
        return [*self._names.made_by(self._modules.by_class)]


def _agreed(stated: NodeName | None, found: Sequence[NodeName | None]) -> str | None:
    spaces = {each.space if each is not None else "" for each in found}
    if not found:
        return stated.in_graph if stated is not None else None
    if len(spaces) > 1:
        return _ANYWHERE
    names = {each.in_graph if each is not None else None for each in found}
    (space,) = spaces
    return next(iter(names)) if len(names) == 1 else f"{space}/{_ANY}" if space else _ANY
