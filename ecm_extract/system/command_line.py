"""Parameters that a node is given on its command line.

Sources: design.ros2.org "ROS Command Line Arguments" (`--ros-args -p name:=value --params-file path --`);
wiki.ros.org/Nodes "Command-line Remapping Arguments" (`_name:=value`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from ecm_extract.system.model import Text
from ecm_extract.system.parameter_types import of_command_line, private

_VALUE = frozenset({"-p", "--param"})
_FILE = "--params-file"
_BETWEEN = ":="


class GivenValue(NamedTuple):
    """A parameter of a command line."""

    name: str
    value: Any


class GivenFile(NamedTuple):
    """A parameter file of a command line, by its marked path."""

    path: str


def ros2_given(words: Sequence[Text]) -> Iterator[GivenValue | GivenFile]:
    """Yield the parameters and files that stand after `--ros-args`, in order."""
    is_ros = False
    for word, following in pairwise((*words, Text(""))):
        is_ros = word.text == "--ros-args" or (is_ros and word.text != "--")
        if is_ros and word.text == _FILE:
            yield GivenFile(following.text)
        elif is_ros and word.text in _VALUE and _BETWEEN in following.text:
            name, _, value = following.text.partition(_BETWEEN)
            yield GivenValue(name.rpartition(":")[2], of_command_line(value) if following.known else value)


def ros1_given(words: Sequence[Text]) -> Iterator[GivenValue]:
    """Yield the private parameters; `__name` and the like are no parameters."""
    for word in words:
        name, between, value = word.text.partition(_BETWEEN)
        if between and name.startswith("_") and not name.startswith("__"):
            yield GivenValue(name[1:], private(value) if word.known else value)
