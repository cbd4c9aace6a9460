"""Words that a CMake file hands to commands of other packages, which may make programs of these names."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.known import commands
from ecm_extract.cmake.targets import makes_target

_ROS = re.compile(
    r"(?:ament|catkin|rosidl|rosbuild|pluginlib|rclcpp|generate|add_(?:message|service|action|rostest|roslaunch|launch))_?\w*"
)
_NAME = re.compile(r"\w[\w.+-]*")


def foreign_words(calls: tuple[Call, ...]) -> Iterator[str]:
    """Yield plain words given to commands that neither CMake nor the build tools of ROS define."""
    own = commands()
    for call in calls:
        if call.name not in own and not _ROS.fullmatch(call.name) and not makes_target(call.name):
            yield from (word for word in call.args if _NAME.fullmatch(word))
