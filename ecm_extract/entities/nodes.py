"""Names of nodes: those that programs give themselves, and those that launch files give them.

Whoever keys a parameter file, a remap, a policy or a list of managed nodes by such a name depends on it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ecm_checker.hub.provision import HOLE, LAUNCHED, Provision
from ecm_parsers.launch.model import Action, Node
from ecm_parsers.launch.templates import plain_text

from ecm_extract.entities.endpoints import is_wholly_computed
from ecm_extract.entities.launch_conditions import taken
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts


def node_entities(facts: PackageFacts, modules: Sequence[LinkedModule]) -> Iterator[Provision]:
    """Yield the node of each class and program; its owner is what makes it, one whose name is computed is `<*>`.

    It is open where it declares parameters of whose names nothing is known.
    """
    for entry in modules:
        module = entry.module
        if module.cls is None and module.main is None:
            continue
        at = entry.named_at
        yield Provision(
            kind="node",
            package=facts.name,
            owner=module.cls.qualified if module.cls is not None else module.name,
            name=entry.node or HOLE,
            node=module.name,
            ros=facts.ros,
            path=at.path if at is not None else module.path,
            line=at.line if at is not None else module.line,
            open=any(is_wholly_computed(each) for each in entry.interfaces if each.row.value),
        )


def launched_nodes(facts: PackageFacts, path: str, owner: str, actions: Iterable[Action]) -> Iterator[Provision]:
    """Yield the names that a launch file gives to nodes, as far as they stand there; `bases` is what each runs."""
    for each in taken(actions):
        node = each.action
        name = plain_text(node.name) if isinstance(node, Node) else None
        if isinstance(node, Node) and name:
            parts = (node.package, node.executable, node.plugin)
            yield Provision(
                kind="node",
                facet=LAUNCHED,
                package=facts.name,
                owner=owner,
                name=name,
                bases=tuple(plain_text(part) or HOLE for part in parts if part),
                ros=facts.ros,
                path=path,
                line=node.line,
                when=each.when,
            )
