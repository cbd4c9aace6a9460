"""Behaviour trees in XML, of BehaviorTree.CPP 3 and 4.

Source: behaviortree.dev "The XML schema"; nav2_behavior_tree's pages for `RecoveryNode`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml

_EXPLICIT: Final = frozenset({"Action", "Condition", "Control", "Decorator"})
_SUBTREES: Final = frozenset({"SubTree", "SubTreePlus"})
_OWN: Final = frozenset({"ID", "name", "_skipIf", "_failureIf", "_successIf", "_while", "_onSuccess", "_onFailure"})
_RETRIES: Final = {"RecoveryNode": "number_of_retries", "RetryUntilSuccessful": "num_attempts", "Retry": "num_attempts"}
PortDirection = Literal["input", "output", "inout"]


class TreeNode(msgspec.Struct, frozen=True):
    """One node of a tree.

    Attributes:
        id: name under which its class is registered; of a subtree, the tree that it runs.
        name: of this instance; empty without one. is_subtree: whether it runs another tree.
        ports: value by port as written; `{key}` refers to the blackboard.
        line: 1-based.
    """

    id: str
    name: str
    is_subtree: bool
    ports: dict[str, str]
    line: int


class BehaviorTree(msgspec.Struct, frozen=True):
    """One `<BehaviorTree>`: its ID and its nodes in the order of the file."""

    id: str
    nodes: tuple[TreeNode, ...]
    line: int


class ModelPort(msgspec.Struct, frozen=True):
    """A port that `<TreeNodesModel>` declares; `default` is None without one."""

    name: str
    direction: PortDirection
    default: str | None
    line: int


class NodeModel(msgspec.Struct, frozen=True):
    """A node class that `<TreeNodesModel>` declares."""

    id: str
    kind: str
    ports: tuple[ModelPort, ...]
    line: int


class BehaviorTreeFile(msgspec.Struct, frozen=True):
    """All trees of one file.

    Attributes:
        format: 3 or 4. main_tree: ID that is run; empty when the file names none.
        includes: (ROS package or empty, path, line).
    """

    format: int
    main_tree: str
    trees: tuple[BehaviorTree, ...] = ()
    models: tuple[NodeModel, ...] = ()
    includes: tuple[tuple[str, str, int], ...] = ()


def is_behavior_tree(data: bytes) -> bool:
    """Tell by the first bytes whether an XML file holds behaviour trees."""
    return b"<BehaviorTree" in data[:20_000] or b"BTCPP_format" in data[:2_000]


def parse_behavior_tree(data: bytes) -> Parsed[BehaviorTreeFile]:
    """Read a behaviour tree file; its nodes stand in document order."""
    tree = parse_xml(data)
    root = tree.root
    if root is None or local_name(root) != "root":
        message = "A behaviour tree file has the root <root>. Correct it."
        wrong = () if root is None else (Diagnostic("error", "bt-wrong-root", line_of(root), message),)
        return Parsed(BehaviorTreeFile(3, ""), (*tree.diagnostics, *wrong))
    problems = list(tree.diagnostics)
    written = str(root.get("BTCPP_format", "3"))
    return Parsed(
        BehaviorTreeFile(
            format=int(written) if written.isdecimal() and len(written) < 3 else 3,
            main_tree=str(root.get("main_tree_to_execute", "")),
            trees=tuple(_trees(root, problems)),
            models=tuple(_models(root)),
            includes=tuple(
                (str(entry.get("ros_pkg", "")), str(entry.get("path", "")), line_of(entry))
                for tag, entry in children(root)
                if tag == "include"
            ),
        ),
        tuple(problems),
    )


def retries(file: BehaviorTreeFile) -> Iterator[tuple[TreeNode, int]]:
    """Yield the nodes that try again, with how often; a number from the blackboard counts as not known."""
    for tree in file.trees:
        for node in tree.nodes:
            written = node.ports.get(_RETRIES.get(node.id, ""), "")
            if written.lstrip("-").isdecimal() and len(written) < 10:
                yield node, int(written)


def _trees(root: etree._Element, problems: list[Diagnostic]) -> Iterator[BehaviorTree]:
    for tag, element in children(root):
        if tag == "BehaviorTree":
            yield BehaviorTree(str(element.get("ID", "")), tuple(_nodes(element, problems)), line_of(element))


def _nodes(tree: etree._Element, problems: list[Diagnostic]) -> Iterator[TreeNode]:
    for element in tree.iterdescendants():
        if not isinstance(element.tag, str):
            continue
        tag = local_name(element)
        name = str(element.get("ID", "")) if tag in _EXPLICIT | _SUBTREES else tag
        if not name:
            message = f"<{tag}> has no ID, so nothing says which node it is. Add ID."
            problems.append(Diagnostic("error", "bt-no-id", line_of(element), message))
            continue
        ports = {str(key): str(value) for key, value in element.attrib.items() if key not in _OWN}
        yield TreeNode(name, str(element.get("name", "")), tag in _SUBTREES, ports, line_of(element))


def _models(root: etree._Element) -> Iterator[NodeModel]:
    for tag, holder in children(root):
        for kind, element in children(holder) if tag == "TreeNodesModel" else ():
            yield NodeModel(str(element.get("ID", "")), kind, tuple(_ports(element)), line_of(element))


def _ports(element: etree._Element) -> Iterator[ModelPort]:
    directions: dict[str, PortDirection] = {"input_port": "input", "output_port": "output", "inout_port": "inout"}
    for tag, port in children(element):
        if tag in directions:
            default = port.get("default")
            name = str(port.get("name", ""))
            yield ModelPort(name, directions[tag], None if default is None else str(default), line_of(port))
