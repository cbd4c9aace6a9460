"""The rows of the live bench: what a node registered beside what its contract promises on that node."""

from __future__ import annotations

import xmlrpc.client
from collections.abc import Iterator
from pathlib import Path
from threading import Thread
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from ecm_checker.contract import Contract, Evidence, Identity, Interface, Signature, Source
from live_ros1.candidates import candidates
from live_ros1.recording import recording
from live_ros1.rows import compared

from ecm_extract.observe.model import Endpoint, Observation

FIXTURES = Path(__file__).parents[2] / "fixtures" / "path_a"


def contract(*rows: tuple[str, str, str]) -> Contract:
    interfaces = tuple(
        Interface(role, name, raw, None, None, None, "pattern" if "{" in name else "literal", (Evidence("n.py", 1),))  # type: ignore[arg-type]
        for role, name, raw in rows
    )
    identity = Identity("ecm.a.n", "a", "script", None, Source(None, None, "n.py"), 1)
    return Contract(identity, Signature(interfaces))


def seen(*rows: tuple[str, str]) -> Observation:
    ends = tuple(Endpoint(role, name, None, "/n") for role, name in rows)
    return Observation(source="ros1", target="", ros=1, begun="", seconds=0, senses=(), endpoints=ends)


def test_rows() -> None:
    """Names on the node, open names that can be this one, what is missing on either side; rospy's own is left out."""
    promised = contract(
        ("publisher", "/odom", "odom"),
        ("publisher", "/{}/state", "/{}/state"),
        ("parameter", "/x/rate", "~rate"),
        ("subscriber", "/never", "/never"),
    )
    live = seen(("publisher", "/odom"), ("publisher", "/r1/state"), ("publisher", "/rosout"), ("subscriber", "/more"))
    rows = compared(promised, "/n", live, {("/n", "/n/rate"), ("/n", "/use_sim_time"), ("/other", "/n/secret")})
    assert rows.registered - rows.known == {("subscriber", "/more")}
    assert rows.known == {("publisher", "/odom"), ("publisher", "/r1/state"), ("parameter", "/n/rate")}
    assert rows.promised - rows.kept == {("subscriber", "/never")}


def test_what_no_line_reached_is_not_missing() -> None:
    """Of what was not registered, a row whose line did not run is told apart from one whose line ran."""
    promised = contract(("publisher", "/made", "/made"), ("subscriber", "/lost", "/lost"))
    live = seen(("publisher", "/made"))
    assert compared(promised, "/n", live, ()).unreached == frozenset()
    assert compared(promised, "/n", live, (), {("n.py", 1)}).unreached == frozenset()
    assert compared(promised, "/n", live, (), {("n.py", 2)}).unreached == {("subscriber", "/lost")}


def test_candidates_are_scripts_of_rospy() -> None:
    found = {each.script.name for each in candidates(FIXTURES / "cmd_vel_robot")}
    assert found == {"diff_drive.py", "teleop.py", "follower.py"}
    assert not list(candidates(FIXTURES / "qos_pairs"))


@pytest.fixture
def master() -> Iterator[str]:
    with SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) as server:
        server.register_function(lambda _caller, key: [1, "", key], "getParam")
        Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


def test_parameters_are_noted_on_their_way(master: str) -> None:
    """The node gets the answer of the real master."""
    with recording(master) as between, xmlrpc.client.ServerProxy(between.uri) as node:
        assert node.getParam("/n", "/n/rate") == [1, "", "/n/rate"]
        assert between.asked == {("/n", "/n/rate")}
