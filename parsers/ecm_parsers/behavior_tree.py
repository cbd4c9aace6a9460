"""Behaviour trees in XML, of BehaviorTree.CPP 3 and 4.

Source: behaviortree.dev "The XML schema"; nav2_behavior_tree's pages for `RecoveryNode`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from importlib.resources import files
from typing import Final, Literal

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic, Parsed, shortened
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml

MAX_NODES = 100_000
MAX_DIAGNOSTICS = 100
PortDirection = Literal["input", "output", "inout"]
NodeKind = Literal["action", "condition", "control", "decorator", "subtree", ""]
_KINDS: Final[dict[str, NodeKind]] = {
    "Action": "action",
    "Condition": "condition",
    "Control": "control",
    "Decorator": "decorator",
    "SubTree": "subtree",
    "SubTreePlus": "subtree",
}
_DIRECTIONS: Final[dict[str, PortDirection]] = {"input_port": "input", "output_port": "output", "inout_port": "inout"}
_FORMATS: Final = {"3": 3, "4": 4}


class TreeNode(msgspec.Struct, frozen=True):
    """One node of a tree.

    Attributes:
        id: name under which its class is registered; of a subtree, the tree that it runs.
        name: of this instance; empty without one. is_subtree: whether it runs another tree.
        ports: value by port as written; `{key}` refers to the blackboard.
        line: 1-based.
        parent: index of the node around it in the same tree; None for the first one.
        element: tag as written, the same as `id` in the compact form.
        kind: by the tag, the table of built-in nodes or the models of the file; empty when none tells.
        built_in: whether the library brings it in the format of the file.
        reserved: attributes that are no ports: `_skipIf`, `_autoremap`, `__shared_blackboard` and the like.
    """

    id: str
    name: str
    is_subtree: bool
    ports: dict[str, str]
    line: int
    parent: int | None = None
    element: str = ""
    kind: NodeKind = ""
    built_in: bool = False
    reserved: dict[str, str] = {}


class BehaviorTree(msgspec.Struct, frozen=True):
    """One `<BehaviorTree>`: its ID and its nodes in the order of the file."""

    id: str
    nodes: tuple[TreeNode, ...]
    line: int


class ModelPort(msgspec.Struct, frozen=True):
    """A port that `<TreeNodesModel>` declares; `default` is None without one, `type` is empty without one."""

    name: str
    direction: PortDirection
    default: str | None
    line: int
    type: str = ""


class NodeModel(msgspec.Struct, frozen=True):
    """A node class that `<TreeNodesModel>` declares; `kind` is its tag."""

    id: str
    kind: str
    ports: tuple[ModelPort, ...]
    line: int


class BehaviorTreeFile(msgspec.Struct, frozen=True):
    """All trees of one file.

    Attributes:
        format: 3 or 4. main_tree: ID that is run, the only tree when the file names none; else empty.
        includes: (ROS package or empty, path, line).
    """

    format: int
    main_tree: str
    trees: tuple[BehaviorTree, ...] = ()
    models: tuple[NodeModel, ...] = ()
    includes: tuple[tuple[str, str, int], ...] = ()


def is_behavior_tree(data: bytes) -> bool:
    """Tell by the first bytes whether an XML file holds behaviour trees or models of their nodes."""
    head = data[:20_000]
    return any(mark in head for mark in (b"<BehaviorTree", b"BTCPP_format", b"<TreeNodesModel"))


def parse_behavior_tree(data: bytes) -> Parsed[BehaviorTreeFile]:
    """Read a behaviour tree file; its nodes stand in document order."""
    tree = parse_xml(data)
    root = tree.root
    if root is None or local_name(root) != "root":
        message = "A behaviour tree file has the root <root>. Correct it."
        wrong = () if root is None else (Diagnostic("error", "bt-wrong-root", line_of(root), message),)
        return Parsed(BehaviorTreeFile(3, ""), (*tree.diagnostics, *wrong))
    problems = list(tree.diagnostics)
    models = tuple(_models(root, problems))
    reader = _Reader(_format(root, problems), _tree_ids(root), {model.id: model.kind for model in models}, problems)
    trees = tuple(reader.tree(element) for tag, element in children(root) if tag == "BehaviorTree")
    _report_duplicates(trees, problems)
    named = _attribute(root, "main_tree_to_execute")
    file = BehaviorTreeFile(reader.format, named, trees, models, tuple(_includes(root)))
    file = msgspec.structs.replace(file, main_tree=_main_tree(file, line_of(root), problems))
    return Parsed(file, shortened(problems, MAX_DIAGNOSTICS))


def retries(file: BehaviorTreeFile) -> Iterator[tuple[TreeNode, int]]:
    """Yield the nodes that try again, with how often (-1: for ever).

    A number that comes from the blackboard counts as not known, and its node is left out.
    """
    ports = _table().retries
    for tree in file.trees:
        for node in tree.nodes:
            written = node.ports.get(ports.get(node.id, ""), "").strip()
            digits = written.removeprefix("-")
            if digits.isascii() and digits.isdecimal() and len(digits) < 10:
                yield node, int(written)


class _Reader:
    """Reads trees; knows the format, the IDs of the trees and the kinds that the file's models declare."""

    def __init__(self, written: int, trees: frozenset[str], models: Mapping[str, str], problems: list[Diagnostic]):
        self.format = written
        self._trees = trees
        self._models = models
        self._problems = problems
        self._left = MAX_NODES

    def tree(self, element: etree._Element) -> BehaviorTree:
        tree = BehaviorTree(_attribute(element, "ID"), tuple(self._nodes(element)), line_of(element))
        if sum(1 for _ in children(element)) != 1:
            message = f"Tree `{tree.id}` must have exactly one node at its top. Put a control node around the others."
            self._problems.append(Diagnostic("error", "bt-not-one-root", tree.line, message))
        return tree

    def _nodes(self, tree: etree._Element) -> Iterator[TreeNode]:
        places: dict[etree._Element, int] = {}
        for element in tree.iterdescendants(etree.Element):
            self._left -= 1
            if self._left < 0:
                self._stop(element)
                return
            parent = next((places[each] for each in element.iterancestors() if each in places), None)
            node = self._node(element, parent)
            if not node.id:
                message = f"<{node.element}> has no ID, so nothing says which node it is. Add ID."
                self._problems.append(Diagnostic("error", "bt-no-id", node.line, message))
                continue
            places[element] = len(places)
            yield node

    def _stop(self, element: etree._Element) -> None:
        """Report once that nodes are left out, before what would crowd it out."""
        if self._left == -1:
            message = f"The file has more than {MAX_NODES} nodes; the rest is not read. Split it."
            self._problems.insert(0, Diagnostic("error", "bt-too-many-nodes", line_of(element), message, cut=True))

    def _node(self, element: etree._Element, parent: int | None) -> TreeNode:
        tag = local_name(element)
        name = _attribute(element, "ID") if tag in _KINDS else tag
        row = _table().nodes.get(name, _Row())
        kind = _KINDS.get(tag) or row.kind or self._kind(name)
        attributes = {str(key): str(value) for key, value in element.attrib.items() if key not in ("ID", "name")}
        return TreeNode(
            id=name,
            name=_attribute(element, "name"),
            is_subtree=kind == "subtree",
            ports={key: value for key, value in attributes.items() if not key.startswith("_")},
            line=line_of(element),
            parent=parent,
            element=tag,
            kind=kind,
            built_in=self.format in row.formats,
            reserved={key: value for key, value in attributes.items() if key.startswith("_")},
        )

    def _kind(self, name: str) -> NodeKind:
        """Of a name that is written as tag: the library runs trees that are written so, too."""
        return "subtree" if name in self._trees else _KINDS.get(self._models.get(name, ""), "")


def _format(root: etree._Element, problems: list[Diagnostic]) -> int:
    written = _attribute(root, "BTCPP_format") or "3"
    if written not in _FORMATS:
        message = f"Format `{written[:40]}` is not known and read as 4. Write 3 or 4."
        problems.append(Diagnostic("warning", "bt-format", line_of(root), message))
    return _FORMATS.get(written, 4)


def _tree_ids(root: etree._Element) -> frozenset[str]:
    return frozenset(_attribute(element, "ID") for tag, element in children(root) if tag == "BehaviorTree") - {""}


def _report_duplicates(trees: Iterable[BehaviorTree], problems: list[Diagnostic]) -> None:
    lines: dict[str, int] = {}
    for tree in trees:
        if tree.id and tree.id in lines:
            message = f"Tree `{tree.id}` repeats line {lines[tree.id]}. Rename one of them."
            problems.append(Diagnostic("error", "bt-duplicate-tree", tree.line, message))
        lines.setdefault(tree.id, tree.line)


def _main_tree(file: BehaviorTreeFile, line: int, problems: list[Diagnostic]) -> str:
    """The tree that is run; where files are included, one of them may bring it."""
    ids = [tree.id for tree in file.trees]
    if file.main_tree or file.includes or len(ids) != 1:
        if file.main_tree and not file.includes and file.main_tree not in ids:
            message = f"No tree has the ID `{file.main_tree}` that main_tree_to_execute names. Correct one of the two."
            problems.append(Diagnostic("error", "bt-no-main-tree", line, message))
        return file.main_tree
    return ids[0]


def _includes(root: etree._Element) -> Iterator[tuple[str, str, int]]:
    for tag, element in children(root):
        if tag == "include":
            yield _attribute(element, "ros_pkg"), _attribute(element, "path"), line_of(element)


def _models(root: etree._Element, problems: list[Diagnostic]) -> Iterator[NodeModel]:
    for tag, holder in children(root):
        for kind, element in children(holder) if tag == "TreeNodesModel" else ():
            if kind not in _KINDS:
                continue  # editors keep notes of their own there, which no executor reads
            model = NodeModel(_attribute(element, "ID"), kind, tuple(_ports(element)), line_of(element))
            if model.id:
                yield model
            else:
                message = f"The model <{kind}> has no ID, so nothing says which node it declares. Add ID."
                problems.append(Diagnostic("error", "bt-no-id", model.line, message))


def _ports(element: etree._Element) -> Iterator[ModelPort]:
    for tag, port in children(element):
        if tag in _DIRECTIONS:
            default = port.get("default")
            yield ModelPort(
                name=_attribute(port, "name"),
                direction=_DIRECTIONS[tag],
                default=None if default is None else str(default),
                line=line_of(port),
                type=_attribute(port, "type"),
            )


def _attribute(element: etree._Element, name: str) -> str:
    return str(element.get(name, "")).strip()


class _Row(msgspec.Struct, frozen=True):
    """A node that the library brings, in some of its formats."""

    kind: NodeKind = ""
    formats: frozenset[int] = frozenset()


class _Table(msgspec.Struct, frozen=True):
    """The library's own nodes by ID, and the ports that say how often a node tries again."""

    nodes: Mapping[str, _Row]
    retries: Mapping[str, str]


@cache
def _table() -> _Table:
    text = (files("ecm_parsers") / "behavior_tree.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)
