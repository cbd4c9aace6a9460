"""Names that launch files hand to nodes and that ROS does not take: targets of remappings, and namespaces.

Sources: `ros::names::validate` of roscpp; design.ros2.org "Topic and Service name mapping"; `rmw_validate_namespace`.
"""

from __future__ import annotations

from collections.abc import Iterator
from string import ascii_letters, digits
from typing import Final

from ecm_parsers.launch.model import Action, Group, Include, LaunchFile, Node, PushNamespace, Remap
from ecm_parsers.launch.templates import all_actions
from ecm_parsers.template import Template

_ROS_1: Final = 1
_IN_NAME: Final = frozenset(f"{ascii_letters}{digits}_/~")
_IN_NAME_OF_ROS_2: Final = _IN_NAME | set("{}")
_HOLE: Final = "x"
"""What stands for a part that only the launch knows."""


def invalid_names(file: LaunchFile) -> Iterator[tuple[int, str]]:
    """Yield the line of each name that is none, and what is wrong."""
    of_parameters = {
        each
        for group in all_actions(file.actions)
        if isinstance(group, Group) and file.ros == _ROS_1 and not _starts(group)
        for each in group.actions
        if isinstance(each, PushNamespace)
    }
    for action in all_actions(file.actions):
        if isinstance(action, PushNamespace) and action in of_parameters:
            continue
        for what, name in _names(action):
            wrong = _wrong(name, file.ros)
            if wrong:
                yield action.line, f"{what} {wrong}"


def _starts(group: Group) -> bool:
    """Whether a group has nodes; the namespace of parameters alone is a text like any other."""
    return any(isinstance(each, Node | Include) for each in all_actions(group.actions))


def _names(action: Action) -> Iterator[tuple[str, Template]]:
    if isinstance(action, Remap):
        yield "the target of the remapping", action.target
    elif isinstance(action, PushNamespace | Include):
        yield "the namespace", action.namespace
    elif isinstance(action, Node):
        yield "the namespace", action.namespace or ()
        for each in action.remaps:
            yield "the target of the remapping", each.target


def _wrong(name: Template, ros: int) -> str | None:
    """A text that holds `$(` is one that stayed open; that is told as such."""
    text = "".join(part if isinstance(part, str) else _HOLE for part in name)
    if "$(" in text:
        return None
    allowed = _IN_NAME if ros == _ROS_1 else _IN_NAME_OF_ROS_2
    other = next((letter for letter in text if letter not in allowed), "")
    if other:
        return f"{text!r} is no name: it has {other!r}"
    if text[:1].isdigit() or (ros == _ROS_1 and text.startswith("_")):
        return f"{text!r} is no name: it begins with {text[0]!r}"
    return None
