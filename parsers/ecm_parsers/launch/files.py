"""Launch markup of either ROS version -> a launch file; the dialect is told by what it uses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from ecm_parsers.launch.entity import Entity, of_xml, of_yaml
from ecm_parsers.launch.model import LaunchFile
from ecm_parsers.launch.refusals import Refusal, refusals
from ecm_parsers.launch.ros1_xml import Ros1Reader
from ecm_parsers.launch.ros2_markup import Ros2Reader
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.xml_tree import parse_xml
from ecm_parsers.yaml_scalar import typed_by_pyyaml
from ecm_parsers.yaml_tree import Mapping, parse_yaml

_ROS2_ONLY = frozenset(
    {
        "let",
        "executable",
        "node_container",
        "composable_node",
        "load_composable_node",
        "push_ros_namespace",
        "push_namespace",
        "set_parameter",
        "set_remap",
        "lifecycle_node",
        "set_env",
        "timer",
    }
)
_ROS1_ONLY = frozenset({"rosparam", "machine"})


def parse_launch_xml(data: bytes, ros: Literal[1, 2] | None = None) -> Parsed[LaunchFile | None]:
    """Read a launch file in XML.

    Args:
        data: its bytes.
        ros: version of the package, used where the file itself does not tell.

    Returns:
        The file, None when it has no `<launch>` root, and diagnostics.
    """
    tree = parse_xml(data)
    if tree.root is None:
        return Parsed(None, tree.diagnostics)
    root = of_xml(tree.root)
    if root.tag != "launch":
        message = f"The root is <{root.tag}>, not <launch>; the file is no launch file. Correct the root."
        return Parsed(None, (*tree.diagnostics, Diagnostic("error", "launch-wrong-root", root.line, message)))
    version = _dialect(root) or ros or 2
    return _read(root, version, tree.diagnostics)


def parse_launch_yaml(data: bytes) -> Parsed[LaunchFile | None]:
    """Read a launch file in YAML (ROS 2).

    Returns:
        The file, None when it has no `launch:` list, and diagnostics.
    """
    tree = parse_yaml(data, typed_by_pyyaml)
    document = next((entry for entry in tree.facts if isinstance(entry, Mapping)), None)
    body = document.get("launch") if document is not None else None
    if body is None:
        message = "There is no `launch:` list; the file is no launch file. Add it."
        return Parsed(None, (*tree.diagnostics, Diagnostic("error", "launch-wrong-root", 0, message)))
    return _read(of_yaml("launch", body, body.line), 2, tree.diagnostics)


def refused_xml_1(data: bytes) -> tuple[Refusal, ...]:
    """Return the values that roslaunch refuses in a launch file."""
    return _refused_xml(data, 1)


def refused_xml_2(data: bytes) -> tuple[Refusal, ...]:
    """Return the values that launch refuses in a launch file in XML of ROS 2."""
    return _refused_xml(data, 2)


def _refused_xml(data: bytes, ros: Literal[1, 2]) -> tuple[Refusal, ...]:
    tree = parse_xml(data)
    return tuple(refusals(of_xml(tree.root), ros)) if tree.root is not None and not tree.diagnostics else ()


def refused_yaml(data: bytes) -> tuple[Refusal, ...]:
    """Return the values that the launch refuses in a launch file in YAML."""
    document = next((entry for entry in parse_yaml(data, typed_by_pyyaml).facts if isinstance(entry, Mapping)), None)
    body = document.get("launch") if document is not None else None
    return tuple(refusals(of_yaml("launch", body, body.line), 2)) if body is not None else ()


def _read(root: Entity, version: Literal[1, 2], diagnostics: tuple[Diagnostic, ...]) -> Parsed[LaunchFile | None]:
    reader = Ros1Reader() if version == 1 else Ros2Reader()
    actions = reader.actions(root)
    return Parsed(LaunchFile(version, actions), (*diagnostics, *reader.problems))


def _dialect(root: Entity) -> Literal[1, 2] | None:
    """Return the version that elements, attributes or substitutions belong to alone."""
    for entity in _all(root):
        if entity.tag in _ROS2_ONLY or "exec" in entity.attributes:
            return 2
        if entity.tag in _ROS1_ONLY or (entity.tag == "node" and "type" in entity.attributes):
            return 1
        text = " ".join(entity.attributes.values())
        if "$(var " in text or "$(find-pkg" in text:
            return 2
        if "$(arg " in text or "$(find " in text:
            return 1
    return None


def _all(entity: Entity) -> Iterator[Entity]:
    pending = [entity]
    while pending:
        current = pending.pop()
        yield current
        pending.extend(reversed(current.children))
