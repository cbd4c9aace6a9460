"""Recordings of every kind fill the model alike."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from bags import KINDS, PERIOD_NS, Recorder, times

from ecm_extract.errors import InputError
from ecm_extract.observe.bag import observe_bags
from ecm_extract.observe.model import Observation, Stream


def recorded(folder: Path, kind: str) -> Observation:
    """Twenty Hz of Imu with a gap and late stamps, a broken tree of frames, a motor that gets hot."""
    with Recorder(folder, kind) as bag:
        imu = bag.topic("/imu", "sensor_msgs/msg/Imu")
        tf = bag.topic("/tf", "tf2_msgs/msg/TFMessage")
        diagnostics = bag.topic("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
        for number, now in enumerate(times(100)):
            late = 2 * 10**9 if number > 60 else 0
            bag.write(imu, now + late, bag.imu(now, "imu_link"))
        for number, now in enumerate(times(10)):
            bag.write(tf, now, bag.transforms(bag.transform(now, "odom", "base", x=5.0 if number == 7 else 0.0)))
            bag.write(tf, now, bag.transforms(bag.transform(now, "map", "base"), bag.transform(now, "base", "map")))
        for level, now in zip((0, 2, 1), times(3), strict=True):
            bag.write(diagnostics, now, bag.diagnostics(now, level, f"level {level}"))
    return observe_bags([bag.path])


def stream(seen: Observation, topic: str) -> Stream:
    return next(each for each in seen.streams if each.topic == topic)


@pytest.mark.parametrize("kind", KINDS)
def test_streams(tmp_path: Path, kind: str) -> None:
    """Rates, gaps, frames and the age of stamps are those that were written."""
    imu = stream(recorded(tmp_path, kind), "/imu")
    assert imu.count == 100
    assert imu.typical_gap_s == pytest.approx(PERIOD_NS * 1e-9, rel=0.02)
    assert imu.longest_gap_s == pytest.approx(2.05)
    assert imu.hz == pytest.approx(99 / (99 * 0.05 + 2), rel=1e-6)
    assert imu.frames == ("imu_link",)
    assert (imu.earliest_s, imu.latest_s) == (pytest.approx(0.0), pytest.approx(2.0))


@pytest.mark.parametrize("kind", KINDS)
def test_types_hashes_and_qos(tmp_path: Path, kind: str) -> None:
    """A recording tells the type with its hash and, in ROS 2, what the publisher offered."""
    seen = recorded(tmp_path, kind)
    imu = next(end for end in seen.endpoints if end.name == "/imu")
    assert imu.type == "sensor_msgs/msg/Imu"
    assert imu.definition
    if kind == "ros1":
        assert (imu.node, imu.hash, imu.qos) == ("/driver", "6a62c6daae103f4ff57a132d6f95cec2", None)
        return
    assert imu.hash is None or imu.hash.startswith("RIHS01_")
    assert imu.qos is not None
    assert (imu.qos.reliability, imu.qos.deadline_ms, imu.qos.lease_ms) == ("best_effort", 100.0, None)


@pytest.mark.parametrize("kind", KINDS)
def test_transforms_and_diagnostics(tmp_path: Path, kind: str) -> None:
    """The tree of frames keeps its faults, a diagnostic task its worst level."""
    seen = recorded(tmp_path, kind)
    pairs = {(each.parent, each.child): each for each in seen.transforms}
    assert set(pairs) == {("odom", "base"), ("map", "base"), ("base", "map")}
    assert pairs["odom", "base"].largest_step_m == pytest.approx(5.0)
    assert [(each.name, each.level, each.message) for each in seen.statuses] == [("base: motor", "error", "level 2")]
    assert seen.gaps == ()


def test_simulated_time_is_no_late_stamp(tmp_path: Path) -> None:
    """Where a clock is published, stamps are of its time and say nothing against receipt."""
    with Recorder(tmp_path, "mcap") as bag:
        imu, clock = bag.topic("/imu", "sensor_msgs/msg/Imu"), bag.topic("/clock", "rosgraph_msgs/msg/Clock")
        for now in times(5):
            bag.write(imu, now, bag.imu(10**9, "imu_link"))
            bag.write(clock, now, bag.type("rosgraph_msgs/msg/Clock")(bag.type("builtin_interfaces/msg/Time")(1, 0)))
    assert stream(observe_bags([bag.path]), "/imu").latest_s is None


def test_a_broken_recording_costs_nothing_of_the_others(tmp_path: Path) -> None:
    """What cannot be read is named, and the rest is read."""
    good = recorded(tmp_path, "ros1")
    (tmp_path / "cut.bag").write_bytes((tmp_path / "run.bag").read_bytes()[:3000])
    (tmp_path / "garbage.mcap").write_bytes(b"\x89MCAP0\r\n" + b"\xff" * 500)
    (tmp_path / "empty.db3").write_bytes(b"")
    bad = [tmp_path / name for name in ("cut.bag", "garbage.mcap", "empty.db3")]
    seen = observe_bags([tmp_path / "run.bag", *bad])
    assert seen.streams[: len(good.streams)] == good.streams
    assert [gap.what for gap in seen.gaps] == [str(path) for path in bad]
    for path in (*bad, tmp_path / "none.bag"):
        with pytest.raises(InputError):
            observe_bags([path])


def test_a_recording_with_less_than_it_says_is_told(tmp_path: Path) -> None:
    """Messages that were taken out of the file, or never written, are a gap."""
    with Recorder(tmp_path, "sqlite3") as bag:
        imu = bag.topic("/imu", "sensor_msgs/msg/Imu")
        for now in times(10):
            bag.write(imu, now, bag.imu(now, "imu_link"))
    (database,) = bag.path.glob("*.db3")
    with closing(sqlite3.connect(database)) as connection:
        connection.execute("DELETE FROM messages WHERE id > 4")
        connection.commit()
    seen = observe_bags([bag.path])
    assert stream(seen, "/imu").count == 4
    assert [gap.why for gap in seen.gaps] == ["4 of the 10 messages that it says it holds are there"]


def test_messages_that_lie_are_told(tmp_path: Path) -> None:
    """Bytes that are not of their type never end the run, and are counted."""
    with Recorder(tmp_path, "mcap") as bag:
        for name, kind in (("/imu", "sensor_msgs/msg/Imu"), ("/tf", "tf2_msgs/msg/TFMessage")):
            connection = bag.topic(name, kind)
            for now, raw in zip(times(4), (b"", b"\0\1", b"\0\1\0\0" + b"\xff" * 12, b"\0" * 3), strict=True):
                bag.writer.write(connection, now, raw)
    gaps = {gap.what: gap.why for gap in observe_bags([bag.path]).gaps}
    assert set(gaps) == {"/imu", "/tf"}
    assert gaps["/imu"].startswith("4 message(s)")


def test_digest_is_of_the_content(tmp_path: Path) -> None:
    """Another content is another digest, the same content is the same one."""
    one = recorded(tmp_path, "ros1").digest
    assert one == observe_bags([tmp_path / "run.bag"]).digest
    copy = tmp_path / "other"
    copy.mkdir()
    assert recorded(copy, "mcap").digest != one
    assert one.startswith("sha256:")
