"""Analyzers of diagnostics in the layouts of ROS 1 and ROS 2."""

from __future__ import annotations

import pytest
from ecm_parsers.diagnostics_yaml import Analyzer, is_diagnostics, parse_diagnostics
from hypothesis import given, settings
from hypothesis import strategies as st

ROS1 = b"""
robot_aggregator:
  pub_rate: 2
  base_path: /arm
  analyzers:
    motors:
      type: GenericAnalyzer
      path: Motors
      timeout: 5
      startswith: motor
      remove_prefix: driver_
      expected: ['motor left', 'motor right']
      num_items: 2
      discard_stale: true
    all:
      type: diagnostic_aggregator/AnalyzerGroup
      path: All
      analyzers:
        one:
          type: my_pkg/MyAnalyzer
          path: One
          contains: [x]
          name: [y]
          regex: ['z.*']
          find_and_remove_prefix: w
"""
ROS2 = b"""
/ns/watch:
  ros__parameters:
    path: Robot
    pub_rate: 1.0
    use_sim_time: true
    qos_overrides:
      /x: {publisher: {depth: 1}}
    arm:
      type: diagnostic_aggregator/GenericAnalyzer
      path: Arm
      startswith: [arm]
      timeout: 2.5
"""


def test_ros1() -> None:
    """The layout of ROS 1 holds the analyzers below their own key, as lists or single names."""
    parsed = parse_diagnostics(ROS1)
    assert parsed.diagnostics == ()
    assert parsed.facts.ros == 1
    (aggregator,) = parsed.facts.aggregators
    assert (aggregator.node, aggregator.base_path, aggregator.pub_rate, aggregator.line) == (
        "/robot_aggregator",
        "/arm",
        2.0,
        5,
    )
    motors = Analyzer(
        key="motors",
        type="GenericAnalyzer",
        path="Motors",
        line=6,
        startswith=("motor",),
        expected=("motor left", "motor right"),
        remove_prefix=("driver_",),
        timeout=5.0,
        num_items=2,
        discard_stale=True,
    )
    one = Analyzer(
        key="one",
        type="my_pkg/MyAnalyzer",
        path="One",
        line=19,
        contains=("x",),
        names=("y",),
        regex=("z.*",),
        find_and_remove_prefix=("w",),
    )
    group = Analyzer("all", "diagnostic_aggregator/AnalyzerGroup", "All", 15, analyzers=(one,))
    assert aggregator.analyzers == (motors, group)


def test_ros2() -> None:
    """In ROS 2 the analyzers stand among the other parameters of the node."""
    parsed = parse_diagnostics(ROS2)
    assert parsed.diagnostics == ()
    (aggregator,) = parsed.facts.aggregators
    assert (parsed.facts.ros, aggregator.node, aggregator.base_path) == (2, "/ns/watch", "Robot")
    assert [(found.key, found.path, found.timeout) for found in aggregator.analyzers] == [("arm", "Arm", 2.5)]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("a: {ros__parameters: {analyzers: {x: {type: p/XAnalyzer, path: X}}}}", 1),
        ("analyzers: {ros__parameters: {x: {type: p/XAnalyzer, path: X}}}", 1),
        ("a: {ros__parameters: {x: {type: p/XAnalyzer, path: X}}}\nb: {ros__parameters: {c: 1}}", 1),
        ("controller_manager: {ros__parameters: {arm: {type: p/Controller}}}", 0),
        ("analyzers: {x: {type: p/Own, path: X}}", 1),
        ("analyzers: [a, b]", 0),
        ("analyzers: {deep: 3}", 0),
        ("", 0),
    ],
)
def test_what_counts_as_aggregator(text: str, count: int) -> None:
    """Maps with a type of other nodes are no analyzers."""
    parsed = parse_diagnostics(text.encode())
    assert parsed.diagnostics == ()
    assert len(parsed.facts.aggregators) == count


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("analyzers: {x: {type: p/XAnalyzer}}", "diagnostics-incomplete"),
        ("analyzers: {x: {type: p/XAnalyzer, path: X}, y: {path: Y}}", "diagnostics-incomplete"),
        ("analyzers: {x: {type: p/AnalyzerGroup, path: X}}", "diagnostics-empty-group"),
        ("analyzers: {x: {type: p/GenericAnalyzer, path: X}}", "diagnostics-selects-nothing"),
        ("a: {ros__parameters: {x: {type: p/XAnalyzer, path: X, contains: y}}}", "diagnostics-not-a-list"),
        ("a: {ros__parameters: {x: {type: p/XAnalyzer, path: X, timeout: 5}}}", "diagnostics-not-a-double"),
    ],
)
def test_what_the_aggregator_refuses(text: str, code: str) -> None:
    """An analyzer that is not loaded watches nothing, so that is told with its line."""
    parsed = parse_diagnostics(f"# first line\n{text}".encode())
    assert [(found.code, found.line) for found in parsed.diagnostics] == [(code, 2)]
    assert len(parsed.facts.aggregators) == 1


def test_number_of_many_digits() -> None:
    """A number that no double holds counts as not set."""
    text = f"analyzers: {{x: {{type: p/XAnalyzer, path: X, timeout: {'9' * 400}}}}}"
    assert parse_diagnostics(text.encode()).facts.aggregators[0].analyzers[0].timeout is None


WORDS = [
    "analyzers",
    "ros__parameters",
    "type",
    "path",
    ": ",
    "{",
    "}",
    "[",
    "]",
    ",",
    "\n  ",
    "&a ",
    "*a",
    "p/XAnalyzer",
]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(WORDS), max_size=40) | st.binary(max_size=80))
def test_never_raises(parts: list[str] | bytes) -> None:
    """No bytes break the parser."""
    data = parts if isinstance(parts, bytes) else "".join(parts).encode()
    is_diagnostics(data)
    assert isinstance(parse_diagnostics(data).facts.aggregators, tuple)
