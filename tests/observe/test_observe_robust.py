"""Bytes of anybody: whatever they are, reading them ends, and gives something or nothing."""

from __future__ import annotations

import struct
from collections.abc import Iterator

import msgspec
import pytest
from ecm_checker.contract import Value
from hypothesis import given, settings
from hypothesis import strategies as st
from observe_fixtures import contracts, observation

from ecm_extract.observe.compare import compare
from ecm_extract.observe.dds.names import meaning, ros_type
from ecm_extract.observe.dds.node_names import nodes_of
from ecm_extract.observe.expected import is_node_of
from ecm_extract.observe.hearing.arrivals import Arrivals
from ecm_extract.observe.hearing.contents import DECODED, decoded
from ecm_extract.observe.hearing.headers import cdr_header, ros1_header
from ecm_extract.observe.hearing.heard import Channel, Heard
from ecm_extract.observe.hearing.layouts import begins_with_header
from ecm_extract.observe.live_view import last_shown
from ecm_extract.observe.model import Observation
from ecm_extract.observe.ros1.frames import Frames
from ecm_extract.observe.ros1.handshake import unpacked
from ecm_extract.observe.watch import Watch


@settings(deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes(raw: bytes) -> None:
    """No reader of bytes ever raises; what it gives is of its kind, or nothing."""
    assert isinstance(nodes_of(raw), tuple | None)
    for read in (ros1_header, cdr_header):
        header = read(raw)
        assert header is None or len(header.frame) <= len(raw)
    assert all("=" not in key for key in unpacked(raw))
    for kind in sorted(DECODED):
        decoded(raw, kind, "ros1")
        decoded(raw, kind, "cdr")


@given(st.text(max_size=80))
def test_any_text(text: str) -> None:
    """No reader of names and definitions ever raises; what it gives is of its kind, or nothing."""
    told, kind = meaning(text, True), ros_type(text)
    assert told is None or told.name.startswith("/")
    assert kind is None or kind.count("/") == 2
    assert begins_with_header("a/msg/B", text) in (True, False)


@given(st.lists(st.binary(max_size=40), max_size=20), st.integers(1, 50))
def test_frames_give_back_what_was_framed(bodies: list[bytes], step: int) -> None:
    """Cut anywhere, the same messages come out."""
    data = b"".join(struct.pack("<I", len(body)) + body for body in bodies)
    found: list[bytes] = []
    frames = Frames(lambda kept, _size: found.append(kept), keep=100)
    for at in range(0, len(data), step):
        frames.feed(data[at : at + step])
    assert found == bodies


@given(st.lists(st.integers(0, 10**15), min_size=1, max_size=60))
def test_arrivals_in_any_order(times: list[int]) -> None:
    """Clocks that jump never give a negative gap or rate."""
    arrivals = Arrivals()
    for each in times:
        arrivals.add(each, 1)
    assert arrivals.count == len(times)
    assert arrivals.hz is None or arrivals.hz > 0
    assert arrivals.longest_gap_s is None or arrivals.longest_gap_s > 0


@given(st.integers(1_000, 10**12), st.integers(3, 40))
def test_the_usual_gap_is_the_usual_gap(period: int, count: int) -> None:
    """Within two percent, whatever the rate."""
    arrivals = Arrivals()
    for number in range(count):
        arrivals.add(10**18 + number * period, 1)
    assert arrivals.typical_gap_s == pytest.approx(period * 1e-9, rel=0.02)


def test_names_from_outside_reach_no_terminal() -> None:
    """A name with control characters is one line of harmless text in every finding."""
    from ecm_extract.report.findings.text import render

    evil = "/a\x1b[31m\nerror"
    ends = [{"role": "publisher", "name": "/cmd_vel", "type": None, "node": f"{evil}{n}"} for n in range(2)]
    text = render(compare(Watch(observation(endpoints=ends))))
    assert "OBS009" in text
    assert "\x1b" not in text


@pytest.mark.parametrize(
    ("node", "module", "same"),
    [
        ("/driver", "ecm.base.driver", True),
        ("/robot1/driver", "ecm.base.driver", True),
        ("/robot1/driver", "ecm.base.robot1.driver", True),
        ("/robot2/driver", "ecm.base.robot1.driver", False),
        ("/driver_4711_1795327304125", "ecm.base.driver", True),
        ("/driver_2", "ecm.base.driver", False),
        ("/other", "ecm.base.driver", False),
        ("/my/base/driver", "ecm.my.base.driver", True),
    ],
)
def test_nodes_find_their_contract(node: str, module: str, same: bool) -> None:
    """By the whole name or its last part; small numbers are meant to differ."""
    from ecm_checker.view import view

    (contract,) = contracts([{"id": module}])
    assert is_node_of(node, view(contract)) is same


def test_relative_and_private_names_are_those_of_the_node() -> None:
    """A contract is of the root namespace, a node is where it is."""
    names = (("/odom", "odom"), ("/driver/state", "~state"), ("/tf_map", "/tf_map"))
    promised = contracts(
        [
            {
                "id": "ecm.base.driver",
                "interfaces": [
                    {"role": "publisher", "name": name, "raw_name": raw, "type": "a/msg/B"} for name, raw in names
                ],
            }
        ]
    )
    ends = [
        {"role": "publisher", "name": name, "type": "a/msg/B", "node": "/r1/main/driver"}
        for name in ("/r1/main/odom", "/r1/main/driver/state", "/tf_map")
    ]
    seen = observation(endpoints=ends, senses=["node", "publisher"])
    assert compare(Watch(seen, promised)) == ()


def test_what_cannot_be_seen_is_not_missing() -> None:
    """A service client is not registered in ROS 1, so its absence means nothing; a remap is most likely one."""
    ends = [{"role": "publisher", "name": "/base/odom", "type": "nav_msgs/msg/Odometry", "node": "/driver"}]
    seen = observation(endpoints=ends, senses=["node", "publisher"])
    interfaces = [
        {"role": "service_client", "name": "/go", "type": "a/srv/B"},
        {"role": "publisher", "name": "/odom", "type": "nav_msgs/msg/Odometry"},
    ]
    found = compare(Watch(seen, contracts([{"id": "ecm.base.driver", "interfaces": interfaces}])))
    told = {(each.rule, each.severity) for each in found}
    assert told == {("OBS001", "info"), ("OBS002", "warning")}


def test_a_node_that_a_library_made_is_nobody_new() -> None:
    """A listener of tf2 subscribes on a node of its own: the lookup of the contract is there, and no stranger is."""
    helper = {"role": "subscriber", "name": "/tf", "type": "tf2_msgs/msg/TFMessage"}
    ends = [{**helper, "node": "/transform_listener_impl_55d0c1"}]
    seen = observation(endpoints=ends, nodes=[{"name": "/picker"}], senses=["node", "subscriber"])
    lookup = {"role": "tf_lookup", "name": "tf", "type": None, "frame": "a <- b"}
    assert compare(Watch(seen, contracts([{"id": "ecm.arm.picker", "interfaces": [lookup]}]))) == ()


def test_an_interrupted_watch_ends_with_what_was_seen() -> None:
    """Who stops it early gets the findings so far."""

    def observations() -> Iterator[Observation]:
        yield observation(seconds=1.0)
        yield observation(seconds=2.0)
        raise KeyboardInterrupt

    assert last_shown(observations()).seconds == 2.0


@pytest.mark.parametrize(
    ("frame", "confidence", "told"),
    [("map", "literal", ("error", "proved")), ("map", "default", ("warning", "likely")), ("odom", "literal", None)],
)
def test_the_one_frame_of_a_module(frame: str, confidence: str, told: tuple[str, str] | None) -> None:
    """A module that gives all its data in one frame promises it of each topic; a default is only likely."""
    end = {"role": "publisher", "name": "/odom", "type": "nav_msgs/msg/Odometry", "node": "/driver"}
    stream = {"topic": "/odom", "node": "/driver", "count": 9, "frames": ["odom"]}
    seen = observation(endpoints=[end], streams=[stream], senses=["node", "publisher"])
    (plain,) = contracts([{"id": "ecm.base.driver", "interfaces": [{k: end[k] for k in ("role", "name", "type")}]}])
    value = Value(frame, "inferred", confidence)  # type: ignore[arg-type]
    signature = msgspec.structs.replace(plain.signature, coordinate_frame=value)
    found = compare(Watch(seen, [msgspec.structs.replace(plain, signature=signature)]))
    assert [(each.rule, each.severity, each.certainty) for each in found] == ([("OBS018", *told)] if told else [])


def test_a_listener_counts_what_it_cannot_read() -> None:
    """Broken messages are counted by their topic."""
    heard = Heard()
    listener = heard.listener(Channel("/tf", "/a", "tf2_msgs/msg/TFMessage", "cdr"))
    for raw in (b"", b"\0\1\0\0\xff\xff\xff\xff"):
        listener.message(raw, 1)
    assert [(gap.what, gap.why) for gap in heard.gaps()] == [("/tf", "2 message(s) are no tf2_msgs/msg/TFMessage")]
