"""What hosts give to plugins: the arguments of calls on a class or a base, for the method called and its overrides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from ecm_parsers.source.expr import THIS

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, Instance
from ecm_extract.link.running.object_states import is_own

_OVERRIDABLE: Final = frozenset({"virtual", "pure", "override"})


class HostArguments:
    """Finds the calls of hosts, each method once; what a host has of its own makers is followed one step."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self._places: dict[Func, tuple[tuple[Invocation, Env], ...]] = {}

    def of(self, func: Func, parameter: str, this: Cls | None = None) -> Sequence[Bound]:
        """Return what each host in the tree gives a method by a parameter, with the place of the call.

        Args:
            func: a method of a class; hosts call it, or the method of a base that it overrides.
            parameter: its name there.
            this: the class of the object at hand, whose bases may be hosts of its methods themselves.
        """
        if func not in self._places:
            self._places[func] = tuple([(call, env) for call in self._calls(func) for env in self._made(call)])
        own = [(call, self._at_hand(call, this or func.cls)) for call in self._calls_of_bases(func)]
        given = (bind(func, call, env).get(parameter) for call, env in (*self._places[func], *own))
        return [bound for bound in given if bound is not None]

    def _calls(self, func: Func) -> Iterator[Invocation]:
        """The calls on its class or a base that may run the method; one that calls that of its own base is no host.

        A method that needs no object is called by the name of its class: `Part::begin(node)`.
        """
        found = dict.fromkeys(call for method in (func, *self._overridden(func)) for call in self.sites.callers(method))
        if func.cls is not None and func.holder is None:
            yield from (call for call in found if call.func.cls is not func.cls)
        else:
            yield from (call for call in found if call.receiver is not None and not is_own(call.receiver))

    def _calls_of_bases(self, func: Func) -> Iterator[Invocation]:
        """The calls in bases of its class of what it overrides, on the object at hand: `load(own_)` in `initialize`."""
        bases = set(self.sites.program.ancestry(func.cls)[1:]) if func.cls is not None else set()
        called = [method for method in self._overridden(func) if _is_virtual(method) or _is_virtual(func)]
        found = dict.fromkeys(call for method in called for call in self.sites.callers(method))
        yield from (call for call in found if call.func.cls in bases and (call.simple or call.receiver == THIS))

    def _overridden(self, func: Func) -> Sequence[Func]:
        """The methods of bases that a method may run in the place of."""
        bases = self.sites.program.ancestry(func.cls)[1:] if func.cls is not None else ()
        same = (method for base in bases for method in base.methods if method.fact.name == func.fact.name)
        return [method for method in same if len(method.params) == len(func.params)]

    def _at_hand(self, call: Invocation, this: Cls | None) -> Env:
        """The place of a call in a method of a base, of an object of a class that derives from it."""
        made = Instance(this, {}, {}) if this is not None else None
        return Env(call.func, call.at, this=this, made=made)

    def _made(self, call: Invocation) -> Sequence[Env]:
        """The place of a call, once for each way in which the tree makes the object that calls."""
        return [*self.sites.makings(call.func, call.at)] or [self.sites.root_env(call.func, call.at)]


def _is_virtual(func: Func) -> bool:
    """Whether a call of a method may run that of a class which derives from its own."""
    return func.file.language == "python" or not _OVERRIDABLE.isdisjoint(func.fact.traits)
