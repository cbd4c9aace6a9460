"""Parameters that some line declares with a default which nobody sees: what other lines say is none of all runs."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Set
from dataclasses import dataclass
from typing import Final

from ecm_checker.contract import Interface
from ecm_parsers.source.expr import Constant

from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.folding.data import stated_type
from ecm_extract.link.owning.modules import Module

_NOTHING: Final = frozenset({"None", "null", "nullptr"})


@dataclass(frozen=True, slots=True)
class OpenDefaults:
    """Names of parameters with a default that is not known; `untyped`: those whose type it would have told."""

    names: Set[str] = frozenset()
    untyped: Set[str] = frozenset()


class OpenDeclarations:
    """Gathers them by module. A node of ROS 2 declares a parameter once: of several lines each is of other runs."""

    def __init__(self) -> None:
        self._names: dict[Module, set[str]] = defaultdict(set)
        self._untyped: dict[Module, set[str]] = defaultdict(set)

    def note(self, module: Module, site: Site, entry: Interface) -> None:
        """Remember a parameter if a site declares it so."""
        if entry.row.value and entry.default is None and _declares(site) and _gives_something(site):
            self._names[module].add(entry.name)
            if entry.type is None:
                self._untyped[module].add(entry.name)

    def of(self, module: Module) -> OpenDefaults:
        """Return those of a module."""
        return OpenDefaults(self._names.get(module, frozenset()), self._untyped.get(module, frozenset()))


def _declares(site: Site) -> bool:
    """Tell whether a line declares a parameter itself: of overloads of a helper it may not be the one that is meant."""
    return site.form.ros == 2 and not site.form.undeclared and not site.form.fallback and not site.chain


def _gives_something(site: Site) -> bool:
    """Tell whether a call has a default, which may be a type instead or stand for none."""
    default = next(positions(site.form.default, site.call), None)
    nothing = isinstance(default, Constant) and default.name in _NOTHING
    return default is not None and not nothing and stated_type(default) is None
