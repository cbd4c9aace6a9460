"""What build files, descriptions and launch files name of files and libraries, as requirements."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction_model import Options
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import open_tree

CMAKE = "cmake_minimum_required(VERSION 3.0)\nproject(pkg)\n{}\n"
Row = tuple[str, str, str, str]


def required(workspace: Any, files: dict[str, str], *uses: str) -> set[Row]:
    workspace.package(files, ros=1)
    known = Workspace(open_tree(workspace.root), Options(jobs=1)).known
    rows = [asked.requirement for use in uses for asked in known.asked(use)]
    return {(each.use, each.name, each.target, each.certainty) for each in rows}


@pytest.mark.parametrize(
    ("body", "row"),
    [
        ("install(FILES a.yaml DESTINATION share/pkg)", ("installs_file", "a.yaml", "a.yaml", "likely")),
        ("install(DIRECTORY maps/ DESTINATION share/pkg)", ("installs_file", "maps", "maps/", "likely")),
        (
            "configure_file(a.in a.yaml)\ninstall(FILES a.yaml DESTINATION share/pkg)",
            ("installs_file", "a.yaml", "a.yaml", "unknown"),
        ),
        ("catkin_package(INCLUDE_DIRS include)", ("exports_headers", "include", "include", "likely")),
        ("catkin_package(LIBRARIES pkg)", ("exports_library", "pkg", "", "likely")),
        ("add_library(pkg a.cpp)\ncatkin_package(LIBRARIES pkg)", ("exports_library", "pkg", "pkg", "likely")),
    ],
)
def test_of_build_files(workspace: Any, body: str, row: Row) -> None:
    """What another command names is perhaps made by it; `target` is what is written, or the target that is built."""
    uses = ("installs_file", "exports_headers", "exports_library")
    assert required(workspace, {"CMakeLists.txt": CMAKE.format(body)}, *uses) == {row}


@pytest.mark.parametrize(
    "body",
    [
        "install(FILES a.yaml DESTINATION share/pkg OPTIONAL)",
        "install(FILES ${A} DESTINATION share/pkg)",
        "install(FILES /etc/a.yaml DESTINATION share/pkg)",
        "install(DIRECTORY . DESTINATION share/pkg)",
        "install(FILES ../other/a.yaml DESTINATION share/pkg)",
    ],
)
def test_what_is_not_asked_for(workspace: Any, body: str) -> None:
    """What may be missing, what only CMake knows, and what lies outside of the package."""
    assert required(workspace, {"CMakeLists.txt": CMAKE.format(body)}, "installs_file") == set()


def test_of_files_that_name_packages(workspace: Any) -> None:
    """A mesh by its address, a map by an argument; what the launch itself opens is asked elsewhere."""
    robot = '<robot name="a"><link name="l"><mesh filename="package://arm/meshes/a.dae"/></link></robot>'
    launch = (
        '<launch><arg name="m" default="$(find arm)/maps/a.yaml"/>'
        '<rosparam command="load" file="$(find arm)/config/b.yaml"/></launch>'
    )
    found = required(workspace, {"urdf/a.urdf": robot, "launch/a.launch": launch}, "shows_mesh", "names_file")
    assert found == {("shows_mesh", "meshes/a.dae", "", "proved"), ("names_file", "maps/a.yaml", "", "likely")}
