"""An observation beside the contracts of what should run: what rules look at.

Matching goes through indexes by role and name. Everything derived is made when a rule first asks for it.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property

import msgspec
from ecm_checker.contract import Contract
from ecm_checker.hub.kinds import row_of
from ecm_checker.hub.roles import roles, writing_roles
from ecm_checker.view import View, view

from ecm_extract.observe.expected import Expected, Key, graph_keys, on_node
from ecm_extract.observe.instances import instances
from ecm_extract.observe.model import Endpoint, Observation, Sense
from ecm_extract.observe.standard import is_helper, is_tool


class Running(msgspec.Struct, frozen=True):
    """A node that runs and the module that it is an instance of."""

    node: str
    module: View


class Pair(msgspec.Struct, frozen=True):
    """An endpoint that was seen and what a contract says of it."""

    seen: Endpoint
    expected: Expected


class Link(msgspec.Struct, frozen=True):
    """Two endpoints that were seen on one name, the offering side first."""

    giver: Endpoint
    taker: Endpoint


class Watch:
    """One observation beside contracts.

    Attributes:
        seen: what was observed. contracts: made ready for rules.
        launched: whether the contracts are those of a launch, so that each of them must run.
    """

    def __init__(self, seen: Observation, contracts: Iterable[Contract] = (), *, launched: bool = False) -> None:
        self.seen = seen
        self.contracts = tuple(map(view, contracts))
        self.launched = launched

    @cached_property
    def modules(self) -> tuple[View, ...]:
        """Contracts of what runs; interface packages and libraries are none."""
        return tuple(each for each in self.contracts if each.runs)

    def senses(self, *wanted: Sense) -> bool:
        """Whether the source can see all of this, so that its absence means something."""
        return set(wanted) <= set(self.seen.senses)

    @cached_property
    def node_names(self) -> tuple[str, ...]:
        """Nodes that were seen, by name, without those of tools and libraries."""
        found = {node.name for node in self.seen.nodes}
        found |= {end.node for end in self.seen.endpoints if end.node is not None}
        return tuple(sorted(name for name in found if not is_tool(name) and not is_helper(name)))

    @cached_property
    def helped(self) -> frozenset[Key]:
        """Endpoints that libraries made on nodes of their own, for a node that is not told."""
        return frozenset((end.role, end.name) for end in self.seen.endpoints if end.node and is_helper(end.node))

    @cached_property
    def running(self) -> tuple[Running, ...]:
        """Nodes with the modules that they are instances of; several where nothing tells these apart."""
        return tuple(Running(node, module) for node in self.node_names for module in self._instances(node))

    def _instances(self, node: str) -> tuple[View, ...]:
        ends = {(end.role, end.name) for end in self.by_node.get(node, ())}
        return instances(node, self.modules, ends | self.helped, self.visible_roles)

    @cached_property
    def modules_of(self) -> dict[str, tuple[View, ...]]:
        """Node -> modules that it is an instance of."""
        found: defaultdict[str, list[View]] = defaultdict(list)
        for each in self.running:
            found[each.node].append(each.module)
        return {node: tuple(modules) for node, modules in found.items()}

    @cached_property
    def absent(self) -> tuple[View, ...]:
        """Modules of which no node was seen."""
        present = {each.module.id for each in self.running}
        return tuple(each for each in self.modules if each.id not in present)

    @cached_property
    def by_name(self) -> dict[Key, tuple[Endpoint, ...]]:
        """Role and name -> endpoints that were seen."""
        found: defaultdict[Key, list[Endpoint]] = defaultdict(list)
        for end in self.seen.endpoints:
            found[end.role, end.name].append(end)
        return {key: tuple(ends) for key, ends in found.items()}

    @cached_property
    def by_node(self) -> dict[str, tuple[Endpoint, ...]]:
        """Node -> its endpoints that were seen."""
        found: defaultdict[str, list[Endpoint]] = defaultdict(list)
        for end in self.seen.endpoints:
            if end.node is not None:
                found[end.node].append(end)
        return {node: tuple(ends) for node, ends in found.items()}

    @cached_property
    def expected_on(self) -> dict[str, tuple[Expected, ...]]:
        """Node -> what the contracts of its modules promise."""
        return {
            node: tuple(each for module in modules for each in on_node(module, node))
            for node, modules in self.modules_of.items()
        }

    @cached_property
    def present(self) -> tuple[Running, ...]:
        """Running modules; where a source knows no nodes, modules of which an endpoint was seen, by their own name."""
        named = {each.module.id for each in self.running}
        heard = {pair.expected.module.id: pair.expected.module for pair in self.pairs}
        return (*self.running, *(Running(name, module) for name, module in heard.items() if name not in named))

    @cached_property
    def rivals(self) -> dict[str, tuple[str, ...]]:
        """Modules of which nobody can tell whether it was they or others that were seen -> the others.

        Several contracts fit one node alike; or, where no nodes are known, another module has all that was seen of it.
        """
        shared: defaultdict[str, set[str]] = defaultdict(set)
        for modules in self.modules_of.values():
            for module in modules:
                shared[module.id] |= {each.id for each in modules} - {module.id}
        seen = self._nodeless
        for name, keys in seen.items():
            shared[name] |= {other for other, theirs in seen.items() if other != name and keys <= theirs}
        return {name: tuple(sorted(others)) for name, others in shared.items() if others}

    @cached_property
    def _nodeless(self) -> dict[str, set[Key]]:
        """Modules -> endpoints of them that were seen and of which no node is known."""
        found: defaultdict[str, set[Key]] = defaultdict(set)
        for pair in self.pairs:
            if pair.seen.node is None:
                found[pair.expected.module.id].add((pair.seen.role, pair.seen.name))
        return found

    @cached_property
    def visible_roles(self) -> frozenset[str]:
        """Roles that the source sees; of a bag, publishers, though one that is missing means nothing there."""
        recorded = writing_roles() if self.seen.source == "bag" else ()
        return frozenset((*recorded, *self.seen.senses))

    @cached_property
    def invisible(self) -> dict[str, int]:
        """What the modules that are here promise and this source cannot see: roles, and `rate`, with how many."""
        nodes: defaultdict[str, list[str]] = defaultdict(list)
        modules = {each.module.id: each.module for each in self.present}
        for each in self.running:
            nodes[each.module.id].append(each.node)
        promised = (each for name, module in modules.items() for each in self.promises_of(module, nodes[name]))
        hidden: Counter[str] = Counter(each.interface.role for each in promised if not self._is_visible(each))
        if not self.senses("rate"):
            hidden["rate"] = sum(len(module.rates) for module in modules.values())
        return {kind: count for kind, count in hidden.items() if count}

    def _is_visible(self, expected: Expected) -> bool:
        """Transforms that are looked up are judged by those that were sent."""
        if expected.interface.row.hears_transforms and self.senses("transform"):
            return True
        return any(role in self.visible_roles for role, _ in graph_keys(expected))

    @cached_property
    def is_empty(self) -> bool:
        """Whether nothing is there but tools."""
        return not self.node_names and all(end.node is not None for end in self.seen.endpoints)

    def keys_of(self, nodes: Sequence[str]) -> frozenset[Key]:
        """Endpoints of nodes, with what libraries have for them; without any, those whose node nobody told."""
        ends = [end for node in nodes for end in self.by_node.get(node, ())]
        if nodes:
            return frozenset((end.role, end.name) for end in ends) | self.helped
        return frozenset((end.role, end.name) for end in self.seen.endpoints if end.node is None)

    def promises_of(self, module: View, nodes: Sequence[str]) -> tuple[Expected, ...]:
        """What a module promises on its nodes; without any, in the root namespace."""
        return tuple(each for node in (nodes or (None,)) for each in on_node(module, node))

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """Endpoints with what contracts say of them: of their node where it is known, else of anybody."""
        return tuple(self._pairs())

    @cached_property
    def topics(self) -> tuple[Link, ...]:
        """Every publisher with every subscriber of its topic."""
        return tuple(link for role in writing_roles() for link in self._links(role, roles()[role].peer))

    @cached_property
    def hashes(self) -> dict[str, str]:
        """Message type -> hash by the contracts of interface packages."""
        entities = (each for module in self.contracts for each in module.contract.versioning.entities)
        return {each.name: each.signature for each in entities if row_of(each.kind).generated and each.signature}

    def _pairs(self) -> Iterator[Pair]:
        anybody = _by_key(each for module in self.modules for each in on_node(module, None))
        own = {node: _by_key(expected) for node, expected in self.expected_on.items()}
        for end in self.seen.endpoints:
            known = own.get(end.node) if end.node is not None else anybody
            for each in (known or {}).get((end.role, end.name), ()):
                yield Pair(end, each)

    def _links(self, giver: str, taker: str) -> Iterator[Link]:
        for (role, name), givers in self.by_name.items():
            if role == giver:
                for one in givers:
                    for two in self.by_name.get((taker, name), ()):
                        yield Link(one, two)


def _by_key(expected: Iterable[Expected]) -> dict[Key, list[Expected]]:
    found: defaultdict[Key, list[Expected]] = defaultdict(list)
    for each in expected:
        found[each.interface.role, each.name].append(each)
    return found
