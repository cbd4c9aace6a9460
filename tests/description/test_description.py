from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from memory_files import MemoryFiles, robot

from ecm_extract.description.model import Description
from ecm_extract.description.read import read_description

BODY = """
<link name="base_link"/>
<link name="arm"/>
<joint name="elbow" type="revolute">
  <parent link="base_link"/><child link="arm"/>
  <limit lower="-1.5" upper="${pi / 2}" effort="inf" velocity="x"/><mimic joint="shoulder"/>
</joint>
<ros2_control name="arm_hardware" type="system">
  <hardware><plugin>arm_driver/ArmSystem</plugin><param name="port"> /dev/arm </param></hardware>
  <joint name="elbow">
    <command_interface name="position"><param name="min">-1</param><param name="max">1</param></command_interface>
    <command_interface name="velocity"/>
    <state_interface name="position"/><param name="gear">3</param>
  </joint>
  <sensor name="wrist"><state_interface name="force.x"/><param name="frame_id">arm</param></sensor>
  <gpio name="lamp"><command_interface name="on"/></gpio>
  <transmission name="inner"><plugin>transmission_interface/SimpleTransmission</plugin>
    <actuator name="motor"/><joint name="elbow"/></transmission>
</ros2_control>
<transmission name="outer"><type>transmission_interface/SimpleTransmission</type>
  <joint name="elbow"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
  <actuator name="motor_1"/></transmission>
<transmission name="early"><type>t</type><joint name="elbow"/>
  <actuator name="motor_2"><hardwareInterface>PositionJointInterface</hardwareInterface></actuator></transmission>
<gazebo reference="arm"><sensor name="eye" type="camera"><update_rate>30</update_rate><topic>eye</topic>
  <plugin name="eye_driver" filename="libgazebo_ros_camera.so"><ros><namespace>/cell</namespace>
    <remapping> a := b </remapping></ros><camera_name>front</camera_name></plugin></sensor></gazebo>
"""


def described(body: str, **arguments: str) -> Description:
    return read_description("a.urdf.xacro", arguments, MemoryFiles({"a.urdf.xacro": robot(body)}))


ROBOT = described(BODY)


def test_links_and_joints_are_read_with_their_lines() -> None:
    """A joint tells its frames, its finite limits, what it mimics and where it is written."""
    (joint,) = ROBOT.joints
    assert [(link.name, link.where.line) for link in ROBOT.links] == [("base_link", 2), ("arm", 3)]
    assert (joint.name, joint.kind, joint.parent, joint.child) == ("elbow", "revolute", "base_link", "arm")
    assert joint.limits == {"lower": -1.5, "upper": pytest.approx(1.5708, abs=1e-4)}
    assert (joint.mimics, joint.where) == ("shoulder", ("a.urdf.xacro", 4))


def test_hardware_offers_the_interfaces_of_its_parts() -> None:
    """Exclusive resources are the command interfaces of joints and GPIOs; a sensor has none."""
    (hardware,) = ROBOT.hardware
    assert (hardware.name, hardware.kind, hardware.plugin) == ("arm_hardware", "system", "arm_driver/ArmSystem")
    assert hardware.parameters == {"port": "/dev/arm"}
    assert [(part.kind, part.name, part.command, part.state) for part in hardware.parts] == [
        ("joint", "elbow", ("position", "velocity"), ("position",)),
        ("sensor", "wrist", (), ("force.x",)),
        ("gpio", "lamp", ("on",), ()),
    ]
    assert [name for part in hardware.parts for name in part.interfaces()] == [
        "elbow/position",
        "elbow/velocity",
        "lamp/on",
    ]


def test_limits_of_command_interfaces_are_read() -> None:
    """A command interface tells the range of its commands, a part its parameters."""
    joint, sensor, _ = ROBOT.hardware[0].parts
    assert joint.limits == {"position": (-1.0, 1.0)}
    assert (joint.parameters, sensor.parameters) == ({"gear": "3"}, {"frame_id": "arm"})


def test_transmissions_name_joints_and_interfaces() -> None:
    """The interface of ROS 1 stands in the joint, in early files in the actuator, in ROS 2 nowhere."""
    assert [(entry.name, entry.joints, entry.actuators) for entry in ROBOT.transmissions] == [
        ("inner", (("elbow", ()),), ("motor",)),
        ("outer", (("elbow", ("EffortJointInterface",)),), ("motor_1",)),
        ("early", (("elbow", ("PositionJointInterface",)),), ("motor_2",)),
    ]


def test_plugins_know_what_they_stand_in() -> None:
    """A plugin tells its link, its sensor, its parameters and how it is renamed; drivers of hardware are none."""
    (plugin,) = ROBOT.plugins
    (sensor,) = ROBOT.sensors
    assert (plugin.library, plugin.name, plugin.reference) == ("libgazebo_ros_camera.so", "eye_driver", "arm")
    assert (plugin.sensor, plugin.sensor_kind, plugin.native) == ("eye", "camera", True)
    assert (plugin.parameters, plugin.remaps, plugin.namespace) == ({"camera_name": "front"}, (("a", "b"),), "/cell")
    assert (sensor.name, sensor.kind, sensor.link, sensor.rate, sensor.topic) == ("eye", "camera", "arm", 30.0, "eye")


def test_both_branches_of_an_unknown_condition_are_joined() -> None:
    """What a part offers in any case that the launch may choose is what it may offer."""
    body = """<xacro:arg name="mode"/><ros2_control name="h" type="system"><joint name="j">
      <xacro:if value="${xacro.arg('mode') == 'v'}"><command_interface name="velocity"/></xacro:if>
      <xacro:unless value="${xacro.arg('mode') == 'v'}"><command_interface name="position"/></xacro:unless>
    </joint></ros2_control>"""
    both, one = described(body), described(body, mode="v")
    assert both.hardware[0].parts[0].command == ("velocity", "position")
    assert one.hardware[0].parts[0].command == ("velocity",)
    assert (bool(both.problems), one.problems) == (True, ())


def test_an_srdf_tells_groups_and_what_ties_them() -> None:
    """Groups, end effectors, virtual joints and switched-off collisions are read."""
    found = described(
        """<group name="arm"><joint name="elbow"/><chain base_link="base" tip_link="tool"/></group>
        <group name="all"><group name="arm"/><link name="hand"/></group>
        <group_state name="home" group="arm"><joint name="elbow" value="0"/></group_state>
        <end_effector name="hand" parent_link="tool" group="hand"/>
        <virtual_joint name="fixed" type="fixed" parent_frame="world" child_link="base"/>
        <passive_joint name="spring"/>
        <disable_collisions link1="a" link2="b" reason="Never"/><disable_collisions link1="a" link2="c"/>"""
    ).semantics
    assert found is not None
    assert [(entry.name, entry.joints, entry.links, entry.chains, entry.groups) for entry in found.groups] == [
        ("arm", ("elbow",), (), (("base", "tool"),), ()),
        ("all", (), ("hand",), (), ("arm",)),
    ]
    assert [(entry.name, entry.group, entry.parent_link) for entry in found.end_effectors] == [("hand", "hand", "tool")]
    assert [(entry.parent_frame, entry.child_link) for entry in found.virtual_joints] == [("world", "base")]
    assert (found.passive_joints, found.states, found.disabled_pairs) == (("spring",), (("arm", "home"),), 2)


def test_a_description_without_groups_is_no_srdf() -> None:
    """Nothing known about planning is not the same as nothing to plan."""
    assert ROBOT.semantics is None


def test_a_file_that_is_not_there_is_empty() -> None:
    """A description that cannot be read has no facts."""
    assert read_description("none", {}, MemoryFiles({})).joints == ()


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=200), st.integers(0, len(BODY)))
def test_no_content_makes_the_readers_fail(noise: bytes, at: int) -> None:
    """Whatever stands in a description, there is a result."""
    data = robot(BODY).encode()
    found = read_description("a", {}, MemoryFiles({"a": data[:at] + noise + data[at:]}))
    assert found.files == ("a",) or found.problems
