"""Parameters of a rosbag2 recorder tell what it records."""

from __future__ import annotations

import pytest
from ecm_parsers.recorder_topics import is_recorder, parse_recorder
from hypothesis import given, settings
from hypothesis import strategies as st

FILE = b"""
/ns/bag:
  ros__parameters:
    use_sim_time: false
    record:
      topics: [/odom, scan]
      exclude_topics:
        - /scan
      services: [/stop]
      regex: "/cam.*"
      is_discovery_disabled: true
      qos_profile_overrides_path: $(find-pkg-share pkg)/qos.yaml
      topic_polling_interval: {sec: 0, nsec: 1}
    storage:
      uri: bags/run
/other:
  ros__parameters: {rate: 3}
"""


def section(record: str, more: str = "") -> bytes:
    """A parameter file with the given `record` map on its second line."""
    return f"recorder: {{ros__parameters: {{{more}\n record: {record}}}}}".encode()


def test_recorder() -> None:
    """Names, patterns, exclusions and the bag are read with their lines; other nodes are left out."""
    parsed = parse_recorder(FILE)
    assert parsed.diagnostics == ()
    (recorder,) = parsed.facts
    assert (recorder.node, recorder.line, recorder.storage_uri) == ("/ns/bag", 6, "bags/run")
    assert (recorder.topics, recorder.services, recorder.regex) == (("/odom", "scan"), ("/stop",), "/cam.*")
    assert (recorder.exclude_topics, recorder.exclude_regex) == (("/scan",), "")
    assert (recorder.all_topics, recorder.discovers) == (False, False)
    assert recorder.qos_overrides == "$(find-pkg-share pkg)/qos.yaml"
    assert [recorder.lines[name] for name in ("topics", "exclude_topics", "regex")] == [6, 7, 10]


@pytest.mark.parametrize(
    ("record", "everything", "exclude"),
    [
        ("{all_topics: true, exclude_regex: x}", True, "x"),
        ("{all: true, exclude: x}", True, "x"),
        ("{all_topics: false, all: true, topics: [a]}", False, ""),
    ],
)
def test_older_names(record: str, everything: bool, exclude: str) -> None:
    """Older names of parameters count where the newer ones are absent."""
    (recorder,) = parse_recorder(section(record)).facts
    assert (recorder.all_topics, recorder.exclude_regex) == (everything, exclude)


@pytest.mark.parametrize(
    ("data", "codes"),
    [
        (section("{topics: [a]}"), []),
        (section("{topics: []}"), ["recorder-records-nothing"]),
        (section("{exclude_regex: x}"), ["recorder-records-nothing"]),
        (section("{topics: /odom}"), ["recorder-wrong-type"]),
        (section("{all_topics: 1}"), ["recorder-wrong-type"]),
        (section("{topics: $(var topics)}"), []),
        (section("{all_topics: $(var all)}"), []),
        (section("{all_topics: true, is_discovery_disabled: true}", "use_sim_time: true,"), ["recorder-sim-time"]),
    ],
)
def test_what_the_recorder_refuses(data: bytes, codes: list[str]) -> None:
    """A recorder that does not start, or records nothing, is told; what only the launch knows is not."""
    parsed = parse_recorder(data)
    assert [found.code for found in parsed.diagnostics] == codes
    assert all(found.line > 0 for found in parsed.diagnostics)
    assert len(parsed.facts) == 1


@pytest.mark.parametrize(
    "text",
    ["record: {topics: [a]}", "n: {ros__parameters: {record: true}}", "n: {ros__parameters: {record: {hz: 1}}}", ""],
)
def test_other_files(text: str) -> None:
    """A parameter that is merely named `record` makes no recorder, and ROS 1 has none."""
    assert parse_recorder(text.encode()).facts == ()


WORDS = ["n: ", "ros__parameters: ", "record: ", "topics: ", "{", "}", "[", "]", ",", "\n  ", "&a ", "*a", "true", "1"]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=40) | st.binary(max_size=80))
def test_never_raises(parts: list[str] | bytes) -> None:
    """No bytes break the parser, inside a recorder's parameters either."""
    data = parts if isinstance(parts, bytes) else "".join(parts).encode()
    is_recorder(data)
    assert isinstance(parse_recorder(data).facts, tuple)
    assert isinstance(parse_recorder(b"n:\n ros__parameters:\n  record: " + data).facts, tuple)
