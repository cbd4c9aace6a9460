"""Controllers that parameter files declare, in the layouts of ROS 1 and ROS 2."""

from __future__ import annotations

import time

import pytest
from ecm_parsers.controllers_yaml import Declared, parse_controllers
from ecm_parsers.parameter_yaml import ParameterSet
from hypothesis import given, settings
from hypothesis import strategies as st

ROS2 = b"""
/arm/controller_manager:
  ros__parameters:
    update_rate: 250
    traj:
      type: joint_trajectory_controller/JointTrajectoryController
      params_file: more.yaml
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
    hardware_components_initial_state: {unconfigured: [a]}
/arm/traj:
  ros__parameters:
    joints: [a, b]
    command_interfaces:
      - position
    gains: {a: {p: 1.0}}
/arm/camera:
  ros__parameters: {joints: 3, type: camera_drivers/Usb}
"""
ROS1 = b"""
/robot:
  arm:
    type: "effort_controllers/JointTrajectoryController"
    joints: [a, b]
    filter: {type: my_controller_filters/Mean}
  gripper: {type: my_grippers/Gripper, joint: c}
  both_arms: {type: my_hw/CombinableHW}
speaker: {type: audio/Speaker}
topics: {type: controller_manager_msgs/ListControllers}
"""


def test_ros2() -> None:
    """A manager knows rate and types; a controller has its parameters with their lines; other nodes are left out."""
    parsed = parse_controllers(ROS2)
    assert parsed.diagnostics == ()
    file = parsed.facts
    (manager,) = file.managers
    assert (file.ros, manager.node, manager.namespace) == (2, "/arm/controller_manager", "/arm")
    assert (manager.update_rate, manager.update_rate_line) == (250.0, 4)
    file_of = ParameterSet("/arm/controller_manager", "params_file", "more.yaml", "string", 7)
    assert manager.controllers == {
        "traj": Declared("joint_trajectory_controller/JointTrajectoryController", 6, (file_of,)),
        "states": Declared("joint_state_broadcaster/JointStateBroadcaster", 8),
    }
    (controller,) = file.controllers
    assert (controller.name, controller.node, controller.namespace, controller.line) == (
        "traj",
        "/arm/traj",
        "/arm",
        12,
    )
    assert controller.type == "joint_trajectory_controller/JointTrajectoryController"
    assert [(entry.name, entry.line) for entry in controller.parameters] == [
        ("joints", 12),
        ("command_interfaces", 13),
        ("gains.a.p", 15),
    ]
    assert controller.texts("joints") == ("a", "b")
    assert (controller.texts("gains.a.p"), controller.texts("state_interfaces")) == ((), ())


def test_ros1() -> None:
    """In ROS 1 a controller is a map with its class; what stands beside one in a namespace is one, too."""
    parsed = parse_controllers(ROS1)
    assert parsed.diagnostics == ()
    file = parsed.facts
    assert file.ros == 1
    assert [(found.name, found.node, found.type) for found in file.controllers] == [
        ("arm", "/robot/arm", "effort_controllers/JointTrajectoryController"),
        ("gripper", "/robot/gripper", "my_grippers/Gripper"),
    ]
    arm, gripper = file.controllers
    assert [entry.name for entry in arm.parameters] == ["type", "joints", "filter/type"]
    assert (arm.texts("joints"), gripper.texts("joint")) == (("a", "b"), ("c",))
    (manager,) = file.managers
    assert (manager.node, manager.namespace, manager.update_rate) == ("/robot/controller_manager", "/robot", None)
    assert {name: declared.line for name, declared in manager.controllers.items()} == {"arm": 4, "gripper": 7}


TYPED = "{ros__parameters: {type: my_controllers/Arm}}"
NAMED = "{ros__parameters: {x: 1}}"
MANAGER = "{ros__parameters: {arm: {type: my_controllers/Arm}}}"
OTHER = "{ros__parameters: {arm: {type: my_controllers/Other}}}"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (f"arm: {TYPED}", [("/arm", "my_controllers/Arm")]),
        (f"/**/arm: {TYPED}\n/a/arm: {NAMED}", [("/**/arm", "my_controllers/Arm"), ("/a/arm", "my_controllers/Arm")]),
        (f"/**: {TYPED}\nother: {NAMED}", [("/**", "my_controllers/Arm")]),
        (f"/a/controller_manager: {MANAGER}\narm: {NAMED}", [("/arm", "my_controllers/Arm")]),
        (
            f"/a/controller_manager: {MANAGER}\n/b/controller_manager: {OTHER}\n/b/arm: {NAMED}\n/c/arm: {NAMED}",
            [("/b/arm", "my_controllers/Other"), ("/c/arm", "")],
        ),
        ("arm: {ros__parameters: {command_interfaces: [a/position]}}", [("/arm", "")]),
        ("arm: {ros__parameters: {front_left_wheel_command_joint_name: a}}", [("/arm", "")]),
        ("arm: {ros__parameters: {fallback_controllers: [safe]}}", [("/arm", "")]),
        ("base: {ros__parameters: {interface_name_of_bus: can0}}", []),
        ("server: {ros__parameters: {FollowPath: {type: my_controllers/Path}}}", []),
        ("own: {ros__parameters: {update_rate: 5, arm: {type: my_controllers/Arm}}}\narm: {ros__parameters: {}}", []),
    ],
)
def test_which_sections_are_controllers(text: str, found: list[tuple[str, str]]) -> None:
    """A section counts when its type, a manager, another section or a parameter that only controllers have tells."""
    parsed = parse_controllers(text.encode())
    assert parsed.diagnostics == ()
    assert [(each.node, each.type) for each in parsed.facts.controllers] == found


@pytest.mark.parametrize(
    ("rate", "value", "codes"),
    [
        ("100", 100.0, []),
        ("100.0", 100.0, ["controllers-bad-rate"]),
        ("fast", None, ["controllers-bad-rate"]),
        ("0", None, ["controllers-bad-rate"]),
        ("9" * 400, None, ["controllers-bad-rate"]),
        (".nan", None, ["controllers-bad-rate"]),
        ("$(var rate)", None, []),
    ],
)
def test_rate(rate: str, value: float | None, codes: list[str]) -> None:
    """ROS 2 takes an integer only; what the launch fills in is not judged."""
    parsed = parse_controllers(f"controller_manager:\n ros__parameters:\n  update_rate: {rate}".encode())
    assert [(found.code, found.line) for found in parsed.diagnostics] == [(code, 3) for code in codes]
    assert parsed.facts.managers[0].update_rate == value


def test_bad_type() -> None:
    """A type that no class loader finds is told."""
    text = b"controller_manager:\n ros__parameters:\n  update_rate: 5\n  arm: {type: JointController}"
    parsed = parse_controllers(text)
    assert [(found.code, found.line) for found in parsed.diagnostics] == [("controllers-bad-type", 4)]
    assert parsed.facts.managers[0].controllers == {}


MANY = b"".join(
    b"/n%d/controller_manager: {ros__parameters: {a: {type: c/Controller}}}\n/n%d/a: {ros__parameters: {x: 1}}\n"
    % (n, n)
    for n in range(2000)
)


def test_many_managers() -> None:
    """Time grows with the file, not with managers times controllers."""
    started = time.process_time()
    file = parse_controllers(MANY).facts
    assert time.process_time() - started < 2
    assert (len(file.managers), len(file.controllers)) == (2000, 2000)


WORDS = [
    "a",
    "/",
    "controller_manager",
    "ros__parameters",
    "type",
    ": ",
    "{",
    "}",
    "[",
    "]",
    ",",
    "\n  ",
    "*",
    "c/Controller",
]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=40) | st.binary(max_size=80))
def test_never_raises(parts: list[str] | bytes) -> None:
    """No bytes break the parser."""
    data = parts if isinstance(parts, bytes) else "".join(parts).encode()
    assert isinstance(parse_controllers(data).facts.controllers, tuple)
    assert isinstance(parse_controllers(b"a//type: c/Controller\n" + data).facts.controllers, tuple)
