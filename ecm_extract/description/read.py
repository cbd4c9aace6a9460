"""A robot description read as a whole: a URDF, SRDF or xacro file with everything it includes."""

from __future__ import annotations

from collections.abc import Mapping

from ecm_extract.description.element import Element
from ecm_extract.description.gazebo import plugins_of, sensors_of
from ecm_extract.description.model import Description, Problem
from ecm_extract.description.ros2_control import hardware_of
from ecm_extract.description.srdf import semantics_of
from ecm_extract.description.transmission import transmissions_of
from ecm_extract.description.urdf import joints_of, links_of
from ecm_extract.description.xacro import Xacro
from ecm_extract.description.xacro_files import Files


def read_description(path: str, arguments: Mapping[str, str], files: Files) -> Description:
    """Expand and read one description.

    Args:
        path: of the file in the tree.
        arguments: xacro arguments by name.
        files: of the tree.

    Returns:
        What it declares; empty, with problems, when it cannot be expanded.
    """
    xacro = Xacro(files, arguments)
    root = xacro.expand(path)
    problems = tuple(xacro.problems)
    if root is None:
        return Description("", path, files=tuple(xacro.files_read), problems=problems)
    return _described(root, path, tuple(xacro.files_read), problems)


def _described(root: Element, path: str, files: tuple[str, ...], problems: tuple[Problem, ...]) -> Description:
    return Description(
        name=root.get("name"),
        path=path,
        links=tuple(links_of(root)),
        joints=tuple(joints_of(root)),
        hardware=tuple(hardware_of(root)),
        transmissions=tuple(transmissions_of(root)),
        plugins=tuple(plugins_of(root)),
        sensors=tuple(sensors_of(root)),
        files=files,
        problems=problems,
        semantics=semantics_of(root),
    )
