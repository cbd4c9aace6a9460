"""Names in robot descriptions, as they are written."""

from __future__ import annotations

import pytest
from ecm_parsers.robot_names import Guard, NamedLine, RobotNames, is_whole_robot, parse_robot_names
from hypothesis import given
from hypothesis import strategies as st

ARM = b"""<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="arm">
  <xacro:include filename="$(find base)/urdf/base.xacro"/>
  <xacro:macro name="arm" params="prefix">
    <xacro:if value="1"><link name="${prefix}tool0"/></xacro:if>
    <joint name="${prefix}wrist"><parent link="${prefix}arm"/><child link="${prefix}tool0"/></joint>
    <ros2_control name="hw" type="system">
      <joint name="${prefix}wrist"><command_interface name="position"/><state_interface name="position"/></joint>
      <gpio><command_interface name="nameless"/></gpio>
    </ros2_control>
    <gazebo><model><link name="inside_the_simulator"/></model></gazebo>
  </xacro:macro>
</robot>
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (b"<robot name='a'><link name='b'/></robot>", True),
        (b"<robot name='a'><!-- <xacro:macro name='b'/> --></robot>", True),
        (b"<!-- <robot/> --><sdf/>", False),
        (b"<!DOCTYPE a [<!ENTITY b 'c'>]><robot/>", True),
        (b"", False),
        (ARM, False),
    ],
)
def test_whole_robots(text: bytes, expected: bool) -> None:
    """A comment defines no macro, and what is refused may be a robot."""
    assert is_whole_robot(text) is expected


def test_names_are_taken_as_they_stand() -> None:
    """Nothing is expanded or included; links of a simulator's models are no frames."""
    assert parse_robot_names(ARM).facts == RobotNames(
        links=(NamedLine("${prefix}tool0", 4, (Guard("1"),)),),
        commands=(NamedLine("${prefix}wrist/position", 7),),
        parents=(NamedLine("${prefix}arm", 5), NamedLine("${prefix}tool0", 5)),
        includes=(NamedLine("$(find base)/urdf/base.xacro", 2),),
    )


def test_other_xml_has_no_names() -> None:
    """A file that is called .xacro may hold a world, or nothing."""
    assert parse_robot_names(b"<sdf><link name='a'/></sdf>").facts == RobotNames()
    assert parse_robot_names(b"").facts == RobotNames()


@given(st.binary() | st.text().map(lambda text: f"<robot><link name='a'>{text}".encode()))
def test_any_bytes_are_read(data: bytes) -> None:
    """Whatever a file holds, names or nothing come back."""
    assert all(entry.line >= 0 for entry in parse_robot_names(data).facts.links)
