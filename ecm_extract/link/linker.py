"""Link a whole tree: from facts by package to endpoints by module."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from ecm_checker.contract import Evidence, Interface
from ecm_checker.hub.local_name import LocalName
from ecm_parsers.source.expr import Text

from ecm_extract.link.code.units import Cls
from ecm_extract.link.declaring.forms import FormTable
from ecm_extract.link.declaring.listed import bare_names, defaults_of
from ecm_extract.link.declaring.match import Matcher, handle_argument
from ecm_extract.link.declaring.named_by_defaults import named_by_defaults
from ecm_extract.link.declaring.parameters import Home, Parameters
from ecm_extract.link.declaring.site import Site
from ecm_extract.link.declaring.sites import Sites
from ecm_extract.link.declaring.unmodelled import Unmodelled
from ecm_extract.link.endpoints.claims import Claim, claims_of
from ecm_extract.link.endpoints.diagnoses import SUMMARIES, Diagnosis, diagnoses
from ecm_extract.link.endpoints.endpoint_conditions import EndpointConditions
from ecm_extract.link.endpoints.endpoint_types import EndpointTypes
from ecm_extract.link.endpoints.generated import GeneratedParameters
from ecm_extract.link.endpoints.listeners import LISTENER
from ecm_extract.link.endpoints.merging import merged
from ecm_extract.link.endpoints.needed import Needed
from ecm_extract.link.endpoints.observe import Observation, observation_forms, observations
from ecm_extract.link.endpoints.open_defaults import OpenDeclarations
from ecm_extract.link.endpoints.reconfigured import SERVICE, Placed, beside, serving
from ecm_extract.link.endpoints.site_rows import SiteRows
from ecm_extract.link.endpoints.sole_parameters import SoleParameters
from ecm_extract.link.endpoints.stamps import Stamp, stamps
from ecm_extract.link.folding.data import stated_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.index.module_kinds import is_managed
from ecm_extract.link.index.program import Program
from ecm_extract.link.interfaces.message_fields import MessageFields
from ecm_extract.link.interfaces.types import Types
from ecm_extract.link.naming.handles import Handles
from ecm_extract.link.naming.host_arguments import HostArguments
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
from ecm_extract.link.running.scope import Scope
from ecm_extract.link.running.settling import settle
from ecm_extract.read.facts import PackageFacts
from ecm_extract.resolve.layout import layouts
from ecm_extract.resolve.sight import Sight
from ecm_extract.tree import Tree

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
        self.unordered = settle(self.program)
        self.parameters = Parameters(forms)
        self.folder = Folder(self.program, Scope(self.program), self.parameters)
        self.types = Types(self.folder, MessageFields(self.folder, packages))
        matcher = Matcher(forms, self.folder)
        self.registry = registry = build_registry(self.program, packages)
        also, plugins = (*observation_forms(), *SUMMARIES, LISTENER), plugins_of(self.program, registry)
        self.sites = Sites(self.program, matcher, self.types, self.parameters, also, plugins)
        self.unmodelled = Unmodelled(self.folder, self.sites.calls.keys() | forms.keys(), forms)
        makers = SeenMakers(self.program, registry.classes)
        self.handles = Handles(self.folder, HostArguments(self.sites), SoleObjects(self.sites, makers))
        self.folder.prefixes = self.handles.prefix
        self.names = NodeNames(self.folder, self.sites, registry.classes)
        self.handles.new.names = self.names.of_object
        self.given = ValuesGiven(self.names)
        self.generated = GeneratedParameters(self.sites, packages)
        self.parameter_sites: list[Site] = []
        self.helpers: frozenset[str] = frozenset()  # names of functions that lead to what is declared
        self.references = References(self.sites)
        self.modules = Modules(self.program, self.references, registry)
        self.ownership = Ownership(self.sites, self.modules, makers)
        self.sole_parameters = SoleParameters(self.sites, self.handles)
        self.conditions = EndpointConditions(self.sites, self.modules, self.sole_parameters)
        needed, typing = Needed(self.sites, self.modules), EndpointTypes(self.folder, self.types)
        self.rows = SiteRows(self.sites, self.given, self.conditions, needed, typing)
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
        self.parameter_sites = named_by_defaults(self.sites, self._declare_defaults)
        self.sole_parameters.note(self.parameter_sites)
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
        for entry in (*self.unordered, *self.folder.left_out(), *self.unmodelled.told()):
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
            for name in bare_names(site, self.sites.names.of(site), self.folder):
                self.parameters.declare_bare(name.text, homes, site.root.file)
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
        for interface, local in self.rows.of(site, handle, node, origin):
            found.append(interface)
            self.conditions.note(module, site, interface)
            self.open_declarations.note(module, site, interface)
            names = self._local[module].setdefault(_key(interface), [])
            names += [local] * (local not in names)
            if interface.type == SERVICE:
                for maker in {unit, site.call.func.holder or site.call.func}:
                    self._servers[module, maker].append(Placed(interface, local, next(iter(site.call.types), "")))


def _key(interface: Interface) -> tuple[str, str, str | None]:
    """What an endpoint is found by in `LinkedModule.local`."""
    return interface.role, interface.name, interface.type
