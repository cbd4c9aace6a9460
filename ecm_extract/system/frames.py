"""The tree of frames of a system: joints of its robots, static transforms of its launch, broadcasts of its nodes.

Sources: wiki.ros.org/tf2_ros `static_transform_publisher` (ROS 1 order), tf2_ros 0.20 named arguments (ROS 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from ecm_extract.description.model import Description
from ecm_extract.system.model import Instance, Place
from ecm_extract.system.node_model import SystemNode


class FrameEdge(NamedTuple):
    """A transform from a frame to its child: who publishes it, whether it is fixed, where that is written."""

    parent: str
    child: str
    fixed: bool
    source: str
    place: Place


def frames_of(nodes: Sequence[SystemNode], robots: Iterable[Description]) -> list[FrameEdge]:
    """Return the transforms that a system publishes, by parent and child."""
    found = [*_of_robots(robots), *_static(nodes), *_broadcast(nodes)]
    return sorted(set(found), key=lambda edge: (edge.parent, edge.child, edge.source))


def _of_robots(robots: Iterable[Description]) -> Iterator[FrameEdge]:
    for robot in robots:
        for joint in robot.joints:
            if joint.parent and joint.child:
                yield FrameEdge(
                    joint.parent, joint.child, joint.kind == "fixed", f"robot {robot.name}", Place(*joint.where)
                )


def _static(nodes: Sequence[SystemNode]) -> Iterator[FrameEdge]:
    for node in nodes:
        if node.instance.executable == "static_transform_publisher":
            pair = static_frames(node.instance)
            if pair is not None:
                yield FrameEdge(*pair, True, node.name, node.instance.place)


def static_frames(instance: Instance) -> tuple[str, str] | None:
    """Return parent and child of a static_transform_publisher by its command line, None when it cannot be read."""
    words = [word.text for word in instance.arguments]
    named = {words[at].lstrip("-"): words[at + 1] for at in range(len(words) - 1) if words[at].startswith("--")}
    if "frame-id" in named and "child-frame-id" in named:
        return named["frame-id"].lstrip("/"), named["child-frame-id"].lstrip("/")
    for count in (6, 7):
        if len(words) in {count + 2, count + 3} and all(_is_number(word) for word in words[:count]):
            frames = [word.lstrip("/") for word in words[count : count + 2]]
            if not _is_number(frames[0]):
                return frames[0], frames[1]
    return None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return text.startswith("{")
    return True


def _broadcast(nodes: Sequence[SystemNode]) -> Iterator[FrameEdge]:
    for node in nodes:
        for module in node.modules:
            for endpoint in module.endpoints:
                if endpoint.row.tells_transforms and endpoint.frame and " <- " in endpoint.frame:
                    parent, child = endpoint.frame.split(" <- ", 1)
                    place = Place(endpoint.path, endpoint.line)
                    yield FrameEdge(parent.lstrip("/"), child.lstrip("/"), False, node.name, place)
