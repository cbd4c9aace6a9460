"""Call sites of forms, direct and through wrappers, to a fixed point.

A function that passes its own parameter to a form is itself a form: its call sites are the sites. The same holds
for a class that passes a constructor argument or template argument on: each place that makes an object is a site.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Iterator, Sequence, Set
from dataclasses import replace

from ecm_extract.link.code.calls import Invocation, spreads
from ecm_extract.link.code.option_structs import spread
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.call_targets import CallTargets
from ecm_extract.link.declaring.closures import given, is_of_parameter
from ecm_extract.link.declaring.deciding import deciding
from ecm_extract.link.declaring.dispatching import Dispatching
from ecm_extract.link.declaring.escaping import escaping, handed_makers
from ecm_extract.link.declaring.handed_roots import HandedRoots
from ecm_extract.link.declaring.making import Making
from ecm_extract.link.declaring.match import Matcher
from ecm_extract.link.declaring.node_interfaces import with_one_node
from ecm_extract.link.declaring.openness import MAX_CHAIN, Openness
from ecm_extract.link.declaring.other_makers import OtherMakers
from ecm_extract.link.declaring.parameters import Parameters
from ecm_extract.link.declaring.prefixes import prefixed
from ecm_extract.link.declaring.site import Site, overrides
from ecm_extract.link.declaring.site_names import SiteNames
from ecm_extract.link.declaring.starred import starred
from ecm_extract.link.declaring.template_types import TemplateTypes
from ecm_extract.link.declaring.transports import transported
from ecm_extract.link.declaring.unbound import bound
from ecm_extract.link.declaring.ways_in import WaysIn
from ecm_extract.link.declaring.wrappers import remember_wrapper
from ecm_extract.link.folding.emplaced import EMPLACING, emplaced
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.spreading import Spread
from ecm_extract.link.index.call_index import call_index
from ecm_extract.link.index.program import Program
from ecm_extract.link.interfaces.types import Types
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.dead_code import DeadCode
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.given_functions import GivenFunctions
from ecm_extract.link.running.values import Value

_LOADS_ALL = "getDeclaredClasses"
_ALSO = (
    "InputPort",
    "BidirectionalPort",
    "init",
    "init_node",
    "create_node",
    "Node",
    "LifecycleNode",
    "load",
    _LOADS_ALL,
)
"""Calls that are looked up by name without being forms: behaviour tree ports, node names, loaders of plugins."""
MAX_AGAIN = 3
"""Calls of a function by itself that are followed, one within the other."""
MAX_EXPANSIONS = 10_000
"""Ways to one call that are told apart; overloads that call each other have a number of them that grows by powers."""


class Sites:
    """Finds all sites of a program."""

    def __init__(
        self,
        program: Program,
        matcher: Matcher,
        types: Types,
        parameters: Parameters,
        also: Iterable[str] = (),
        plugins: Collection[Cls] = (),
    ) -> None:
        self.program = program
        self.plugins = frozenset(plugins)
        self.matcher = matcher
        self.types = types
        self.folder: Folder = matcher.folder
        self._dead = DeadCode(self.folder)
        self.parameters = parameters
        self._types = TemplateTypes(self.folder, types.fields)
        self._remembered: set[Func] = set()
        self.names = SiteNames(self.folder)
        self.openness = Openness(self.folder, types, program.derived)
        aliases = program.aliases.meaning(program.classes, {*matcher.forms, *also})
        self.making = Making(program, aliases)
        self.ways = WaysIn(self.folder, self.making, self._types)
        wanted = {*matcher.forms, *program.functions, *program.classes, *_ALSO, *EMPLACING, *also}
        self.calls = call_index(program, wanted, aliases)
        for name, call in list(emplaced(self.calls, self.folder.objects, matcher.forms)):
            self.calls[name].append(call)
        for call in escaping(program.every_function(), handed_makers(matcher.forms)):
            self.calls[call.last].append(call)
        self._given = GivenFunctions(self.folder)
        self.dispatching = Dispatching(self.folder, self.plugins)
        self.other_makers = OtherMakers(self.making, self.calls, self._given)
        self.handed_roots = HandedRoots(self._given, self.other_makers)
        self._calls_of = CallTargets(self.dispatching, self.calls, self._place)
        self.folder.states.callers.find = self._calling
        self.folder.states.callers.making = self._made
        self.folder.lasting.find()
        matcher.undeclared.makers = lambda cls: (call.func for call in self.makers(cls))
        matcher.undeclared.callers = self._askers

    def find(self, parameters: bool, among: Set[tuple[Func, int]] | None = None) -> list[Site]:
        """Return the sites of parameters, or of everything else, in some statements or anywhere."""
        self.folder.forget()
        found: list[Site] = []
        for last in self.matcher.forms:
            calls = (call for call in self.calls.get(last, ()) if among is None or (call.func, call.at) in among)
            for call in self._dead.without(calls):
                with self.folder.faults.of(call.func):
                    found += [closed for site in self._direct(call, parameters) for closed in self._closed(site)]
        return found

    def _direct(self, call: Invocation, parameters: bool) -> Iterator[Site]:
        func = call.func
        env = self.root_env(func, call.at)
        call = bound(call)
        for each in (spread(call), *starred(call, self.program)):
            forms = list(self.matcher.fitting(self.folder.spreading.out(each, env).call, env))
            for row in forms:
                if row.row.value is parameters:
                    of_node = with_one_node(each, row, env, self.folder)
                    written, form = transported(prefixed(of_node, row), row)
                    yield self._spread_out(Site(form, written, env, (), func.holder, func))
            if forms:
                return

    def placed(self, site: Site, env: Env) -> Site:
        """Return a site at another place."""
        return self._spread_out(replace(site.as_written(), env=env))

    def _spread_out(self, site: Site) -> Site:
        """The same site with the arguments that its call spreads, as far as they are known."""
        if not spreads(site.call):
            return site
        call, env = self.folder.spreading.out(site.call, site.env)
        return replace(site, call=call, env=env, written=Spread(site.call, site.env))

    def root_env(self, func: Func, at: int) -> Env:
        """Return the place of a statement of a function about whose callers nothing is assumed."""
        own = self.folder.nesting.object_of(func)
        made = Instance(own, {}, {}) if own is not None else None
        return Env(func, at, this=own, made=made)

    def _place(self, call: Invocation) -> Env:
        return self.root_env(call.func, call.at)

    def is_held(self, call: Invocation) -> bool:
        """Tell whether a call begins a member of a class, where the class says it has one, and not in a body."""
        return call.at == len(call.func.fact.body)

    # --- wrappers --------------------------------------------------------------------------------------

    def _closed(self, site: Site) -> Iterable[Site]:
        """Expand a site over its callers until nothing more is known; without callers it stands as it is.

        So do all behind a number of them: what their callers would tell of the name is open, and no call is left out.
        """
        pending = deque([site])
        closed: list[Site] = []
        widened: set[tuple[object, ...]] = set()
        while pending:
            is_full = len(closed) + len(pending) >= MAX_EXPANSIONS
            current = pending.popleft()
            if self._types.leads_elsewhere(current):
                continue
            wider = self._further(current, is_full)
            further = (current.certain, current.owner, *((each.chain, each.owner, each.env.this) for each in wider))
            if not wider or self._has_other_callers(current, wider):
                closed.extend(map(self._spread_out, self.ways.in_each_state(current.as_written())))
            elif self.other_makers.are_left_out(current, wider):
                alone = replace(self.ways.of_class(current, current.owner), certain=False, sole=False)
                closed.extend(map(self._spread_out, self.ways.in_each_state(alone)))
            if wider and further not in widened:  # states of what was outermost make no difference further out
                widened.add(further)
                pending.extend(each for each in wider if each.sole or not self.dispatching.is_seen_elsewhere(each))
        closed += [replace(site, certain=False)] * any(map(self._goes_on, closed))
        return self._alike_in_all_states(closed)

    def _further(self, site: Site, is_full: bool) -> Sequence[Site]:
        """A site seen from one call further out; where that is too far, or too much, the place is told."""
        wider = self._wider(site)
        if not is_full and len(site.chain) < MAX_CHAIN:
            return list(wider)
        if next(wider, None) is not None:
            self.folder.steps.give_up(site.env)
        return []

    def _has_other_callers(self, site: Site, wider: Sequence[Site]) -> bool:
        """Tell whether somebody may call the outermost function of a site who is none of those that do."""
        calls = self.callers(site.root)
        called = any(each.chain and each.chain[0] in calls for each in wider)
        return called and self.is_given(site.root)

    def is_given(self, func: Func) -> bool:
        """Tell whether somebody gets a function who may call it with anything."""
        return self._given.has(func)

    def _goes_on(self, site: Site) -> bool:
        """Tell whether a function calls itself once more than is followed."""
        own = (call for call in self._calls_of.own(site.call.func) if site.chain.count(call) >= MAX_AGAIN)
        return any(self.folder.flow.is_reached(replace(site.env, at=call.at, state=None)) for call in own)

    def _alike_in_all_states(self, sites: Sequence[Site]) -> list[Site]:
        """What has one name in all states in which the same calls lead to it has that name, whichever state it is."""
        names: dict[tuple[Invocation, ...], set[tuple[Value, ...]]] = defaultdict(set)
        for site in sites if not all(site.certain for site in sites) else ():
            names[site.chain].add(self.names.of(site))
        single = {chain for chain, found in names.items() if len(found) == 1 and all(len(each) == 1 for each in found)}
        return [replace(site, certain=site.certain or (site.sole and site.chain in single)) for site in sites]

    def _wider(self, site: Site) -> Iterator[Site]:
        params, made = self.openness.of(site, self.names.of(site))
        given = site.root.given
        if not params & given:
            params |= deciding(site, self.names.of(site), self.folder)
        around = {name for func in self.folder.nesting.around(site.root) for name in func.given}
        if params & (given | set(site.root.own_template)) or (params | made) & around:
            if site.form.row.value and site.root not in self._remembered:
                self._remembered.add(site.root)
                remember_wrapper(site, self.folder, self.parameters)
            callers = list(self._callers(site))
            yield from callers
            if callers or (params & given and not overrides(site.root) and not self._is_loaded(site.root)):
                return
        if made and site.owner is not None:
            yield from self._makers(site, site.owner)

    def _callers(self, site: Site) -> Iterator[Site]:
        root = site.root
        if root.is_constructor:
            yield from self._makers(site, site.owner) if site.owner is not None else ()
            return
        own = [call for call in self._calls_of.own(root) if site.chain.count(call) < MAX_AGAIN]
        others = [call for call in self.callers(root) if call not in site.chain]
        for call in self._dead.without([*others, *own]):
            for outer, certain in self.ways.places(self.dispatching.at_hand(root, call, self._place(call))):
                runs = self.dispatching.through(site, call, outer)
                if runs is None:
                    continue
                inner = replace(site, certain=site.certain and certain and runs, sole=site.sole and runs)
                wider = self._through(inner, call, outer)
                if is_of_parameter(call):
                    handing = self._callers(wider)
                    yield from (each for each in handing if given(root, call, each.places[1]) is not None)
                elif not (self._names_an_instance(wider, root) and self._depends(site)):
                    yield wider

    def entering(self, site: Site) -> Iterator[tuple[Func, bool]]:
        """Yield the functions that enter the outermost one of a site, and whether their arguments lead to the site."""
        for wider in self._callers(site):
            if len(wider.chain) > len(site.chain):
                yield wider.root, self.folder.flow.is_reached(wider.env)

    def _is_loaded(self, func: Func) -> bool:
        """Tell whether a method runs on plugins, its class or one that derives from it being one."""
        cls = func.cls
        return cls is not None and any(each in self.plugins for each in (cls, *self.program.derived(cls)))

    def _depends(self, site: Site) -> bool:
        """Tell whether whoever calls the outermost function of a site has a say in its name."""
        return any(value.open("param") for value in self.names.of(site))

    def _names_an_instance(self, site: Site, func: Func) -> bool:
        """Tell whether the host of a plugin gives its method a name that only the configuration knows."""
        own = site.root.cls is not None and func.cls in self.program.ancestry(site.root.cls)
        if own or not self._is_loaded(func):
            return False
        return any(value.confidence == "pattern" and not value.open("param") for value in self.names.of(site))

    def _calling(self, func: Func) -> Iterator[tuple[Invocation, Env]]:
        return ((call, self.dispatching.at_hand(func, call, self._place(call))) for call in self.callers(func))

    def callers(self, func: Func) -> Sequence[Invocation]:
        """Return the calls of a function by others."""
        return self._calls_of.callers(func)

    def _askers(self, func: Func) -> Iterator[Func]:
        return (call.func for call in self.callers(func))

    def _through(self, site: Site, call: Invocation, outer: Env) -> Site:
        """Rebuild the chain of environments from a new outermost call."""
        env = self.ways.enter(call, site.first, outer)
        return self._widened(site, call, outer, env)

    def _widened(self, site: Site, call: Invocation, outer: Env, root: Env) -> Site:
        """The same site, seen from one call further out."""
        *places, env = self.ways.inside(site, root)
        chain, owner = (call, *site.chain), call.func.holder and outer.this
        wider = replace(site.as_written(), env=env, chain=chain, owner=owner, root=call.func)
        return self._spread_out(replace(wider, places=(outer, *places)))

    # --- objects -----------------------------------------------------------------------------------------

    def _makers(self, site: Site, cls: Cls) -> Iterator[Site]:
        """One site for each class that derives from `cls`, and for each place that makes one."""
        at = site.first.at
        own, may_run = site.owner is site.root.cls, self.folder.objects.may_run
        for derived in self.program.derived(cls) if own else ():
            yield self._spread_out(self.ways.of_class(site, derived))
        for call in self.makers(cls):
            if call.func.holder is cls or (own and self.making.is_base_of(call, cls)):
                continue
            if call not in site.chain and may_run(site.root, cls, call):
                exact, sure = cls if own else site.exact, self.making.is_sure(cls)
                for outer, certain in self.ways.places(self.root_env(call.func, call.at)):
                    known = site.certain and certain and sure
                    each = replace(site, certain=known, sole=site.sole and sure, exact=exact)
                    inner = self._in_made(Env(site.root, at), cls, call, outer)
                    yield self._widened(each, call, outer, inner)

    def _in_made(self, place: Env, cls: Cls, call: Invocation, outer: Env) -> Env:
        """A statement of a method, of an object that a call makes."""
        func = place.func
        constructor = self.folder.objects.constructor(cls, call)
        args = bind(constructor, call, outer) if constructor is not None else {}
        types = self._types.of_class(cls, call, outer)
        made = Instance(cls, args, types, constructor, exact=True)
        made = made if func is constructor else self.folder.objects.delegated(made)
        own = made.args if func.is_constructor and func.cls is cls else {}
        return Env(func, place.at, own, types, cls, made)

    def made_by(self, call: Invocation, cls: Cls, outer: Env) -> Instance | None:
        """Return how a call at a place makes an object of a class."""
        return self._in_made(outer, cls, call, outer).made

    def makings(self, func: Func, at: int) -> Iterator[Env]:
        """Yield a place once for each call in the tree that makes the object at hand; nothing for functions."""
        cls = func.holder
        for call in self.makers(cls) if cls is not None else ():
            if cls is not None and call.func.cls is not cls:
                yield self._in_made(Env(func, at), cls, call, self.root_env(call.func, call.at))

    def makers(self, cls: Cls) -> Iterator[Invocation]:
        """Yield the calls that make objects of a class."""
        return (call for call in self.calls.get(cls.fact.name, ()) if self.making.makes(call, cls))

    def _made(self, cls: Cls) -> Iterator[tuple[Invocation, Env]]:
        return ((call, self._place(call)) for call in self.makers(cls))
