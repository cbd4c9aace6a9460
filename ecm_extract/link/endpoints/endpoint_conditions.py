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

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites, overrides
from ecm_extract.link.endpoints.conditions import Conditions, Told, common, key_of
from ecm_extract.link.owning.modules import Module, Modules

MAX_CALLERS = 32
"""Callers of one function that are looked at; what is called from more places is told without their conditions."""


class EndpointConditions:
    """Finds the conditions of sites, and calls what they test as the module calls it."""

    def __init__(self, sites: Sites, modules: Modules) -> None:
        self.sites = sites
        self.modules = modules
        self.conditions = Conditions(sites.folder)
        self._around: dict[Func, tuple[Told, ...]] = {}
        self._topics: dict[Module, dict[str, str]] = defaultdict(dict)

    def of(self, site: Site) -> tuple[Condition, ...]:
        """Return what must hold for a site to be reached, as the source calls it."""
        made = set(_made(site))
        found = [
            *self.around(site.root),
            *(told for call, env in site.steps() for told in self.conditions.of(call, env)),
        ]
        return tuple(dict.fromkeys(each.condition for each in found if not each.asks & made))

    def around(self, func: Func) -> tuple[Told, ...]:
        """Return what holds in all places that call a function, directly or through others."""
        known = self._around.get(func)
        if known is None:
            self._around[func] = ()  # who asks in a circle
            calls = list(self._entries(func))
            known = common(self._before(call) for call in calls) if len(calls) <= MAX_CALLERS else ()
            self._around[func] = known
        return known

    def _before(self, call: Invocation) -> tuple[Told, ...]:
        env = self.sites.root_env(call.func, call.at)
        return (*self.around(call.func), *self.conditions.of(call, env))

    def _entries(self, func: Func) -> Iterable[Invocation]:
        """The calls that a function is entered by, nothing where others may enter it."""
        if func.is_constructor:
            return self._makers(func.cls) if func.cls is not None else ()
        if overrides(func) or self.modules.references.hands(func.fact.name):
            return ()
        return self.sites.callers(func)

    def _makers(self, cls: Cls) -> Iterable[Invocation]:
        """The calls that make a helper; a class with a contract of its own is made by whoever loads it."""
        if self.modules.is_module(cls) or self.sites.program.derived(cls):
            return ()
        made = [call for call in self.sites.calls.get(cls.fact.name, ()) if self.sites.makes(call, cls)]
        others = set(self.modules.references.handing(cls)) - {call.func for call in made}
        return () if others else made

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
