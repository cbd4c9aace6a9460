"""Names that launch files hand to nodes and that ROS does not take: targets of remappings, and namespaces.

Sources: `ros::names::validate` of roscpp; design.ros2.org "Topic and Service name mapping"; `rmw_validate_namespace`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_parsers.launch.model import Action, Group, Include, LaunchFile, Node, PushNamespace, Remap, Template
from ecm_parsers.launch.templates import all_actions

_ROS_1: Final = 1
_NOT_IN_NAME: Final = {1: re.compile(r"[^A-Za-z0-9_/~]"), 2: re.compile(r"[^A-Za-z0-9_/~{}]")}
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
    found = _NOT_IN_NAME[ros].search(text)
    if found is not None:
        return f"{text!r} is no name: it has {found[0]!r}"
    if text[:1].isdigit() or (ros == _ROS_1 and text.startswith("_")):
        return f"{text!r} is no name: it begins with {text[0]!r}"
    return None
