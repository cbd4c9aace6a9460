"""Behaviour trees of both versions: nodes, ports, retries, models."""

from __future__ import annotations

import pytest
from diagnosed import is_told
from ecm_parsers.behavior_tree import MAX_DIAGNOSTICS, MAX_NODES, is_behavior_tree, parse_behavior_tree, retries
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
        ('<RetryUntilSuccesful num_attempts="3"/>', [3]),
        ('<Decorator ID="RetryUntilSuccessful" num_attempts="4"/>', [4]),
        ('<RecoveryNode number_of_retries="{n}"/>', []),
        ('<RecoveryNode number_of_retries="--1"/>', []),
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
        ("<root><BehaviorTree/></root>", "bt-not-one-root"),
        ("", "xml-empty"),
    ],
)
def test_what_is_wrong_is_told(text: str, code: str) -> None:
    """A node without an ID does not run."""
    assert [entry.code for entry in parse_behavior_tree(text.encode()).diagnostics] == [code]


def test_parents_and_kinds() -> None:
    """A node knows the node around it, and what it is by its tag, the library's table or the file's models."""
    text = (
        '<root BTCPP_format="4"><BehaviorTree ID="A"><Sequence><SetBlackboard value="1" output_key="x"/>'
        '<Inverter><Condition ID="Free"/></Inverter><Grasp _skipIf="x" object="{o}"/><Other/><B/></Sequence>'
        '</BehaviorTree><BehaviorTree ID="B"><SubTreePlus ID="A" __autoremap="1"/></BehaviorTree>'
        '<TreeNodesModel><Action ID="Grasp"/></TreeNodesModel></root>'
    )
    parsed = parse_behavior_tree(text.encode())
    assert parsed.diagnostics == ()
    first, second = parsed.facts.trees
    assert [(node.id, node.element, node.kind, node.built_in, node.parent) for node in first.nodes] == [
        ("Sequence", "Sequence", "control", True, None),
        ("SetBlackboard", "SetBlackboard", "action", True, 0),
        ("Inverter", "Inverter", "decorator", True, 0),
        ("Free", "Condition", "condition", False, 2),
        ("Grasp", "Grasp", "action", False, 0),
        ("Other", "Other", "", False, 0),
        ("B", "B", "subtree", False, 0),
    ]
    assert (first.nodes[4].ports, first.nodes[4].reserved) == ({"object": "{o}"}, {"_skipIf": "x"})
    assert (second.nodes[0].is_subtree, second.nodes[0].reserved) == (True, {"__autoremap": "1"})


@pytest.mark.parametrize(
    ("written", "node", "built_in"),
    [("3", "SequenceStar", True), ("4", "SequenceStar", False), ("3", "Script", False), ("4", "Script", True)],
)
def test_what_the_library_brings(written: str, node: str, built_in: bool) -> None:
    """A node counts as built in only in the format that has it."""
    text = f'<root BTCPP_format="{written}"><BehaviorTree ID="A"><{node}/></BehaviorTree></root>'
    assert parse_behavior_tree(text.encode()).facts.trees[0].nodes[0].built_in is built_in


@pytest.mark.parametrize(
    ("text", "main", "codes"),
    [
        ('<root><BehaviorTree ID="A"><X/></BehaviorTree></root>', "A", []),
        ('<root><BehaviorTree ID="A"><X/></BehaviorTree><include path="b.xml"/></root>', "", []),
        ('<root><BehaviorTree ID="A"><X/></BehaviorTree><BehaviorTree ID="B"><X/></BehaviorTree></root>', "", []),
        ('<root main_tree_to_execute="C"><include path="c.xml"/></root>', "C", []),
        ('<root main_tree_to_execute="C"/>', "C", ["bt-no-main-tree"]),
        ('<root BTCPP_format="9"/>', "", ["bt-format"]),
        (
            '<root><BehaviorTree ID="A"><X/></BehaviorTree><BehaviorTree ID="A"><X/></BehaviorTree></root>',
            "",
            ["bt-duplicate-tree"],
        ),
        ('<root><BehaviorTree ID="A"><X/><Y/></BehaviorTree></root>', "A", ["bt-not-one-root"]),
        ("<root><TreeNodesModel><Action/></TreeNodesModel></root>", "", ["bt-no-id"]),
        ("<root><TreeNodesModel><Notes><Note/></Notes></TreeNodesModel></root>", "", []),
    ],
)
def test_main_tree(text: str, main: str, codes: list[str]) -> None:
    """The tree that is run is the named one or the only one; what the library refuses is told."""
    parsed = parse_behavior_tree(text.encode())
    assert parsed.facts.main_tree == main
    assert [found.code for found in parsed.diagnostics] == codes


def test_bounds() -> None:
    """Nodes and diagnostics of one file are bounded, and what is left out is told once."""
    many = b"<BehaviorTree ID='A'>" + b"<Action/>" * (MAX_NODES // 2 + 1) + b"</BehaviorTree>"
    parsed = parse_behavior_tree(b"<root>" + many * 3 + b"</root>")
    codes = [found.code for found in parsed.diagnostics]
    assert (codes.count("bt-too-many-nodes"), len(codes)) == (1, MAX_DIAGNOSTICS)


@settings(max_examples=50, deadline=None)
@given(st.binary(max_size=80))
def test_never_raises(data: bytes) -> None:
    """No bytes break the parser."""
    for text in (data, b"<root><BehaviorTree>" + data + b"</BehaviorTree></root>"):
        parsed = parse_behavior_tree(text)
        assert is_told(text, parsed)
        assert all(each.line > 0 for each in retries(parsed.facts))
        assert is_behavior_tree(text) in {True, False}
