"""Under which conditions endpoints are made: on the way to the call in its function, and on the way to that function.

A function that is handed over, or that whoever knows its base may call, runs under what nobody here sees.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec
from ecm_checker.contract import Interface
from ecm_checker.hub.condition import Condition
from ecm_parsers.source.expr import Op

from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.endpoints.around import Around
from ecm_extract.link.endpoints.conditions import Conditions, key_of
from ecm_extract.link.endpoints.sole_parameters import SoleParameters
from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.running.defaults import Asked, by_asked
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.values import Value


class EndpointConditions:
    """Finds the conditions of sites, and calls what they test as the module calls it."""

    def __init__(self, sites: Sites, modules: Modules, sole: SoleParameters) -> None:
        self._sole = sole
        self._folder = sites.folder
        conditions = Conditions(sites.folder)
        self._told = Around(sites, modules, conditions.of)
        self._asked = Around(sites, modules, conditions.asked)
        self._topics: dict[Module, dict[str, str]] = defaultdict(dict)

    def of(self, site: Site) -> tuple[Condition, ...]:
        """Return what must hold for a site to be reached, as the source calls it."""
        made = set(_made(site))
        return tuple(dict.fromkeys(each.condition for each in self._told.of(site) if not each.asks & made))

    def left(self, value: Value, site: Site) -> Value:
        """Return a value of a site by what every run that gets there has asked of parameters."""
        if not value.template:
            return value
        return by_asked(value, {each for each in self._asked.of(site) if self._is_of_one(each, value, site)})

    def _is_of_one(self, asked: Asked, value: Value, site: Site) -> bool:
        """Whether what was asked surely is of the parameter that a value has: of its name there may be others."""
        if asked.text is None or asked.part not in value.template:
            return True
        return self._sole.is_sole(asked.part.parameter, site.root.file.package)

    def below(self, handle: Handle, site: Site) -> Handle:
        """Return what a handle of a site makes of names, as `left` does for values."""
        return handle._replace(prefix=self.left(handle.prefix, site))

    def exclude(self, default: Bound | None, site: Site) -> bool:
        """Tell whether a default of a site is made with one of another parameter that no run has which gets there."""
        values = self._folder.fold(default.expr, default.env) if default is not None else ()
        return any(self.left(value, site) is not value for value in values)

    # --- names -------------------------------------------------------------------------------------------

    def note(self, module: Module, site: Site, entry: Interface) -> None:
        """Remember the topic that a variable of a module publishes."""
        target = site.call.statement.target
        if entry.row.writes and target is not None:
            self._topics[module][key_of(target)] = entry.name

    def named(self, module: Module, entries: Iterable[Interface]) -> tuple[Interface, ...]:
        """Return the endpoints of a module with conditions that name its own parameters and topics."""
        listed = tuple(entries)
        parameters = _by_name(listed)
        topics = self._topics.get(module, {})
        return tuple(_renamed(entry, parameters, topics) if entry.when else entry for entry in listed)


def _made(site: Site) -> Iterator[str]:
    """The variables that hold what a site makes: whoever asks for them asks whether that is there already."""
    for call in (*site.chain, site.call):
        target = call.statement.target
        while isinstance(target, Op) and target.op == "[]":
            target = target.operands[0]
        if target is not None:
            yield key_of(target)
    if site.form.type.startswith("receiver") and site.call.receiver is not None:
        yield key_of(site.call.receiver)


def _by_name(entries: Iterable[Interface]) -> Mapping[str, str]:
    """The parameters of a module by all that its source may call them; a name of two of them means none."""
    found: dict[str, set[str]] = defaultdict(set)
    for entry in entries:
        if entry.row.value:
            for name in (entry.name, entry.raw_name, *_below_handles(entry.raw_name), entry.name.rpartition("/")[2]):
                found[name].add(entry.name)
    return {name: next(iter(meant)) for name, meant in found.items() if len(meant) == 1}


def _below_handles(raw: str) -> Iterator[str]:
    """What a source may write of a name whose beginning a handle gives: all that stands behind a slash of it."""
    parts = raw.lstrip("~/").split("/")
    return ("/".join(parts[at:]) for at in range(len(parts)))


def _renamed(entry: Interface, parameters: Mapping[str, str], topics: Mapping[str, str]) -> Interface:
    names = {"parameter": parameters, "listeners": topics}
    when = [
        msgspec.structs.replace(each, name=names.get(each.tests, {}).get(each.name, each.name)) for each in entry.when
    ]
    return msgspec.structs.replace(entry, when=tuple(dict.fromkeys(when)))
