"""Behaviour trees: the nodes that they name and the ports that they set."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required


def behavior_tree_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the behaviour trees of a package require; subtrees are their own."""
    for path, file in facts.trees.items():
        for tree in file.trees:
            for node in tree.nodes:
                if node.is_subtree:
                    continue
                place = Place(path, node.line, f"behavior_tree {tree.id}")
                yield required("names_bt_node", node.id, place)
                for port in node.ports:
                    yield required("sets_bt_port", port, place, owner=node.id)
