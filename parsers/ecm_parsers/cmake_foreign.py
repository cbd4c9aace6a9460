"""Words that a CMake file hands to commands of other packages, which may make programs of these names."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from functools import cache
from importlib import resources

from ecm_parsers.cmake_run import Call
from ecm_parsers.cmake_targets import makes_target

_ROS = re.compile(
    r"(?:ament|catkin|rosidl|rosbuild|pluginlib|rclcpp|generate|add_(?:message|service|action|rostest|roslaunch|launch))_?\w*"
)
_NAME = re.compile(r"\w[\w.+-]*")


@cache
def _commands() -> frozenset[str]:
    text = (resources.files("ecm_parsers") / "cmake_commands.toml").read_text("utf-8")
    return frozenset(tomllib.loads(text)["commands"])


def foreign_words(calls: tuple[Call, ...]) -> Iterator[str]:
    """Yield plain words given to commands that neither CMake nor the build tools of ROS define."""
    own = _commands()
    for call in calls:
        if call.name not in own and not _ROS.fullmatch(call.name) and not makes_target(call.name):
            yield from (word for word in call.args if _NAME.fullmatch(word))
