"""ROS 1 and ROS 2 parameter files."""

import pytest
from diagnosed import is_told
from ecm_parsers.parameter_yaml import parameter_type, parse_parameter_yaml
from hypothesis import given, settings
from hypothesis import strategies as st

ROS2 = b"""\
/**:
  ros__parameters:
    use_sim_time: false
planner:
  ros__parameters:
    grid: {plugin: "p::Grid", tolerance: 0.5}
    names: [a, b]
    path: $(find-pkg-share x)/y.xml
robot:
  arm:
    ros__parameters: {rate.max: 50}
"/ns/*":
  ros__parameters:
    empty: {}
"""


def test_ros2_nodes_namespaces_and_dotted_names() -> None:
    """Nodes are absolute patterns, nested maps are dotted names, each with the line of its key."""
    parsed = parse_parameter_yaml(ROS2)
    assert parsed.facts.ros == 2
    assert [(s.node, s.name, s.value, s.type, s.line) for s in parsed.facts.sets] == [
        ("/**", "use_sim_time", False, "bool", 3),
        ("/planner", "grid.plugin", "p::Grid", "string", 6),
        ("/planner", "grid.tolerance", 0.5, "double", 6),
        ("/planner", "names", ["a", "b"], "string_array", 7),
        ("/planner", "path", "$(find-pkg-share x)/y.xml", "string", 8),
        ("/robot/arm", "rate.max", 50, "int", 11),
        ("/ns/*", "empty", {}, "map", 14),
    ]
    assert parsed.diagnostics == ()


def test_ros1_names_are_joined_with_slashes() -> None:
    """Without `ros__parameters` a file is of ROS 1: nested maps are namespaces, lists are values."""
    parsed = parse_parameter_yaml(b"move_base:\n  costmap:\n    layers:\n      - {name: a}\n/top/x: 1\n")
    assert parsed.facts.ros == 1
    assert [(s.node, s.name, s.value, s.line) for s in parsed.facts.sets] == [
        (None, "move_base/costmap/layers", [{"name": "a"}], 3),
        (None, "/top/x", 1, 5),
    ]


@pytest.mark.parametrize(
    ("data", "values"),
    [
        (b"/**:\n  ros__parameters: {a: 1}\n/**:\n  ros__parameters: {b: 2}\n", [("a", 1), ("b", 2)]),
        (b"a: 1\na: 2\n", [("a", 2)]),
    ],
    ids=["ros2-reads-each", "ros1-takes-the-last"],
)
def test_duplicate_keys_follow_each_reader(data: bytes, values: list[tuple[str, int]]) -> None:
    """ROS 2 applies each duplicate block, ROS 1 only the last one."""
    assert [(s.name, s.value) for s in parse_parameter_yaml(data).facts.sets] == values


def test_values_outside_nodes_are_reported() -> None:
    """In a ROS 2 file a value outside any `ros__parameters` sets nothing."""
    parsed = parse_parameter_yaml(b"node:\n  ros__parameters: {a: 1}\nlost: {b: 2}\n")
    assert [s.name for s in parsed.facts.sets] == ["a"]
    assert [(d.code, d.line) for d in parsed.diagnostics] == [("params-outside-node", 3)]


def test_a_list_sets_nothing() -> None:
    """A document that is not a map is skipped with a diagnostic."""
    parsed = parse_parameter_yaml(b"- a\n")
    assert parsed.facts.sets == ()
    assert [d.code for d in parsed.diagnostics] == ["params-not-a-map"]


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ([1, 2], "int_array"),
        ([1, 2.0], "array"),
        ([], "array"),
        (None, "null"),
        ([[1]], "array"),
        (True, "bool"),
    ],
)
def test_types(value: object, kind: str) -> None:
    """Types have the names of ROS 2 parameter types; mixed and empty lists are `array`."""
    assert parameter_type(value) == kind


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="ab:/*{}[] \n", max_size=60).map(lambda t: b"ros__parameters: {a: 1}\n" + t.encode()))
def test_never_raises_on_parameters(data: bytes) -> None:
    """Any YAML gives sets or diagnostics."""
    assert is_told(data, parse_parameter_yaml(data))
