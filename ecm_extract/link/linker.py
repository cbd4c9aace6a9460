"""Link a whole tree: from facts by package to endpoints by module."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from ecm_checker.contract import Evidence, Interface, Qos
from ecm_checker.hub.local_name import LocalName
from ecm_parsers.source.expr import Text

from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.forms import FormTable
from ecm_extract.link.declaring.listed import defaults_of, listed_parameters
from ecm_extract.link.declaring.match import Matcher, handle_argument, is_callback, latch_argument
from ecm_extract.link.declaring.parameters import Home, Parameters
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.declaring.unmodelled import Unmodelled
from ecm_extract.link.endpoints.claims import Claim, claims_of
from ecm_extract.link.endpoints.diagnoses import SUMMARIES, Diagnosis, diagnoses
from ecm_extract.link.endpoints.endpoint_conditions import EndpointConditions
from ecm_extract.link.endpoints.endpoint_types import EndpointTypes, role_of
from ecm_extract.link.endpoints.fallbacks import default_of
from ecm_extract.link.endpoints.frames import frame_of
from ecm_extract.link.endpoints.generated import GeneratedParameters
from ecm_extract.link.endpoints.listeners import LISTENER
from ecm_extract.link.endpoints.merging import merged
from ecm_extract.link.endpoints.needed import Needed
from ecm_extract.link.endpoints.observe import Observation, observation_forms, observations
from ecm_extract.link.endpoints.open_defaults import OpenDeclarations
from ecm_extract.link.endpoints.qos import QosReader
from ecm_extract.link.endpoints.reconfigured import SERVICE, Placed, beside, serving
from ecm_extract.link.endpoints.stamps import Stamp, stamps
from ecm_extract.link.folding.data import UNKNOWN, stated_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.placing import placed
from ecm_extract.link.index.module_kinds import is_managed
from ecm_extract.link.index.program import Program
from ecm_extract.link.interfaces.types import Types
from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.naming.handles import Handles
from ecm_extract.link.naming.host_arguments import HostArguments
from ecm_extract.link.naming.implied_names import fixed_name, name_below, place_at
from ecm_extract.link.naming.local_names import local_name, local_parameter
from ecm_extract.link.naming.names import (
    is_below_handle,
    is_below_node,
    is_never_made,
    of_node,
    without_empty_default,
)
from ecm_extract.link.naming.node_names import NodeName, NodeNames
from ecm_extract.link.naming.nodes_of_modules import NodesOfModules
from ecm_extract.link.naming.plugin_names import Names, with_own_names
from ecm_extract.link.naming.sole_objects import SoleObjects
from ecm_extract.link.naming.values_given import ValuesGiven
from ecm_extract.link.owning.activation import Activation
from ecm_extract.link.owning.built import files_of
from ecm_extract.link.owning.made import units_of
from ecm_extract.link.owning.made_unseen import SeenMakers
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.owning.ownership import Ownership
from ecm_extract.link.owning.references import References, Unit
from ecm_extract.link.owning.registry import build_registry, plugins_of
from ecm_extract.link.running.env import Bound
from ecm_extract.link.running.own_names import known_beside
from ecm_extract.link.running.scope import Scope
from ecm_extract.link.running.settling import settle
from ecm_extract.link.running.values import Value, settled, unknown, weaker
from ecm_extract.read.facts import PackageFacts
from ecm_extract.resolve.layout import layouts
from ecm_extract.resolve.sight import Sight
from ecm_extract.tree import Tree

MAX_NAMES = 40
_Found = TypeVar("_Found", Observation, Stamp, Diagnosis)


@dataclass(frozen=True, slots=True)
class LinkedModule:
    """A module with its endpoints and the name of its node.

    `local` holds, by role, name and type of an endpoint, its names for any namespace and node (`local_names`):
    several where parameters tell endpoints apart. `claims` are hardware interfaces, None for no controller.
    `lifecycle`: it works when active only. `lines`: endpoints one by one where several lines make one, with their QoS.
    `diagnoses`: failures that it reports. `named_at`: the line that names its node.
    """

    module: Module
    node: str | None
    interfaces: tuple[Interface, ...]
    local: Mapping[tuple[str, str, str | None], Sequence[LocalName]] = field(default_factory=dict)
    claims: tuple[Claim, ...] | None = None
    observations: tuple[Observation, ...] = ()
    lifecycle: bool = False
    stamps: tuple[Stamp, ...] = ()
    lines: tuple[Interface, ...] = ()
    diagnoses: tuple[Diagnosis, ...] = ()
    named_at: Evidence | None = None


class Linker:
    """Everything that is known of one tree while its endpoints are found."""

    def __init__(self, packages: Sequence[PackageFacts], forms: FormTable) -> None:
        packages = self.packages = sorted(packages, key=lambda package: package.root.path)
        files = files_of(packages)
        self.program = Program(files, Sight(packages, files), layouts(packages))
        settle(self.program)
        self.parameters = Parameters(forms)
        self.folder = Folder(self.program, Scope(self.program), self.parameters)
        self.types = Types(self.folder)
        self.qos = QosReader(self.folder)
        matcher = Matcher(forms, self.folder)
        self.registry = registry = build_registry(self.program, packages)
        also, plugins = (*observation_forms(), *SUMMARIES, LISTENER), plugins_of(self.program, registry)
        self.sites = Sites(self.program, matcher, self.types, self.parameters, also, plugins)
        self.unmodelled = Unmodelled(self.folder, self.sites.calls.keys() | forms.keys(), forms)
        makers = SeenMakers(self.program, registry.classes)
        self.handles = Handles(self.folder, HostArguments(self.sites), SoleObjects(self.sites, makers))
        self.folder.prefixes = self.handles.prefix
        self.typing = EndpointTypes(self.folder, self.types, packages)
        self.names = NodeNames(self.folder, self.sites, registry.classes)
        self.handles.new.names = self.names.of_object
        self.given = ValuesGiven(self.names)
        self.generated = GeneratedParameters(self.sites, packages)
        self.parameter_sites: list[Site] = []
        self.helpers: frozenset[str] = frozenset()  # names of functions that lead to what is declared
        self.references = References(self.sites)
        self.modules = Modules(self.program, self.references, registry)
        self.ownership = Ownership(self.sites, self.modules, makers)
        self.conditions = EndpointConditions(self.sites, self.modules)
        self.needed = Needed(self.sites, self.modules)
        self.open_declarations = OpenDeclarations()
        self.nodes = NodesOfModules(self.handles, self.names, self.sites, self.modules)
        self._observed: dict[Module, list[Observation]] = defaultdict(list)
        self._stamped: dict[Module, list[Stamp]] = defaultdict(list)
        self._diagnosed: dict[Module, list[Diagnosis]] = defaultdict(list)
        self._servers: dict[tuple[Module, Unit], list[Placed]] = defaultdict(list)
        self._local: dict[Module, Names] = defaultdict(dict)

    def link(self) -> list[LinkedModule]:
        """Return all modules with their endpoints, in a stable order."""
        self.declare()
        return self.attributed()

    def declare(self) -> None:
        """Find the parameters that are declared; what values are is known from then on."""
        self.generated.declare(self.parameters)
        self._declare_ports()
        self.parameter_sites = self.sites.find(parameters=True)
        self._declare_defaults(self.parameter_sites)
        self.folder.forget()
        self.given.forget()

    def attributed(self) -> list[LinkedModule]:
        """Return what `link` does, once parameters are declared."""
        nodes = self._class_nodes()
        self.modules.find({unit: name.text for unit, name in nodes.items() if "{" not in name.text})
        found: dict[Module, list[Interface]] = defaultdict(list)
        sites = [*self.sites.find(parameters=False), *self.parameter_sites]
        self.helpers = frozenset([each.func.fact.name for site in sites for each in (*site.chain, site.call)])
        for site in sites:
            with self.folder.faults.of(site.root):
                self._attribute(site, found, nodes)
        self._generate(found)
        self.modules.note(main for main in self.registry.programs if self.names.of_program(main) is not None)
        activation = Activation(self.sites, self.registry.programs)
        self._given_out(observations(self.sites, activation), self._observed)
        self._given_out(stamps(self.sites), self._stamped)
        self._given_out(diagnoses(self.sites), self._diagnosed)
        self._local |= with_own_names(self._local, self.packages, self.registry)
        return [self._linked(module, found, nodes) for module in self.modules.in_order()]

    def _generate(self, found: dict[Module, list[Interface]]) -> None:
        """Give what build files generate to the modules whose units use it."""
        for unit, interfaces, config in self.generated.interfaces():
            for module in self.modules.owners(unit):
                servers = serving(self._servers.get((module, unit), ()), config)
                placed = [entry for each in interfaces for entry in beside(each, servers)]
                found[module] += [entry.interface for entry in placed]
                self._local[module] |= {_key(entry.interface): [entry.local] for entry in placed if servers}

    def tell(self, tree: Tree) -> None:
        """Report the places whose values were not computed to the end to the tree that they stand in."""
        for entry in (*self.folder.steps.left_out(), *self.folder.faults.told(), *self.unmodelled.told()):
            tree.report(entry)

    def _given_out(self, found: Iterable[tuple[Unit, _Found]], by_module: dict[Module, list[_Found]]) -> None:
        """Give what units do to the modules that have them."""
        for unit, entry in found:
            for module in self.modules.owners(unit):
                by_module[module].append(entry)

    def _class_nodes(self) -> dict[Cls, NodeName]:
        classes = (cls for group in self.program.classes.values() for cls in group if self.modules.is_module(cls))
        names = {cls: self.names.of_class(cls) for cls in classes}
        return {cls: name for cls, name in names.items() if name is not None}

    def _declare_ports(self) -> None:
        """Behaviour tree ports carry defaults like parameters do: `InputPort<T>("name", default, "description")`."""
        for name in ("InputPort", "BidirectionalPort"):
            for call in self.sites.calls.get(name, ()):
                if len(call.args) == 3 and isinstance(call.args[0], Text) and call.func.cls is not None:
                    env = self.sites.root_env(call.func, call.at)
                    self.parameters.declare(call.args[0].value, call.func.cls, (call.args[1], env))

    def _declare_defaults(self, sites: Iterable[Site]) -> None:
        for site in (each for each in sites if not each.form.fallback):
            owner = (site.owner,) if site.owner is not None else ()
            homes: tuple[Home, ...] = (site.root.file.package, site.root.file, *owner)
            for each in defaults_of(site, self.sites.names.of(site), self.folder):
                begun = self.given.of(site, each.name.text, each.default)
                for home in homes if begun is not each.default else ():
                    self.parameters.give_instead(each.name.text, home)
                if begun is not None and stated_type(begun.expr) is None:
                    for home in homes:
                        self.parameters.declare(each.name.text, home, (begun.expr, begun.env))

    def _linked(
        self, module: Module, found: Mapping[Module, list[Interface]], nodes: Mapping[Cls, NodeName]
    ) -> LinkedModule:
        local = self._local.get(module, {})
        claims = claims_of(module.cls, self.folder) if module.cls is not None else None
        seen = tuple(dict.fromkeys(self._observed.get(module, ())))
        lines = self.conditions.named(module, found.get(module, ()))
        interfaces = merged(lines, self.open_declarations.of(module))
        managed = module.cls is not None and is_managed(module.cls, self.program)
        stamped = tuple(dict.fromkeys(self._stamped.get(module, ())))
        told = tuple(dict.fromkeys(self._diagnosed.get(module, ())))
        node = self.nodes.named(module, nodes)
        text, at = (node.text, node.at) if node is not None and not node.is_open and node.in_graph else (None, None)
        return LinkedModule(module, text, interfaces, local, claims, seen, managed, stamped, lines, told, at)

    # --- endpoints ---------------------------------------------------------------------------------------

    def _attribute(self, site: Site, found: dict[Module, list[Interface]], nodes: Mapping[Cls, NodeName]) -> None:
        for unit in units_of(site, self.sites, self.modules):
            for module in self.ownership.owners(unit, site):
                self._give(site, unit, module, found[module], self.nodes.around(module, nodes))

    def _give(self, site: Site, unit: Unit, module: Module, found: list[Interface], node: str | None) -> None:
        origin = None if unit is module.cls or unit is module.main or module.kind == "library" else unit.fact.name
        handles = self.nodes.handles(module)
        given = handle_argument(site.form, site.call)
        handle = handles.of(given, site.env, only=bool(site.form.fixed and site.form.node))
        for interface, local in self._interfaces(site, handle, node, origin):
            found.append(interface)
            self.conditions.note(module, site, interface)
            self.open_declarations.note(module, site, interface)
            names = self._local[module].setdefault(_key(interface), [])
            names += [local] * (local not in names)
            if interface.type == SERVICE:
                for maker in {unit, site.call.func.holder or site.call.func}:
                    self._servers[module, maker].append(Placed(interface, local, next(iter(site.call.types), "")))

    def _interfaces(
        self, site: Site, handle: Handle, node: str | None, origin: str | None
    ) -> Iterator[tuple[Interface, LocalName]]:
        for each in handle.each():
            yield from self._below(self.conditions.below(each, site), site, node, origin)

    def _below(
        self, handle: Handle, site: Site, node: str | None, origin: str | None
    ) -> Iterator[tuple[Interface, LocalName]]:
        ros = site.root.file.ros
        evidence = tuple(Evidence(path, line) for path, line in site.lines())
        when = self.conditions.of(site)
        names = self._named(site)
        is_choice = any("one_of" in (named.confidence, named.beside) for named, _ in names)
        for written, default in names:
            named = written if site.form.row.value else without_empty_default(written)
            named = self.given.renamed(site, named, handle, node)
            value = of_node(named, node, ros)
            own = settled(named)
            local = local_parameter(own, handle, ros) if site.form.row.value else local_name(own, handle, node)
            name = name_below(site, value, handle, node)
            if is_never_made(value, name, ros) and not site.form.row.value:
                continue
            kind, data = self._begun(site, name.resolved, default)
            confidence = known_beside(value) if is_below_node(value) else value.confidence
            if not site.certain or (is_choice and named.confidence == "pattern"):
                confidence = weaker(confidence, "one_of")  # the name of the node settles a text, no choice
            if is_below_handle(value, handle):
                confidence = weaker(confidence, handle.surely)
            if (value.text == "" and not site.form.row.value) or "{" in name.resolved:
                confidence = "pattern"  # a name that has no text, or a handle of which not all is known
            interface = Interface(
                role=role_of(site.form.role, kind),
                name=name.resolved,
                raw_name=name.raw,
                type=kind,
                qos=self._qos(site, ros),
                frame=frame_of(site, self.folder),
                confidence=confidence,
                evidence=evidence,
                default=None if data is UNKNOWN or self.conditions.exclude(default, site) else data,
                inherited_from=origin,
                when=when,
                needed=data in (None, UNKNOWN) and self.needed.has(site),
            )
            yield interface, LocalName((name.resolved,)) if site.is_absolute else local

    def _begun(self, site: Site, name: str, default: Bound | None) -> tuple[str | None, Any]:
        """The type that a site declares, and what it begins with."""
        kind, data = self._typed(site, default)
        given = self.given.of(site, name, default)
        return kind, data if given is default else UNKNOWN if given is None else self._typed(site, given)[1]

    def _typed(self, site: Site, given: Bound | None) -> tuple[str | None, Any]:
        """The type and default of a site; where an object is made with these, what all places make it with."""
        default = given.expr if given is not None else None
        kind, data = self.typing.of(replace(site, env=given.env) if given is not None else site, default)
        if data is not UNKNOWN or given is None or given.env is not site.env or site.chain:
            return kind, data
        places = self.sites.makings(site.call.func, site.call.at)
        found = [self.typing.of(self.sites.placed(site, place), default) for place in places]
        agreed = found[0] if found and all(each == found[0] for each in found) else (kind, data)
        return agreed[0] or kind, agreed[1]

    def _named(self, site: Site) -> list[tuple[Value, Bound | None]]:
        """Return the names of a site with each default."""
        form = site.form
        if form.fixed:
            return [(fixed_name(site, self.folder), None)]
        if form.items:
            listed = [(each.name, each.default) for each in listed_parameters(site, self.folder)]
            return listed or [(unknown("parameters"), None)]
        values = self.sites.names.told(site, self.sites.handed_roots.has(site))
        expr = default_of(site, values, self.folder)
        default = Bound(expr, site.env) if expr is not None else None
        place = place_at(site, self.folder)
        return [(placed(self.conditions.left(value, site), place), default) for value in values[:MAX_NAMES]]

    def _qos(self, site: Site, ros: int | None) -> Qos | None:
        form = site.form
        if not form.row.streams and (ros == 1 or not form.profile):
            return None
        given = next((expr for expr in self.sites.handed_roots.profiles(site) if not is_callback(expr)), None)
        if ros == 1:
            return self.qos.depth(given, latch_argument(form, site.call), site.env, form.implied)
        return self.qos.read(given or form.implied, site.env)


def _key(interface: Interface) -> tuple[str, str, str | None]:
    """What an endpoint is found by in `LinkedModule.local`."""
    return interface.role, interface.name, interface.type
