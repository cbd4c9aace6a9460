"""Behaviour trees of both versions: nodes, ports, retries, models."""

from __future__ import annotations

import time

import pytest
from ecm_parsers.behavior_tree import is_behavior_tree, parse_behavior_tree, retries
from hypothesis import given, settings
from hypothesis import strategies as st

TREE = b"""<root BTCPP_format="4" main_tree_to_execute="Main">
  <include ros_pkg="pkg" path="more.xml"/>
  <BehaviorTree ID="Main">
    <RecoveryNode number_of_retries="6" name="Recover">
      <ComputePath goal="{goal}" path="{path}"/>
      <Action ID="Spin" spin_dist="1.57"/>
      <SubTree ID="Dock" pose="{dock}"/>
    </RecoveryNode>
  </BehaviorTree>
  <TreeNodesModel>
    <Action ID="Spin"><input_port name="spin_dist" default="1.0"/><output_port name="code"/></Action>
  </TreeNodesModel>
</root>"""


def test_file() -> None:
    """Both ways to write a node give the same, with its ports and line."""
    parsed = parse_behavior_tree(TREE)
    assert parsed.diagnostics == ()
    file = parsed.facts
    assert (file.format, file.main_tree, file.includes) == (4, "Main", (("pkg", "more.xml", 2),))
    nodes = file.trees[0].nodes
    assert [(node.id, node.name, node.is_subtree, node.line) for node in nodes] == [
        ("RecoveryNode", "Recover", False, 4),
        ("ComputePath", "", False, 5),
        ("Spin", "", False, 6),
        ("Dock", "", True, 7),
    ]
    assert nodes[1].ports == {"goal": "{goal}", "path": "{path}"}
    assert [
        (model.id, [(port.name, port.direction, port.default) for port in model.ports]) for model in file.models
    ] == [("Spin", [("spin_dist", "input", "1.0"), ("code", "output", None)])]


@pytest.mark.parametrize(
    ("node", "count"),
    [
        ('<RecoveryNode number_of_retries="6"/>', [6]),
        ('<RetryUntilSuccessful num_attempts="2"/>', [2]),
        ('<RetryUntilSuccessful num_attempts="-1"/>', [-1]),
        ('<RecoveryNode number_of_retries="{n}"/>', []),
        ('<Fallback number_of_retries="6"/>', []),
    ],
)
def test_retries(node: str, count: list[int]) -> None:
    """Only nodes that try again count, and only numbers that the file writes."""
    file = parse_behavior_tree(f'<root><BehaviorTree ID="A">{node}</BehaviorTree></root>'.encode()).facts
    assert [number for _, number in retries(file)] == count


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<robot/>", "bt-wrong-root"),
        ("<root><BehaviorTree><Action/></BehaviorTree></root>", "bt-no-id"),
        ("", "xml-empty"),
    ],
)
def test_what_is_wrong_is_told(text: str, code: str) -> None:
    """A node without an ID does not run."""
    assert [entry.code for entry in parse_behavior_tree(text.encode()).diagnostics] == [code]


def test_hostile() -> None:
    """Entities and deep nesting cost less than a second."""
    started = time.perf_counter()
    parse_behavior_tree(b'<!DOCTYPE r [<!ENTITY a "b">]><root>&a;</root>')
    parse_behavior_tree(b"<root>" + b"<Sequence>" * 10_000)
    assert time.perf_counter() - started < 1


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=80))
def test_never_raises(data: bytes) -> None:
    """No bytes break the parser."""
    is_behavior_tree(data)
    list(retries(parse_behavior_tree(data).facts))
    parse_behavior_tree(b"<root><BehaviorTree>" + data + b"</BehaviorTree></root>")
