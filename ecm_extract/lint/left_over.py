"""Files of ROS 1 in packages that are built for ROS 2 alone: nothing there can load them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.lint.workspace import Workspace

_CLIENT: Final = "rospy"
"""The Python library of ROS 1, which no distribution of ROS 2 has."""
_BUILT_FOR: Final = 2


def left_over(workspace: Workspace) -> frozenset[str]:
    """Return the paths of launch files of ROS 1, and of Python that needs its library, in packages of ROS 2."""
    return frozenset(path for path in _of_ros1(workspace) if workspace.files.ros_of(path) == _BUILT_FOR)


def eased(finding: Finding, old: frozenset[str]) -> Finding:
    """Return what is said of a file of ROS 1 as an info: it breaks nothing that it had not broken by being there."""
    path = finding.evidence[0].path if finding.evidence else ""
    return msgspec.structs.replace(finding, severity="info") if path in old else finding


def _of_ros1(workspace: Workspace) -> Iterator[str]:
    yield from (path for path, launch in workspace.launches.items() if launch.ros == 1)
    for file in workspace.linker.program.files:
        if file.language == "python" and any(name.split(".")[0] == _CLIENT for name in file.imported.values()):
            yield file.path
