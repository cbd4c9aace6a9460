"""Conditions under which names are there and lines run, by what is tested."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.hub.condition import Condition, all_hold, text_of
from workspaces import Workspace

from ecm_extract.entities.build_conditions import build_conditions
from ecm_extract.entities.launch_conditions import conditions_of
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

REAL = Condition("argument", "real")
SIDE = Condition("argument", "side", "left")

XML = """<launch>
  <arg name="real" default="true"/>
  <group if="$(arg real)">
    <arg name="port"/>
    <node pkg="arm" type="driver" name="driver" unless="$(arg quiet)">
      <param name="rate" value="1"/>
      <remap if="$(env ROBOT)" from="a" to="b"/>
    </node>
  </group>
  <node pkg="arm" type="panel" name="panel" if="$(eval arg('a') == 1)"/>
  <node pkg="arm" type="never" name="never" if="false"/>
  <node pkg="arm" type="always" name="always" unless="0"/>
  <include file="$(find arm)/launch/other.launch" if="$(arg real)"/>
</launch>
"""
PYTHON = """from launch import LaunchDescription
from launch.conditions import IfCondition, LaunchConfigurationEquals, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="arm", executable="driver", condition=IfCondition(LaunchConfiguration("real"))),
        Node(package="arm", executable="simulator", condition=UnlessCondition(LaunchConfiguration("real"))),
        Node(package="arm", executable="left", condition=LaunchConfigurationEquals("side", "left")),
    ])
"""
XACRO = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="arm">
  <xacro:if value="$(arg real)"><link name="wrist"/></xacro:if>
  <xacro:unless value="${fixed}"><link name="hand"/></xacro:unless>
  <xacro:if value="$(arg real)"><link name="both"/></xacro:if>
  <xacro:unless value="$(arg real)"><link name="both"/></xacro:unless>
  <xacro:if value="false"><link name="never"/></xacro:if>
  <link name="always"/>
</robot>
"""
CMAKE = """cmake_minimum_required(VERSION 3.5)
project(pkg)
option(WITH_PANEL "The panel" OFF)
add_executable(driver src/driver.cpp)
install(TARGETS driver DESTINATION lib/${PROJECT_NAME})
if(WITH_PANEL)
  add_executable(panel src/panel.cpp)
  install(TARGETS panel DESTINATION lib/${PROJECT_NAME})
else()
  install(PROGRAMS scripts/text.py DESTINATION lib/${PROJECT_NAME})
endif()
"""


def row(workspace: Workspace, files: dict[str, str], ros: int) -> Any:
    extraction = extract(open_tree(workspace.package(files, ros).root), Options(jobs=1, cache=False, hub=True))
    return package_of(extraction.packages[0])


def required(workspace: Workspace, files: dict[str, str], ros: int) -> dict[tuple[str, str], tuple[Condition, ...]]:
    return {(each.use, each.name): each.when for each in row(workspace, files, ros).requires}


def provided(workspace: Workspace, files: dict[str, str], ros: int) -> dict[tuple[str, str], tuple[Condition, ...]]:
    return {(each.kind, each.name): each.when for each in row(workspace, files, ros).provides}


def test_launch_file_of_ros1(workspace: Workspace) -> None:
    """Conditions of groups hold for all in them; what never happens is no requirement."""
    found = required(workspace, {"launch/a.launch": XML}, 1)
    driver = (REAL, Condition("argument", "quiet", negated=True))
    assert found["starts", "driver"] == driver
    assert found["gives_parameter", "rate"] == driver
    assert found["remaps", "a"] == (*driver, Condition("environment", "ROBOT"))
    assert found["starts", "panel"] == (Condition("expression", "$(eval arg('a') == 1)"),)
    assert found["starts", "always"] == ()
    assert ("starts", "never") not in found
    assert found["includes_launch", "other.launch"] == (REAL,)


def test_provisions_of_a_launch_file(workspace: Workspace) -> None:
    found = provided(workspace, {"launch/a.launch": XML}, 1)
    assert found["launch_argument", "port"] == (REAL,)
    assert found["launch_argument", "real"] == ()
    assert found["node", "driver"] == (REAL, Condition("argument", "quiet", negated=True))
    assert ("node", "never") not in found


def test_launch_file_in_python(workspace: Workspace) -> None:
    found = required(workspace, {"launch/a.launch.py": PYTHON}, 2)
    assert found["starts", "driver"] == (REAL,)
    assert found["starts", "simulator"] == (REAL.opposite,)
    assert found["starts", "left"] == (SIDE,)


def test_description(workspace: Workspace) -> None:
    """A name that is there either way has no condition."""
    found = provided(workspace, {"urdf/a.xacro": XACRO}, 2)
    assert found["frame", "wrist"] == (REAL,)
    assert found["frame", "hand"] == (Condition("expression", "${fixed}", negated=True),)
    assert found["frame", "both"] == ()
    assert found["frame", "always"] == ()
    assert ("frame", "never") not in found


def test_build_file(workspace: Workspace) -> None:
    sources = {"src/driver.cpp": "int main() {}", "src/panel.cpp": "int main() {}", "scripts/text.py": ""}
    found = provided(workspace, {"CMakeLists.txt": CMAKE, **sources}, 2)
    assert found["executable", "driver"] == ()
    assert found["executable", "panel"] == (Condition("option", "WITH_PANEL"),)
    assert found["executable", "text.py"] == (Condition("option", "WITH_PANEL", negated=True),)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("A AND NOT (B)", (Condition("option", "A"), Condition("option", "B", negated=True))),
        ("NOT A", (Condition("option", "A", negated=True),)),
        ("A OR B", (Condition("expression", "A OR B"),)),
        ("NOT (A AND B)", (Condition("expression", "NOT (A AND B)"),)),
        ('X STREQUAL "a"', (Condition("expression", 'X STREQUAL "a"'),)),
    ],
)
def test_conditions_of_builds(text: str, expected: tuple[Condition, ...]) -> None:
    assert build_conditions([text]) == expected


@pytest.mark.parametrize(("template", "expected"), [(("true",), ()), (("0",), None), (None, ())])
def test_what_is_decided_is_no_condition(template: Any, expected: Any) -> None:
    assert conditions_of(template) == expected


@pytest.mark.parametrize(
    ("conditions", "given", "holds"),
    [
        ((REAL,), {"real": "True"}, True),
        ((REAL,), {"real": "off"}, False),
        ((REAL.opposite,), {"real": "0"}, True),
        ((REAL,), {"real": "maybe"}, None),
        ((REAL,), {}, None),
        ((SIDE,), {"side": "left"}, True),
        ((SIDE, REAL), {"side": "right"}, False),
        ((SIDE, REAL), {"side": "left"}, None),
        ((Condition("option", "real"),), {"real": "true"}, None),
    ],
)
def test_given_arguments_decide(conditions: tuple[Condition, ...], given: dict[str, str], holds: bool | None) -> None:
    assert all_hold(conditions, given) is holds


def test_conditions_in_words() -> None:
    assert text_of((REAL, SIDE.opposite)) == "real and side != left"
