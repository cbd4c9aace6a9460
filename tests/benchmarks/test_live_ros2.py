"""The rows of the live bench of ROS 2: what rclpy told of a node beside what its contract promises on that node."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from ecm_checker.contract import Contract, Evidence, Identity, Interface, Qos, Signature, Source
from ecm_checker.hub.condition import Condition
from live_ros2.candidates import Candidate, Tree, candidates, of_node, python_path, tree_of
from live_ros2.rows import compared
from live_ros2.told import observation
from path_a.ros2 import require
from path_a.row import NotMeasured

FIXTURES = Path(__file__).parents[2] / "fixtures" / "path_a"
STRING = "std_msgs/msg/String"


def interface(role: str, name: str, raw: str, **more: Any) -> Interface:
    confidence = "pattern" if "{" in name else "literal"
    plain: dict[str, Any] = {"type": STRING, "qos": None, "frame": None, "confidence": confidence}
    return Interface(role=role, name=name, raw_name=raw, evidence=(Evidence("n.py", 1),), **{**plain, **more})  # type: ignore[arg-type]


def contract(*interfaces: Interface, name: str = "n", path: str = "n.py") -> Contract:
    identity = Identity(f"ecm.a.{name}", "a", "node", None, Source(None, None, path), 2)
    return Contract(identity, Signature(interfaces))


def document(**nodes: list[str]) -> dict[str, Any]:
    """A node `/n` with ends by role and parameters."""
    qos = {"reliability": "reliable", "durability": "volatile", "history": "keep_last", "depth": 5}
    qos |= {"liveliness": "automatic", "deadline_ms": None, "lifespan_ms": None, "lease_ms": None}
    ends = {role: [[name, STRING] for name in names] for role, names in nodes.items()}
    told = [
        {"role": role, "name": name, "node": "/n", "type": STRING, **qos}
        for role, names in nodes.items()
        for name in names
    ]
    return {"nodes": {"/n": ends}, "qos": told, "parameters": {"/n": {"rate": 10.0, "use_sim_time": False}}}


def test_rows() -> None:
    """Names on the node, open names that can be this one, what is missing on either side; rclpy's own is left out."""
    promised = contract(
        interface("publisher", "/odom", "odom", qos=Qos(reliability="reliable", history="keep_last", depth=10)),
        interface("publisher", "/{}/state", "/{}/state"),
        interface("subscriber", "/never", "never"),
        interface("parameter", "/n/rate", "rate", type="double", default=20.0),
        interface("parameter", "/n/gain", "gain", type="double", default=1.0),
    )
    told = observation(document(publisher=["/odom", "/r1/state", "/rosout"], subscriber=["/more"]))
    counts = compared([promised], "/n", told, told)
    assert counts["endpoint recall"].right == 2
    assert counts["endpoint recall"].wrong == [f"missed subscriber /more [{STRING}]"]
    assert counts["endpoint precision"].wrong == ["not there: subscriber /never"]
    assert counts["QoS recall"].wrong == ["publisher /odom: durability volatile is not told"]
    assert counts["QoS precision"].wrong == ["publisher /odom: depth 5, the contract says 10"]
    assert (counts["parameter recall"].right, counts["parameter recall"].wrong) == (1, [])
    assert counts["parameter precision"].wrong == ["not there: parameter gain"]
    assert counts["parameter value"].wrong == ["/n/rate is 10.0, the contract says 20.0"]
    assert counts["seen by observe"].whole == counts["seen by observe"].right == 3


def test_actions_are_one_endpoint() -> None:
    """As in the contract of a server; what DDS alone shows is the same."""
    hidden = {"service_server": [["/dock/_action/send_goal", "demo/action/Dock_SendGoal"]]}
    told = observation({"nodes": {"/n": hidden}, "qos": [], "parameters": {"/n": None}})
    assert [(end.role, end.name, end.type) for end in told.endpoints] == [
        ("action_server", "/dock", "demo/action/Dock")
    ]
    assert (told.parameters, [gap.what for gap in told.gaps]) == ((), ["/n"])
    rate = contract(interface("parameter", "/n/rate", "rate"))
    assert compared([rate], "/n", told, told)["parameter precision"].whole == 0


def test_what_observe_does_not_see_is_told() -> None:
    told, seen = observation(document(publisher=["/a", "/b"])), observation(document(publisher=["/a"]))
    count = compared([], "/n", told, seen)["seen by observe"]
    assert (count.right, count.wrong) == (1, [f"publisher /b [{STRING}]: not seen"])


def test_a_node_finds_its_contract() -> None:
    """By its name; a name that is computed leaves the script, when it makes one node only."""
    one, two = contract(name="one", path="one.py"), contract(name="two", path="two.py")
    tree = Tree(Path(), (one, two))
    script = Candidate("a/one.py", (), "a", "one.py")
    assert of_node(tree, script, "/ns/two") == (two,)
    assert of_node(tree, script, "/computed_7") == (one,)
    assert of_node(tree, Candidate("a/program", (), "a"), "/computed_7") == ()


def test_what_has_a_condition_may_be_absent() -> None:
    """A publisher that is made for a parameter is no false row of a run without it."""
    when = (Condition("parameter", "patch"),)
    promised = contract(interface("publisher", "/fixed", "fixed", when=when), interface("publisher", "/sure", "sure"))
    told = observation(document(publisher=[]))
    count = compared([promised], "/n", told, told)["endpoint precision"]
    assert count.wrong == ["not there: publisher /sure"]


def test_programs_whose_nodes_share_a_name_have_contracts_of_their_own() -> None:
    """The contract of the script that runs comes first, although another one has the bare name."""
    first, second = contract(name="talker", path="one.py"), contract(name="talker_two", path="two.py")
    tree = Tree(Path(), (first, second))
    assert of_node(tree, Candidate("a/two.py", (), "a", "two.py"), "/talker") == (second,)
    assert of_node(tree, Candidate("a/three.py", (), "a", "three.py"), "/talker") == (first,)


def test_scripts_of_a_tree() -> None:
    """Those that can be run by themselves, with the packages of the tree."""
    tree = tree_of(FIXTURES / "lifecycle_talker")
    assert [each.name for each in candidates(tree)] == ["lifecycle_talker/talker.py"]
    assert python_path(tree).split(os.pathsep)[0] == str(FIXTURES / "lifecycle_talker")


def test_without_a_ros_2_nothing_is_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    with pytest.raises(NotMeasured, match="no ROS 2 is sourced"):
        require(("rclpy",))
