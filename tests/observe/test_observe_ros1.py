"""A ROS 1 graph is read without rospy; peers that lie, hang or send garbage cost nothing but themselves."""

from __future__ import annotations

import socket
import struct
import time
from collections.abc import Callable
from typing import Any
from xmlrpc.client import dumps

import pytest
from fake_ros1 import (
    HANG_S,
    TWIST,
    TWIST_MD5,
    FakeNode,
    Graph,
    Publisher,
    answering,
    dripping,
    header,
    http,
    running,
    silent,
)

from ecm_extract.errors import InputError
from ecm_extract.observe.model import Observation
from ecm_extract.observe.ros1 import peer, watch_ros1
from ecm_extract.observe.ros1.frames import Frames
from ecm_extract.observe.ros1.peer import PeerError
from ecm_extract.observe.ros1.rpc import call

ALLOWED = {"getSystemState", "getTopicTypes", "getParam", "lookupNode", "lookupService", "getSubscriptions"} | {
    "requestTopic"
}


def base_and_two_writers() -> list[FakeNode]:
    return [
        FakeNode("/teleop", [Publisher("/cmd_vel", TWIST, TWIST_MD5)]),
        FakeNode("/follower", [Publisher("/cmd_vel", TWIST, TWIST_MD5)]),
        FakeNode(
            "/base", [], {"/cmd_vel": TWIST}, {"/base/reset": ("std_srvs/Empty", "d41d8cd98f00b204e9800998ecf8427e")}
        ),
    ]


def last(uri: str, seconds: float = 0.5, once: bool = False) -> Observation:
    return list(watch_ros1(uri, seconds, once=once))[-1]


def test_nodes_endpoints_parameters_and_rates() -> None:
    """Types, hashes and definitions come from the header of each publisher, the rest from master and nodes."""
    with running(*base_and_two_writers(), parameters={"base": {"max_vel": 0.5}}) as graph:
        seen = last(graph.uri, 1.0)
    assert [node.name for node in seen.nodes] == ["/base", "/follower", "/teleop"]
    ends = {(end.role, end.name, end.node): end for end in seen.endpoints}
    assert ends["publisher", "/cmd_vel", "/teleop"].hash == TWIST_MD5
    assert ends["publisher", "/cmd_vel", "/teleop"].definition
    assert ends["subscriber", "/cmd_vel", "/base"].type == "geometry_msgs/msg/Twist"
    assert ends["service_server", "/base/reset", "/base"].type == "std_srvs/srv/Empty"
    assert [(each.name, each.value) for each in seen.parameters] == [("/base/max_vel", 0.5)]
    assert {stream.node for stream in seen.streams} == {"/teleop", "/follower"}
    assert all(0 < (stream.hz or 0) < 200 for stream in seen.streams)
    assert seen.gaps == ()


def test_it_only_asks() -> None:
    """Nothing is registered, called or set."""
    with running(*base_and_two_writers()) as graph:
        last(graph.uri)
        assert set(graph.calls) <= ALLOWED


def test_once_does_not_listen() -> None:
    """One look is over as soon as everybody answered, and knows no rates."""
    with running(*base_and_two_writers()) as graph:
        start = time.monotonic()
        seen = last(graph.uri, 600, once=True)
    assert time.monotonic() - start < 300
    assert seen.streams == ()
    assert "rate" not in seen.senses


def test_it_stops_on_time() -> None:
    """It takes the time that was asked for, and what the last exchanges take; it shows what it has meanwhile."""
    with running(*base_and_two_writers()) as graph:
        start = time.monotonic()
        snapshots = list(watch_ros1(graph.uri, 2.5))
    assert 2.5 <= time.monotonic() - start < 60
    assert len(snapshots) >= 2


def test_no_master_is_an_input_error() -> None:
    with pytest.raises(InputError):
        last("http://127.0.0.1:9/")


def test_a_dead_node_is_a_gap() -> None:
    """A node that is registered and gone is named, the others are seen."""
    with running(*base_and_two_writers()) as graph:
        graph.addresses["/teleop"] = "http://127.0.0.1:9/"
        seen = last(graph.uri)
    assert [gap.what for gap in seen.gaps] == ["/teleop"]
    assert {stream.node for stream in seen.streams} == {"/follower"}


BOMB = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "' + b"x" * 100 + b'">]><methodResponse>&b;</methodResponse>'
WRONG: list[Any] = [5, [1], [0, "no", 0], ["1", "", []], [1, "", [[["/a", "/b"]], [], []]], [1, "", {"a": 1}]]
GARBAGE: list[bytes] = [
    b"",
    b"\xff" * 1000,
    http(b""),
    http(b"<methodResponse>" * 500),
    http(BOMB),
    b"HTTP/1.0 200 OK\r\nContent-Length: 99999999999\r\n\r\n<x>",
    b"HTTP/1.0 500 no\r\n\r\n",
    b"A" * 100_000,
    http(
        b"<methodResponse><params><param><value><int>"
        + b"9" * 100_000
        + b"</int></value></param></params></methodResponse>"
    ),
    *(http(dumps((each,), methodresponse=True).encode()) for each in WRONG),
]


def sends(data: bytes) -> Callable[[socket.socket], None]:
    def answer(connection: socket.socket) -> None:
        connection.recv(65536)
        connection.sendall(data)
        connection.close()

    return answer


@pytest.mark.parametrize("data", GARBAGE, ids=range(len(GARBAGE)))
def test_a_master_of_garbage(data: bytes) -> None:
    """Whatever it answers, the run ends with one clear error."""
    with answering(sends(data)) as uri, pytest.raises(InputError):
        last(uri)


@pytest.mark.parametrize("behaviour", [silent, dripping])
def test_a_peer_that_hangs_is_left(behaviour: Callable[[socket.socket], None], monkeypatch: pytest.MonkeyPatch) -> None:
    """Silence and single bytes end at the same bound."""
    monkeypatch.setattr(peer, "TIMEOUT_S", 0.4)
    with answering(behaviour) as uri:
        start = time.monotonic()
        with pytest.raises(PeerError):
            call(uri, str, "getPid")
    assert time.monotonic() - start < HANG_S / 2


HEADERS: list[bytes] = [
    b"",
    b"\0\0",
    struct.pack("<I", 2**32 - 1),
    struct.pack("<I", 8) + struct.pack("<I", 2**31) + b"abcd",
    header(error="Client [/x] wants something else"),
    header(type="geometry_msgs/Twist") + struct.pack("<I", 2**32 - 1) + b"x" * 1000,
    header(nothing="at all"),
    header(type="/", md5sum="\0") + b"\xff" * 50,
]


@pytest.mark.parametrize("data", HEADERS, ids=range(len(HEADERS)))
def test_a_publisher_of_garbage(data: bytes) -> None:
    """A publisher that breaks the protocol ends nothing; what it said of itself is all that is kept."""
    with running(*base_and_two_writers()) as graph:
        port = graph._listen(lambda connection: sends(data)(connection))
        graph._servers[0].register_function(
            lambda _caller, _topic, _ps: (1, "", ["TCPROS", "127.0.0.1", port]), "requestTopic"
        )
        seen = last(graph.uri)
    assert {end.node for end in seen.endpoints if end.role == "publisher"} == {"/teleop", "/follower"}
    assert "/follower" in {stream.node for stream in seen.streams}


@pytest.mark.parametrize("step", [1, 3, 7, 1000])
def test_frames_are_cut_at_their_lengths(step: int) -> None:
    """However the bytes come, each message has its size and its first bytes."""
    bodies = [b"", b"a", b"bcdef" * 10, b"", b"z" * 100]
    data = b"".join(struct.pack("<I", len(body)) + body for body in bodies)
    found: list[tuple[bytes, int]] = []
    frames = Frames(lambda kept, size: found.append((kept, size)), keep=8)
    for at in range(0, len(data), step):
        frames.feed(data[at : at + step])
    assert found == [(body[:8], len(body)) for body in bodies]


def actions_server() -> FakeNode:
    kind = "demo_msgs/Dock"
    publishers = [
        Publisher(f"/dock/{part}", f"{kind}Action{part.title()}", "*", hz=1) for part in ("feedback", "result")
    ]
    publishers.append(Publisher("/dock/status", "actionlib_msgs/GoalStatusArray", "*", hz=1))
    subscribed = {"/dock/goal": f"{kind}ActionGoal", "/dock/cancel": "actionlib_msgs/GoalID"}
    return FakeNode("/docking", publishers, subscribed)


def test_five_topics_are_an_action() -> None:
    """An action server is one endpoint, as in its contract."""
    with running(actions_server()) as graph:
        seen = last(graph.uri, once=True)
    assert [(end.role, end.name, end.type) for end in seen.endpoints] == [
        ("action_server", "/dock", "demo_msgs/action/Dock")
    ]


def test_three_hundred_endpoints(benchmark_graph: Graph) -> None:
    """None is lost where many answer at once; benchmarks/observe_graph.py measures the time."""
    assert len(last(benchmark_graph.uri, once=True).endpoints) == 300


@pytest.fixture
def benchmark_graph() -> Any:
    nodes = [
        FakeNode(
            f"/n{number}",
            [Publisher(f"/t{number}_{each}", TWIST, TWIST_MD5, hz=1) for each in range(5)],
            {f"/t{(number + 1) % 30}_{each}": TWIST for each in range(5)},
        )
        for number in range(30)
    ]
    with running(*nodes) as graph:
        yield graph
