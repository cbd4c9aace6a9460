"""A DDS domain is read as ROS 2, beside peers that tell no more than an rmw does."""

from __future__ import annotations

import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

pytest.importorskip("cyclonedds", reason="needs the extra dds")

from cyclonedds.core import Entity, Policy
from cyclonedds.util import duration
from observe_fixtures import contracts
from ros2_peer import BEST_EFFORT, DOMAIN, RELIABLE, Peer

from ecm_extract.observe.compare import compare
from ecm_extract.observe.dds import watch_dds
from ecm_extract.observe.dds.names import meaning, ros_type
from ecm_extract.observe.dds.node_names import nodes_of
from ecm_extract.observe.model import Observation
from ecm_extract.observe.watch import Watch

TWIST = "geometry_msgs/msg/Twist"
IMU = "sensor_msgs/msg/Imu"


PATIENCE_S = 60.0


def last(enough: Callable[[Observation], object]) -> Observation:
    """The first look at everything that is enough, however late a loaded machine makes it."""
    return next(seen for seen in watch_dds(DOMAIN, PATIENCE_S) if enough(seen))


def once(enough: Callable[[Observation], object]) -> Observation:
    """The first look that is enough, each without listening; the last one of many otherwise."""
    for _ in range(20):
        (seen,) = watch_dds(DOMAIN, 0, once=True)
        if enough(seen):
            break
    return seen


def has_ends(count: int) -> Callable[[Observation], bool]:
    return lambda seen: len(seen.endpoints) == count


def has_incident(kind: str) -> Callable[[Observation], bool]:
    return lambda seen: kind in [incident.kind for incident in seen.incidents]


@contextmanager
def sending(write: Callable[[], None], hz: float = 50) -> Iterator[None]:
    """Send at a rate as long as it lasts."""
    over = threading.Event()

    def send() -> None:
        while not over.wait(1 / hz):
            write()

    thread = threading.Thread(target=send, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


@pytest.fixture
def peer() -> Iterator[Peer]:
    found = Peer(enclave="/secure")
    yield found
    found.close()


def imu(frame: str, size: int = 48) -> bytes:
    now = time.time_ns()
    text = frame.encode() + b"\0"
    return (struct.pack("<iII", now // 10**9, now % 10**9, len(text)) + text).ljust(size, b"\0")


@pytest.mark.parametrize("gid", [16, 24])
def test_nodes_and_endpoints(peer: Peer, gid: int) -> None:
    """Names, types, policies and nodes, in both layouts of node names."""
    hashed = Policy.Userdata(b"typehash=RIHS01_abab;")
    peer.publisher("/driver", "/cmd_vel", TWIST, BEST_EFFORT, Policy.Deadline(duration(milliseconds=100)), hashed)
    peer.subscriber("/arm/server", "/cmd_vel", TWIST, RELIABLE, Policy.Durability.TransientLocal)
    peer.server("/arm/server", "/add", "example_interfaces/srv/AddTwoInts")
    peer.server("/arm/server", "/dock/_action/send_goal", "demo/action/Dock_SendGoal")
    peer.client("/driver", "/add", "example_interfaces/srv/AddTwoInts")
    peer.tell_nodes(gid)
    seen = once(lambda seen: has_ends(5)(seen) and not seen.gaps)
    assert [(node.name, node.enclave) for node in seen.nodes] == [("/arm/server", "/secure"), ("/driver", "/secure")]
    ends = {(end.role, end.name): end for end in seen.endpoints}
    assert ends["publisher", "/cmd_vel"].node == "/driver"
    assert ends["publisher", "/cmd_vel"].type == TWIST
    assert ends["publisher", "/cmd_vel"].hash == "RIHS01_abab"
    offered, wanted = ends["publisher", "/cmd_vel"].qos, ends["subscriber", "/cmd_vel"].qos
    assert offered is not None
    assert wanted is not None
    assert (offered.reliability, offered.deadline_ms, offered.lease_ms) == ("best_effort", 100.0, None)
    assert (wanted.reliability, wanted.durability) == ("reliable", "transient_local")
    assert ends["service_server", "/add"].type == "example_interfaces/srv/AddTwoInts"
    assert ends["service_client", "/add"].node == "/driver"
    assert ends["action_server", "/dock"].node == "/arm/server"
    assert len(ends) == 5
    assert seen.gaps == ()


def test_rates_and_frames_of_types_that_nobody_told(peer: Peer) -> None:
    """A stream is counted by writer, and its header is read from its bytes."""
    one, two = (peer.publisher(node, "/imu", IMU, BEST_EFFORT) for node in ("/left", "/right"))
    peer.tell_nodes()
    with sending(lambda: one.write(imu("left_link")), 50), sending(lambda: two.write(imu("right_link")), 20):
        seen = last(lambda seen: sum(stream.count > 20 for stream in seen.streams) == 2)
    streams = {stream.node: stream for stream in seen.streams if stream.topic == "/imu"}
    assert streams["/left"].frames == ("left_link",)
    assert streams["/right"].frames == ("right_link",)
    assert 0 < (streams["/right"].hz or 0) < (streams["/left"].hz or 0) < 60
    assert abs(streams["/left"].earliest_s or 0) < PATIENCE_S


def test_the_middleware_itself_reports_policies_that_do_not_match(peer: Peer) -> None:
    """Beside the comparison of policies, the middleware refuses a reader that asks alike."""
    peer.publisher("/driver", "/scan", "sensor_msgs/msg/LaserScan", BEST_EFFORT)
    peer.subscriber("/mapper", "/scan", "sensor_msgs/msg/LaserScan", RELIABLE)
    peer.tell_nodes()
    seen = last(lambda seen: has_incident("incompatible_qos")(seen) and not seen.gaps)
    assert ("incompatible_qos", "/scan", "reliability") in [(i.kind, i.name, i.detail) for i in seen.incidents]
    (found,) = [each for each in compare(Watch(seen)) if each.rule == "OBS005"]
    assert "/driver offers reliability best_effort, /mapper asks for reliable" in found.message


def test_missed_deadlines_are_seen(peer: Peer) -> None:
    """A writer that promises 100 ms and sends every 400 ms misses its deadline."""
    deadline = Policy.Deadline(duration(milliseconds=100))
    writer = peer.publisher("/driver", "/odom", "nav_msgs/msg/Odometry", RELIABLE, deadline)
    peer.tell_nodes()
    with sending(lambda: writer.write(bytes(48)), 2.5):
        seen = last(has_incident("deadline_missed"))
    assert {incident.name for incident in seen.incidents} == {"/odom"}


def test_a_lost_lease_is_seen(peer: Peer) -> None:
    """A writer that must say that it is alive, and does not, is lost."""
    alive = Policy.Liveliness.ManualByTopic(duration(milliseconds=200))
    writer = peer.publisher("/driver", "/heartbeat", "std_msgs/msg/Empty", RELIABLE, alive)
    with sending(lambda: writer.write(bytes(48)), 0.9):
        seen = last(has_incident("liveliness_lost"))
    assert {incident.name for incident in seen.incidents} == {"/heartbeat"}


def test_what_has_left_is_not_there(peer: Peer) -> None:
    """An endpoint that goes while it is watched is not told as running."""
    writer = peer.publisher("/driver", "/odom", "nav_msgs/msg/Odometry", RELIABLE)
    seen = watch_dds(DOMAIN, PATIENCE_S)
    assert next(each for each in seen if has_ends(1)(each)).endpoints[0].name == "/odom"
    writer.close()
    assert next(each for each in seen if has_ends(0)(each)).endpoints == ()


@pytest.mark.parametrize("body", [b"", b"\0" * 4, b"\xff" * 64, b"\0" * 16 + struct.pack("<I", 2**31), b"x" * 4000])
def test_garbage_about_nodes(peer: Peer, body: bytes) -> None:
    """Node names that are none leave the endpoints, and are told."""
    assert nodes_of(b"\0\1\0\0" + body) in (None, ())
    peer.publisher("/driver", "/odom", "nav_msgs/msg/Odometry", RELIABLE)
    peer.say_of_nodes(body or b"\1")
    seen = once(has_ends(1))
    assert [(end.name, end.node) for end in seen.endpoints] == [("/odom", None)]
    assert seen.gaps


@pytest.mark.parametrize("data", [b"\xff\xfe;typehash;=;", b"typehash=" + b"x" * 5000, b";" * 3000, b"\0"])
def test_user_data_of_anybody(peer: Peer, data: bytes) -> None:
    """What is no hash is none, and what is none of ROS is passed over; the endpoint is there."""
    peer.publisher("/driver", "/odom", "nav_msgs/msg/Odometry", RELIABLE, Policy.Userdata(data))
    peer._raw("not_of_ros", "Whatever", 8, (), writes=True)
    (end,) = once(has_ends(1)).endpoints
    assert end.name == "/odom"
    assert end.hash in (None, "x" * 5000)


def test_a_contract_and_what_runs(peer: Peer) -> None:
    """From the domain to findings: a missing endpoint, another policy, a surplus one."""
    peer.publisher("/driver", "/odom", "nav_msgs/msg/Odometry", BEST_EFFORT)
    peer.publisher("/driver", "/debug", "std_msgs/msg/String", RELIABLE)
    peer.tell_nodes()
    odom = {"role": "publisher", "name": "/odom", "type": "nav_msgs/msg/Odometry", "qos": {"reliability": "reliable"}}
    stop = {"role": "subscriber", "name": "/stop", "type": "std_msgs/msg/Empty"}
    promised = contracts([{"id": "ecm.base.driver", "interfaces": [odom, stop]}])
    assert {each.rule for each in compare(Watch(once(lambda seen: has_ends(2)(seen) and not seen.gaps), promised))} == {
        "OBS001",
        "OBS002",
        "OBS006",
    }


def test_it_leaves_nothing_behind() -> None:
    """Its participant and readers are gone when the watch is over."""
    before = set(Entity._entities)
    once(lambda seen: True)
    assert set(Entity._entities) <= before


@pytest.mark.parametrize(
    ("topic", "writes", "told"),
    [
        ("rt/arm/goal", True, ("publisher", "/arm/goal")),
        ("rq/addRequest", True, ("service_client", "/add")),
        ("rq/addRequest", False, ("service_server", "/add")),
        ("rr/addReply", True, (None, "/add")),
        ("rt/aRequest", False, ("subscriber", "/aRequest")),
        ("plain", True, None),
        ("rt", True, None),
        ("", True, None),
    ],
)
def test_names(topic: str, writes: bool, told: tuple[str | None, str] | None) -> None:
    """Source: the mapping of names in the ROS 2 design."""
    assert meaning(topic, writes) == told


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("std_msgs::msg::dds_::String_", "std_msgs/msg/String"),
        ("a::srv::dds_::Add_Request_", "a/srv/Add"),
        ("a::action::dds_::Dock_SendGoal_Request_", "a/action/Dock_SendGoal"),
        ("String", None),
        ("a::msg::String_", None),
    ],
)
def test_types(name: str, told: str | None) -> None:
    assert ros_type(name) == told
