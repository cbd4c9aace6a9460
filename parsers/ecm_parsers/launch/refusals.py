"""Values of launch XML and YAML that the launch cannot work out, by the grammars of roslaunch and `launch.frontend`.

Sources: `roslaunch.substitution_args` and `roslaunch.xmlloader`; `launch/share/launch/frontend/grammar.lark`,
`launch.frontend.parse_substitution`, `launch.conditions`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec

from ecm_parsers.launch.entity import Entity
from ecm_parsers.launch.refused_ros1 import problem_of_ros1
from ecm_parsers.launch.refused_ros2 import problem_of_ros2
from ecm_parsers.launch.ros1_xml import Ros1Reader
from ecm_parsers.launch.ros2_markup import Ros2Reader
from ecm_parsers.launch.substitution import MAX_TEXT

_TRUTHS: Final = frozenset({"true", "false", "1", "0"})
_FALSE: Final = {"if": frozenset({"false", "0"}), "unless": frozenset({"true", "1"})}
_CONDITIONS: Final = ("if", "unless")
_ROS_1: Final = 1
_KNOWN: Final = {1: Ros1Reader().tags, 2: Ros2Reader().tags}
_AS_WRITTEN: Final = frozenset({"description", "type", "sep", "value_sep", "value-sep"})
"""Attributes of ROS 2 that are taken as they are."""


class Refusal(msgspec.Struct, frozen=True):
    """A value that the launch refuses.

    Attributes:
        line: of the element. where: the attribute that holds it. wrong: what is wrong, for people.
        is_sure: whoever starts the file gets there, whatever the arguments are.
    """

    line: int
    where: str
    wrong: str
    is_sure: bool


def refusals(root: Entity, ros: int) -> Iterator[Refusal]:
    """Yield what is refused below the root of a launch file; nothing of one that was never wholly ported to ROS 2."""
    if ros != _ROS_1 and _has_nodes_of_ros_1(root):
        return
    for child in root.children:
        yield from _below(child, ros, is_sure=True)


def _below(entity: Entity, ros: int, *, is_sure: bool) -> Iterator[Refusal]:
    """An element whose condition is written as false is never read by roslaunch; that of ROS 2 is, as text."""
    if entity.tag not in _KNOWN[ros] or (ros == _ROS_1 and _is_off(entity)):
        return
    yield from _conditions(entity, ros, is_sure=is_sure)
    inside = is_sure and (ros != _ROS_1 or not any(name in entity.attributes for name in _CONDITIONS))
    for name, text in _texts(entity, ros):
        problem = _problem(text, ros)
        if problem is not None:
            yield Refusal(entity.line, name, problem, is_sure if name in _CONDITIONS else inside)
    for child in entity.children:
        yield from _below(child, ros, is_sure=inside)


def _has_nodes_of_ros_1(entity: Entity) -> bool:
    own = entity.tag == "node" and "type" in entity.attributes and "exec" not in entity.attributes
    return own or any(map(_has_nodes_of_ros_1, entity.children))


def _problem(text: str, ros: int) -> str | None:
    if "$(" not in text or len(text) > MAX_TEXT:
        return None
    return problem_of_ros1(text) if ros == _ROS_1 else problem_of_ros2(text)


def _texts(entity: Entity, ros: int) -> Iterator[tuple[str, str]]:
    if ros == _ROS_1:
        yield from entity.attributes.items()
        if entity.tag == "rosparam" and (entity.get("subst_value") or "").lower() in {"true", "1"}:
            yield "text", entity.text
        return
    for name, text in entity.attributes.items():
        if name not in _AS_WRITTEN and not (entity.tag == "arg" and name == "name"):
            yield name, text


def _conditions(entity: Entity, ros: int, *, is_sure: bool) -> Iterator[Refusal]:
    given = [name for name in _CONDITIONS if name in entity.attributes]
    if len(given) > 1:
        yield Refusal(entity.line, "if", "`if` and `unless` stand on one element", is_sure)
    for name in given:
        text = entity.attributes[name]
        if text.strip() and "$(" not in text and text.strip().lower() not in _TRUTHS:
            yield Refusal(entity.line, name, f"the condition {text.strip()!r} is neither true nor false", is_sure)


def _is_off(entity: Entity) -> bool:
    return any(entity.attributes.get(name, "").strip().lower() in _FALSE[name] for name in _CONDITIONS)
