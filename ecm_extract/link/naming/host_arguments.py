"""What hosts give to plugins: the arguments of calls on a class or a base, for the method called and its overrides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.object_states import is_own


class HostArguments:
    """Finds the calls of hosts, each method once; what a host has of its own makers is followed one step."""

    def __init__(self, sites: Sites) -> None:
        self.sites = sites
        self._places: dict[Func, tuple[tuple[Invocation, Env], ...]] = {}

    def of(self, func: Func, parameter: str) -> Sequence[Bound]:
        """Return what each host in the tree gives a method by a parameter, with the place of the call.

        Args:
            func: a method of a class; hosts call it, or the method of a base that it overrides.
            parameter: its name there.
        """
        if func not in self._places:
            self._places[func] = tuple([(call, env) for call in self._calls(func) for env in self._made(call)])
        given = (bind(func, call, env).get(parameter) for call, env in self._places[func])
        return [bound for bound in given if bound is not None]

    def _calls(self, func: Func) -> Iterator[Invocation]:
        """The calls on its class or a base that may run the method; one that calls that of its own base is no host."""
        bases = self.sites.program.ancestry(func.cls)[1:] if func.cls is not None else ()
        same = (method for base in bases for method in base.methods if method.fact.name == func.fact.name)
        called = (method for method in (func, *same) if len(method.params) == len(func.params))
        found = dict.fromkeys(call for method in called for call in self.sites.callers(method))
        yield from (call for call in found if call.receiver is not None and not is_own(call.receiver))

    def _made(self, call: Invocation) -> Sequence[Env]:
        """The place of a call, once for each way in which the tree makes the object that calls."""
        return [*self.sites.makings(call.func, call.at)] or [self.sites.root_env(call.func, call.at)]
