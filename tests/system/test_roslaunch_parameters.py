"""Parameters of ROS 1 launch files as roslaunch's own loader sets them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from ecm_extract.read.reader import Reader
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import Files
from ecm_extract.system.model import Given, Launched
from ecm_extract.system.package_folders import folders_read
from ecm_extract.tree import open_tree

NODE = '<node pkg="p" type="t" name="n"/>'
INNER = '<launch><arg name="mode" default="plain"/><param name="mode" value="$(arg mode)"/></launch>'
CHOICE = '<arg name="mode" value="fake" {}="true"/><arg name="mode" value="real" {}="true"/>'


def started(folder: Path, body: str) -> Launched:
    """What a launch file starts."""
    files = {
        "package.xml": "<package format='2'><name>p</name><version>1.0.0</version><buildtool_depend>catkin</buildtool_depend></package>",
        "a.launch": f"<launch>{body}</launch>",
        "inner.launch": INNER,
        "list.yaml": "[x, y]",
        "nested.yaml": "g:\n  /own: {p: 1}\n  rel: 2\n  none: {}\n",
        "ros2.yaml": "n:\n  ros__parameters:\n    rate: 5\n",
        "open.yaml": "kind: $(arg mode)\nitems:\n  - {kind: $(arg mode), n: $(arg n)}\n$(arg mode): 1\n",
    }
    for name, text in files.items():
        (folder / name).write_text(text)
    tree = open_tree(str(folder))
    return launched(tree, Files(tree, folders_read(Reader(tree, cached=False).read(1))), ["a.launch"], Given())


def parameters(folder: Path, body: str) -> dict[str, Any]:
    """What a launch file sets, by name."""
    found = started(folder, body)
    settings = [*found.globals, *(each for instance in found.instances for each in instance.settings)]
    return {each.name: each.value for each in settings}


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (f'<include file="$(find p)/inner.launch">{CHOICE.format("unless", "if")}</include>', {"/mode": "real"}),
        (f'<include file="$(find p)/inner.launch">{CHOICE.format("if", "unless")}</include>', {"/mode": "fake"}),
        (
            '<arg name="w" default="b"/><param name="d" textfile="$(find p)/$(arg w).srdf"/>',
            {"/d": "{content of tree:/b.srdf}"},
        ),
        ("<rosparam>\n  </rosparam>", {}),
        ('<node pkg="p" type="t" name="n"><rosparam param="~a">[x]</rosparam></node>', {"/roslaunch/a": ["x"]}),
        ('<node pkg="p" type="t" name="n"><rosparam param="a">[x]</rosparam></node>', {"/n/a": ["x"]}),
        (f'<rosparam param="~a">[x]</rosparam>{NODE}', {"/roslaunch/a": ["x"]}),
        ('<rosparam ns="~" file="$(find p)/ros2.yaml"/>', {"/roslaunch/n/ros__parameters/rate": 5}),
        ('<rosparam ns="s" param="/a">[x]</rosparam>', {"/a": ["x"]}),
        (
            '<rosparam subst_value="true">\na: $(env HOME)/x\nb: {c: 1, d: "$(env HOME)"}\n</rosparam>',
            {"/a": "{env HOME}/x", "/b/c": 1, "/b/d": "{env HOME}"},
        ),
        ('<rosparam file="$(find p)/list.yaml" ns="labels"/>', {"/labels": ["x", "y"]}),
        ('<rosparam file="$(find p)/nested.yaml"/>', {"/own/p": 1, "/g/rel": 2}),
        ('<rosparam file="$(find p)/nested.yaml" ns="q"/>', {"/own/p": 1, "/q/g/rel": 2}),
        ("<rosparam>{a: {}, b: {/c: 1}}</rosparam>", {"/c": 1}),
        ('<rosparam file="$(find p)/ros2.yaml"/>', {"/n/ros__parameters/rate": 5}),
        (
            '<arg name="mode" default="fake"/><arg name="n" default="3"/><rosparam file="$(find p)/open.yaml" subst_value="true"/>',
            {"/kind": "fake", "/items": [{"kind": "fake", "n": 3}], "/fake": 1},
        ),
        (
            '<arg name="mode"/><arg name="n" default="3"/><rosparam file="$(find p)/open.yaml" subst_value="true"/>',
            {"/kind": "{mode}", "/items": [{"kind": "{mode}", "n": 3}], "/{mode}": 1},
        ),
        (
            '<env name="SIDE" value="left"/><param name="side" value="$(optenv SIDE right)"/>',
            {"/side": "right"},
        ),
        (
            '<arg name="map"/><arg name="e"/><param name="a" value="$(eval map == 1)"/><param name="b" value="$(eval e * 2)"/>',
            {"/a": "{map == 1}", "/b": "{e * 2}"},
        ),
        (f'<param name="~rate" value="5"/>{NODE}', {"/n/rate": 5}),
        (
            f'<group ns="g"><param name="~rate" value="5"/>{NODE}</group><node pkg="p" type="t" name="m"/>',
            {"/g/n/rate": 5},
        ),
        (f'{NODE}<param name="~rate" value="5"/>', {}),
        ('<node pkg="p" type="t" name="n"><param name="a" value="1"/><rosparam>a: 2</rosparam></node>', {"/n/a": 1}),
        (
            '<param name="~a" value="1"/><node pkg="p" type="t" name="n"><rosparam>{a: 2, b: 3}</rosparam></node>',
            {"/n/a": 1, "/n/b": 3},
        ),
        (
            '<param name="~a" value="1"/><node pkg="p" type="t" name="n"><param name="a" value="2"/></node>',
            {"/n/a": 2},
        ),
        ('<test test-name="check" pkg="p" type="t"><param name="limit" value="2"/></test>', {"/check/limit": 2}),
        (
            '<test test-name="check" name="node" ns="g" pkg="p" type="t"><rosparam>a: 1</rosparam></test>',
            {"/g/node/a": 1},
        ),
        ('<test test-name="check" pkg="p" type="t"/>', {}),
        ("<rosparam>\n<!-- first -->\na: 1\n<!-- of\n two -->\nb: 2</rosparam>", {"/a": 1, "/b": 2}),
    ],
)
def test_what_roslaunch_sets(body: str, expected: dict[str, Any], tmp_path: Path) -> None:
    """Arguments have conditions, `~` is every later node's, YAML of a node comes first, tests have parameters, comments part no text."""
    assert parameters(tmp_path, body) == expected


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("!degrees 90", math.pi / 2),
        ("!radians pi/2", math.pi / 2),
        ("deg(180)", math.pi),
        ("rad(2*pi)", 2 * math.pi),
        ("'deg(180)'", "deg(180)"),
        ("degrees", "degrees"),
        ("deg(robot)", "deg(robot)"),
    ],
)
def test_angles_are_radians(text: str, value: object, tmp_path: Path) -> None:
    """rosparam turns angles into numbers, unless they are quoted or none."""
    found = parameters(tmp_path, f"<rosparam>a: {text}</rosparam>")["/a"]
    assert found == pytest.approx(value) if isinstance(value, float) else found == value


def test_degrees_have_the_last_digit_of_rosparam(tmp_path: Path) -> None:
    """The order of a product and a quotient decides it."""
    assert parameters(tmp_path, "<rosparam>a: deg(145)</rosparam>")["/a"] == 145 * math.pi / 180.0


REMAPS = [
    ('<remap from="a" to="b" if="false"/>', {}),
    ('<remap from="a" to="b" if="true"/><remap from="a" to="c" unless="true"/>', {"a": "b"}),
    ('<remap from="a" to="b"/><remap from="a" to="c"/>', {"a": "c"}),
]


@pytest.mark.parametrize(("body", "expected"), REMAPS)
def test_remaps_in_force(body: str, expected: dict[str, str], tmp_path: Path) -> None:
    """A remap of a node may have a condition, and the last one of a name is in force."""
    (instance,) = started(tmp_path, f'<node pkg="p" type="t" name="n">{body}</node>').instances
    assert [(entry.source, entry.target) for entry in instance.remaps] == list(expected.items())


def test_a_remap_of_the_node_replaces_that_of_the_group(tmp_path: Path) -> None:
    """roslaunch keeps one remap for each name."""
    node = '<node pkg="p" type="t" name="n"><remap from="a" to="own"/></node>'
    (instance,) = started(tmp_path, f'<remap from="a" to="outer"/><remap from="z" to="y"/>{node}').instances
    assert [(entry.source, entry.target) for entry in instance.remaps] == [("z", "y"), ("a", "own")]
