"""Behaviour trees that name a node which is gone, or set a port that it no longer has."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.behavior_tree import TreeNode

from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at


def tree_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the nodes of behaviour tree files that a change of a registered node or of its ports breaks."""
    if not index.of_kind("bt_node") and not index.of_kind("bt_port"):
        return
    for facts in workspace.packages:
        for path, file in facts.trees.items():
            for tree in file.trees:
                for node in tree.nodes:
                    yield from _of_node(node, Place(facts.name, path, node.line), index)


def _of_node(node: TreeNode, place: Place, index: ChangeIndex) -> Iterator[Use]:
    if node.is_subtree:
        return
    for located in index.named("bt_node", node.id):
        if located.change.change in GONE:
            yield use_at(located, place, f"names the node {node.id}")
    for port in node.ports:
        for located in index.named("bt_port", port):
            old = located.pair.old
            if old is not None and old.owner == node.id and located.change.change in GONE:
                yield use_at(located, place, f"sets the port {port} of {node.id}")
