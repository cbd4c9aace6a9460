"""The table of public nodes means what it says."""

from __future__ import annotations

import re

import pytest

from ecm_extract.system.controllers import public_claims
from ecm_extract.system.graph import channels
from ecm_extract.system.model import Instance, Place
from ecm_extract.system.public_nodes import public_endpoints, public_table

ROLES = {"publisher", "subscriber", "service_server", "service_client", "action_server", "action_client"}


@pytest.mark.parametrize("table", [public_table().node, public_table().controller], ids=["node", "controller"])
def test_rows(table: dict[str, tuple[tuple[str, str, str], ...]]) -> None:
    """Each row has a role, a name, and a type of the kind that the role needs."""
    kinds = {"service": "srv", "action": "action"}
    for rows in table.values():
        for role, name, kind in rows:
            assert role in ROLES
            assert name
            assert re.fullmatch(rf"\w+/{kinds.get(role.partition('_')[0], 'msg')}/\w+", kind)


def test_controllers_are_known_by_both_tables() -> None:
    """A controller with topics has claims, if only none."""
    assert public_table().controller.keys() <= public_claims().keys()


@pytest.mark.parametrize(("ros", "topics"), [(1, 3), (2, 4)])
def test_version(ros: int, topics: int) -> None:
    """robot_state_publisher publishes the description in ROS 2 only."""
    instance = Instance("node", "robot_state_publisher", "robot_state_publisher", "", None, "/", ros, Place("a", 1))
    assert len(public_endpoints(instance)) == topics
    assert channels([]) == []
