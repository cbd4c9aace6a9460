"""Launch XML and YAML of both ROS versions give the same vocabulary of actions."""

from __future__ import annotations

import time

import pytest
from diagnosed import is_told
from ecm_parsers.launch.files import parse_launch_xml, parse_launch_yaml
from ecm_parsers.launch.model import Action, Argument, Group, Include, Node, ParameterFile, ParameterValue
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.template import Substitution
from hypothesis import given, settings
from hypothesis import strategies as st


def actions(body: str) -> tuple[Action, ...]:
    parsed = parse_launch_xml(f"<launch>{body}</launch>".encode())
    assert parsed.facts is not None
    assert parsed.diagnostics == ()
    return parsed.facts.actions


def node(body: str) -> Node:
    (action,) = actions(body)
    assert isinstance(action, Node)
    return action


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("plain", ("plain",)),
        ("$(arg x)", (Substitution("arg", (("x",),)),)),
        ("$(var x)", (Substitution("arg", (("x",),)),)),
        ("a$(find p)/b", ("a", Substitution("find", (("p",),)), "/b")),
        ("$(find-pkg-share $(var p))", (Substitution("find", ((Substitution("arg", (("p",),)),),)),)),
        ("$(optenv X a b)", (Substitution("env", (("X",), ("a", " ", "b"))),)),
        ("$(env X default)", (Substitution("env", (("X",), ("default",))),)),
        ("$(eval arg('x') + 1)", (Substitution("eval", (("arg('x') + 1",),)),)),
        ("$(eval '1 if \\'$(var x)\\' else 2')", None),
        ("$(strange x)", (Substitution("unknown", (("strange x",),)),)),
        ("$(arg x", ("$(arg x",)),
        ("", ()),
    ],
)
def test_substitutions(text: str, parts: tuple[object, ...] | None) -> None:
    """Every substitution keeps its arguments; what is not closed stays text."""
    found = parse_template(text)
    if parts is None:
        assert isinstance(found[0], Substitution)
        assert found[0].kind == "eval"
    else:
        assert found == parts


@pytest.mark.parametrize(
    ("body", "version"),
    [
        ('<node pkg="p" type="t" name="n"/>', 1),
        ('<node pkg="p" exec="t"/>', 2),
        ('<rosparam command="load" file="x"/>', 1),
        ('<let name="a" value="b"/>', 2),
        ('<arg name="a" default="$(find p)"/>', 1),
        ('<arg name="a" default="$(find-pkg-share p)"/>', 2),
    ],
)
def test_dialect(body: str, version: int) -> None:
    """Elements, attributes and substitutions tell the ROS version."""
    parsed = parse_launch_xml(f"<launch>{body}</launch>".encode())
    assert parsed.facts is not None
    assert parsed.facts.ros == version


def test_ros1_node() -> None:
    """Private parameters, YAML, remaps and respawn stand with their node."""
    found = node(
        '<node pkg="p" type="t" name="n" ns="a" respawn="true" args="-x $(arg y) z">'
        '<param name="rate" value="5"/><rosparam>k: 1</rosparam><rosparam command="load" file="f.yaml"/>'
        '<remap from="a" to="b"/></node>'
    )
    assert [type(entry) for entry in found.parameters] == [ParameterValue]
    assert [type(entry) for entry in found.loaded] == [ParameterValue, ParameterFile]
    assert [(entry.source, entry.target) for entry in found.remaps] == [(("a",), ("b",))]
    assert (found.namespace, found.respawn) == (("a",), ("true",))
    assert [len(word) for word in found.arguments] == [1, 1, 1]


@pytest.mark.parametrize(
    ("args", "kind", "plugin", "target"),
    [
        ("manager", "container", (), None),
        ("load a/B m", "component", ("a/B",), ("m",)),
        ("standalone a/B", "component", ("a/B",), None),
        ("unload x m", "node", (), None),
    ],
)
def test_nodelets(args: str, kind: str, plugin: tuple[str, ...], target: tuple[str, ...] | None) -> None:
    """The first argument of the nodelet program tells what it is."""
    found = node(f'<node pkg="nodelet" type="nodelet" name="n" args="{args}"/>')
    assert (found.kind, found.plugin, found.target) == (kind, plugin, target)


def test_ros2_node() -> None:
    """Nested parameters are dotted, lists are lists, files are files."""
    found = node(
        '<node pkg="p" exec="e" name="n" namespace="a"><param name="g"><param name="x" value="1"/></param>'
        '<param name="l" value="a;b" value-sep=";"/><param from="f.yaml"/><remap from="a" to="b"/></node>'
    )
    assert [entry.name for entry in found.parameters if isinstance(entry, ParameterValue)] == [("g.x",), ("l",)]
    assert [entry.value for entry in found.parameters if isinstance(entry, ParameterValue)][1] == [("a",), ("b",)]
    assert [entry.path for entry in found.parameters if isinstance(entry, ParameterFile)] == [("f.yaml",)]


def test_components_stand_in_their_container() -> None:
    """A container holds its components; those loaded into another one name it."""
    container, group = actions(
        '<node_container pkg="rclcpp_components" exec="component_container" name="c">'
        '<composable_node pkg="p" plugin="p::A" name="a"/></node_container>'
        '<load_composable_node target="c"><composable_node pkg="p" plugin="p::B"/></load_composable_node>'
    )
    assert isinstance(container, Node)
    assert [entry.plugin for entry in container.components] == [("p::A",)]
    assert isinstance(group, Group)
    assert [entry.target for entry in group.actions if isinstance(entry, Node)] == [("c",)]


def test_yaml_is_the_same_as_xml() -> None:
    """Both markups of ROS 2 give equal actions, lines apart."""
    xml = actions(
        '<arg name="a" default="1"/>\n<group><push_ros_namespace namespace="x"/>'
        '<node pkg="p" exec="e"><param name="n" value="v"/><remap from="f" to="t"/></node></group>'
        '<include file="f"><arg name="q" value="2"/></include>'
    )
    text = """
launch:
  - arg: {name: a, default: 1}
  - group:
      - push_ros_namespace: {namespace: x}
      - node:
          pkg: p
          exec: e
          param: [{name: n, value: v}]
          remap: [{from: f, to: t}]
  - include:
      file: f
      arg: [{name: q, value: 2}]
"""
    parsed = parse_launch_yaml(text.encode())
    assert parsed.facts is not None
    assert _shape(parsed.facts.actions) == _shape(xml)


def _shape(found: tuple[Action, ...]) -> list[object]:
    shapes: list[object] = []
    for action in found:
        match action:
            case Argument():
                shapes.append((action.name, action.default))
            case Group():
                shapes.append(_shape(action.actions))
            case Node():
                names = [entry.name for entry in action.parameters if isinstance(entry, ParameterValue)]
                shapes.append((action.package, action.executable, names, len(action.remaps)))
            case Include():
                shapes.append((action.path, action.arguments))
            case _:
                shapes.append(type(action).__name__)
    return shapes


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("<robot/>", "launch-wrong-root"),
        ('<launch><node pkg="p" name="n" type=""/></launch>', "launch-incomplete"),
        ('<launch><nodee pkg="p"/></launch>', "launch-unknown-element"),
        ("", "xml-empty"),
    ],
)
def test_what_is_wrong_is_told(text: str, code: str) -> None:
    """A launch file that does not do what it seems to is a diagnostic with a line."""
    assert code in [entry.code for entry in parse_launch_xml(text.encode()).diagnostics]


@pytest.mark.parametrize(
    "data",
    [
        b'<!DOCTYPE l [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><launch>&b;</launch>',
        b"<launch>" + b"<group>" * 10_000 + b"</group>" * 10_000 + b"</launch>",
        b'<launch><arg name="' + b"$(arg " * 50_000 + b'"/></launch>',
        b"\0" * 100_000,
    ],
)
def test_hostile_xml_costs_less_than_a_second(data: bytes) -> None:
    """Entities, nesting and open substitutions are bounded."""
    started = time.process_time()
    parse_launch_xml(data)
    assert time.process_time() - started < 1


def test_hostile_yaml_costs_less_than_a_second() -> None:
    """Aliases of aliases are not expanded."""
    bomb = "a: &a [x, x]\n" + "".join(
        f"{chr(98 + i)}: &{chr(98 + i)} [*{chr(97 + i)}, *{chr(97 + i)}]\n" for i in range(20)
    )
    started = time.process_time()
    parse_launch_yaml((bomb + "launch: *u\n").encode())
    parse_launch_yaml(b"launch: " + b"[" * 10_000)
    assert time.process_time() - started < 1


@settings(max_examples=50, deadline=None)
@given(st.text(alphabet="$()abc '\"<>/=\n", max_size=60))
def test_never_raises(text: str) -> None:
    """No text breaks the readers."""
    xml = f"<launch><node pkg='{text}'/></launch>".encode()
    yaml = f"launch:\n- node: {{pkg: {text}}}".encode()
    assert isinstance(parse_template(text), tuple)
    assert is_told(xml, parse_launch_xml(xml))
    assert is_told(yaml, parse_launch_yaml(yaml))
