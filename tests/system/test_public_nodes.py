"""The table of public nodes means what it says."""

from __future__ import annotations

import re

import pytest

from ecm_extract.system.controllers import public_claims
from ecm_extract.system.graph import channels
from ecm_extract.system.model import Instance, Place, Setting, Text
from ecm_extract.system.public_nodes import default_name, public_endpoints, public_table
from ecm_extract.system.settings import all_given

ROLES = {"publisher", "subscriber", "service_server", "service_client", "action_server", "action_client"}


@pytest.mark.parametrize("table", [public_table().node, public_table().controller], ids=["node", "controller"])
def test_rows(table: dict[str, tuple[tuple[str, str, str, str], ...]]) -> None:
    """Each row has a role, a name, and a type of the kind that the role needs."""
    kinds = {"service": "srv", "action": "action"}
    for rows in table.values():
        for role, name, kind, when in rows:
            assert re.fullmatch(r"(\w+!?=\w+)?", when)
            assert role in ROLES
            assert name
            assert re.fullmatch(rf"\w+/{kinds.get(role.partition('_')[0], 'msg')}/\w+", kind)


def test_controllers_are_known_by_both_tables() -> None:
    """A controller with topics has claims, if only none."""
    assert {name.removesuffix("#1") for name in public_table().controller} <= public_claims().keys()


@pytest.mark.parametrize(("ros", "topics"), [(1, 3), (2, 4)])
def test_version(ros: int, topics: int) -> None:
    """robot_state_publisher publishes the description in ROS 2 only."""
    instance = Instance("node", "robot_state_publisher", "robot_state_publisher", "", None, "/", ros, Place("a", 1))
    assert len(public_endpoints(instance)) == topics
    assert channels([]) == []


def names(package: str, executable: str, parameters: dict[str, object], ros: int = 2) -> list[str]:
    settings = [Setting(name, value, Place("a", 1)) for name, value in parameters.items()]

    def parameter(name: str) -> object:
        return list(all_given(name, settings)) if "*" in name else parameters.get(name)

    instance = Instance("node", package, executable, "", None, "/", ros, Place("a", 1))
    return [row.name for row in public_endpoints(instance, parameter) if row.role in {"subscriber", "publisher"}]


@pytest.mark.parametrize(
    ("package", "executable", "parameters", "ros", "found"),
    [
        ("robot_localization", "ekf_node", {}, 2, ["set_pose", "odometry/filtered", "/tf"]),
        ("robot_localization", "ekf_node", {"publish_tf": False}, 2, ["set_pose", "odometry/filtered"]),
        (
            "robot_localization",
            "ekf_localization_node",
            {"odom0": "a/odom", "imu1": "b", "publish_tf": False},
            1,
            ["a/odom", "b", "set_pose", "odometry/filtered"],
        ),
        ("twist_mux", "twist_mux", {"topics.joy.topic": "j", "locks.stop.topic": "s"}, 2, ["j", "s", "cmd_vel_out"]),
        ("twist_mux", "twist_mux", {"topics": [{"name": "joy", "topic": "j"}]}, 1, ["j", "cmd_vel_out"]),
    ],
)
def test_rows_that_parameters_make(
    package: str, executable: str, parameters: dict[str, object], ros: int, found: list[str]
) -> None:
    """Inputs that a node takes from its parameters are there as often as they are set, and where a flag says so."""
    assert names(package, executable, parameters, ros) == found


def test_spawner_is_named_after_its_controller() -> None:
    """Several spawners of one launch have names of their own."""
    instance = Instance("node", "controller_manager", "spawner", "", None, "/", 2, Place("a", 1))
    instance.arguments = (Text("arm"), Text("grip"), Text("--inactive"))
    assert default_name(instance) == "spawner_arm"
