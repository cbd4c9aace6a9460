"""Which value a parameter has, by the route on which it arrives."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from ecm_extract.read.reader import Reader
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import Files
from ecm_extract.system.model import Given
from ecm_extract.system.package_folders import folders_read
from ecm_extract.tree import open_tree

MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version></package>"
HEAD = (
    "import os\nfrom typing import List\n"
    "def generate_launch_description():\n"
    "    yes = LaunchConfiguration('yes', default='true')\n"
    "    return LaunchDescription([DeclareLaunchArgument('yes', default_value='true'), OpaqueFunction(function=make)])\n"
    "def make(context):\n"
    "    yes = LaunchConfiguration('yes')\n"
    "    return [Node(package='p', executable='e', name='n', {})]\n"
)


def given(folder: Path, name: str, text: str, more: dict[str, str] | None = None) -> dict[str, Any]:
    """Values of the parameters of the first node, and of ROS 1 parameters outside of nodes, by their last names."""
    for path, content in {"package.xml": MANIFEST, name: text, **(more or {})}.items():
        (folder / path).write_text(content)
    tree = open_tree(str(folder))
    found = launched(tree, Files(tree, folders_read(Reader(tree).read(1))), [name], Given({}, {"ONE": "1"}))
    settings = [*found.globals, *(entry for node in found.instances[:1] for entry in node.settings)]
    return {entry.name.rpartition("/")[2]: entry.value for entry in settings}


def typed(values: dict[str, Any]) -> dict[str, tuple[type, Any]]:
    """Each value with its type: 1, 1.0 and true are equal in Python."""
    return {name: (type(value), value) for name, value in values.items()}


PYTHON = {
    "'false'": "false",
    "'1.5'": "1.5",
    "False": False,
    "3": 3,
    "yes": True,
    "[yes]": True,
    "['is_', yes]": "is_true",
    "TextSubstitution(text='5')": 5,
    "yes.perform(context)": "true",
    "os.environ['ONE']": "1",
    "os.environ.get('TWO', '2')": "2",
    "os.getenv('ONE')": "1",
    "EnvironmentVariable('ONE')": 1,
    "f'{yes.perform(context)}'": "true",
    "str(7)": "7",
    "['1', '2']": ["1", "2"],
    "[1, 2.5]": [1.0, 2.5],
    "[True, False]": [True, False],
    "[[yes], [TextSubstitution(text='no')]]": [True, False],
    "ParameterValue('false')": "false",
    "ParameterValue(yes)": True,
    "ParameterValue(yes, value_type=str)": "true",
    "ParameterValue(TextSubstitution(text='1'), value_type=bool)": True,
    "ParameterValue(TextSubstitution(text='1'), value_type=float)": 1.0,
    "TextSubstitution(text='1e5')": "1e5",
    "TextSubstitution(text='[1, 2]')": [1, 2],
    "TextSubstitution(text='\"1\"')": "1",
}


@pytest.mark.parametrize(("written", "expected"), PYTHON.items())
def test_map_of_python(written: str, expected: Any, tmp_path: Path) -> None:
    """A `str` of Python stays text; what a substitution gives is YAML, unless the value has a type of its own."""
    text = HEAD.format(f"parameters=[{{'x': {written}}}]")
    assert typed(given(tmp_path, "a.launch.py", text)) == typed({"x": expected})


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [
        ('value="false"', False),
        ("value=\"'false'\"", "false"),
        ('value="1e5"', "1e5"),
        ('value="1.0"', 1.0),
        ('value="yes"', True),
        ('value="$(env ONE)"', 1),
        ('value="[1, 2]"', [1, 2]),
        ('value="1" type="str"', "1"),
        ('value="1" type="float"', 1.0),
        ('value="1" type="bool"', True),
        ('value="1;2" value-sep=";"', [1, 2]),
    ],
)
def test_markup_of_ros2(attributes: str, expected: Any, tmp_path: Path) -> None:
    """A text of XML is read as YAML, unless it has a type."""
    text = f'<launch><node pkg="p" exec="e" name="n"><param name="x" {attributes}/></node></launch>'
    assert typed(given(tmp_path, "a.launch.xml", text)) == typed({"x": expected})


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("'false'", "false"),
        ("false", False),
        ("'$(env ONE)'", 1),
        ("1.5", 1.5),
        ("1e5", "1e5"),
        ("[1, 2]", [1, 2]),
        ("['1']", ["1"]),
    ],
)
def test_launch_file_in_yaml(written: str, expected: Any, tmp_path: Path) -> None:
    """What YAML has typed keeps its type; a text with a substitution is read anew."""
    text = f"launch:\n- node: {{pkg: p, exec: e, name: n, param: [{{name: x, value: {written}}}]}}\n"
    assert typed(given(tmp_path, "a.launch.yaml", text)) == typed({"x": expected})


@pytest.mark.parametrize(
    ("written", "expected"),
    [("'1'", "1"), ("1", 1), ("1e5", 100000.0), ("yes", True), ("$(env ONE)", "$(env ONE)"), (".inf", math.inf)],
)
def test_parameter_file_of_ros2(written: str, expected: Any, tmp_path: Path) -> None:
    """rcl reads a parameter file; substitutions in it are text, unless they are allowed."""
    text = HEAD.format("parameters=[os.path.join(get_package_share_directory('p'), 'c.yaml')]")
    config = f"n:\n  ros__parameters:\n    x: {written}\n"
    assert typed(given(tmp_path, "a.launch.py", text, {"c.yaml": config})) == typed({"x": expected})


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("ParameterFile(f, allow_substs=True)", 1),
        ("RewrittenYaml(source_file=f, param_rewrites={'x': '7'})", "7"),
        ("RewrittenYaml(source_file=f, param_rewrites={'x': 'True'})", True),
        ("RewrittenYaml(source_file=f, param_rewrites={'x': '7'}, convert_types=True)", 7),
    ],
)
def test_parameter_file_that_is_changed(call: str, expected: Any, tmp_path: Path) -> None:
    """Substitutions are replaced where they are allowed, replacements are numbers where types are converted."""
    path = "os.path.join(get_package_share_directory('p'), 'c.yaml')"
    text = HEAD.format(f"parameters=[{call.replace('=f', '=' + path).replace('(f', '(' + path)}]")
    config = "n:\n  ros__parameters:\n    x: $(env ONE)\n"
    assert typed(given(tmp_path, "a.launch.py", text, {"c.yaml": config})) == typed({"x": expected})


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("arguments=['--ros-args', '-p', 'x:=1e5']", 100000.0),
        ("arguments=['--ros-args', '--param', 'x:=\"1\"']", "1"),
        ("ros_arguments=['-p', 'n:x:=[1, 2]']", [1, 2]),
        ("arguments=['--ros-args', '-p', 'x:=1'], parameters=[{'x': 2}]", 2),
    ],
)
def test_command_line_of_ros2(words: str, expected: Any, tmp_path: Path) -> None:
    """rcl reads what stands on the command line; what the launch sets comes later and wins."""
    assert typed(given(tmp_path, "a.launch.py", HEAD.format(words))) == typed({"x": expected})


def test_words_that_are_not_for_ros_set_nothing(tmp_path: Path) -> None:
    """Before `--ros-args` and after `--` a program reads its own options."""
    words = "arguments=['-p', 'x:=1', '--ros-args', '--', '-p', 'x:=2']"
    assert given(tmp_path, "a.launch.py", HEAD.format(words)) == {}


@pytest.mark.parametrize(
    ("element", "expected"),
    [
        ('<param name="x" value="1"/>', 1),
        ('<param name="x" value="1."/>', 1.0),
        ('<param name="x" value="1e5"/>', "1e5"),
        ('<param name="x" value="1_0"/>', "1_0"),
        ('<param name="x" value="True"/>', True),
        ('<param name="x" value="yes"/>', "yes"),
        ('<param name="x" value="1" type="str"/>', "1"),
        ('<param name="x" value="1" type="string"/>', "1"),
        ('<param name="x" value=" " type="string"/>', ""),
        ('<param name="x" value=" a b " type="str"/>', "a b"),
        ('<param name="x" value="1" type="double"/>', 1.0),
        ('<param name="x" value="1" type="bool"/>', True),
        ('<param name="x" value="[1, yes]" type="yaml"/>', [1, True]),
        ('<rosparam param="x">1e5</rosparam>', "1e5"),
        ("<rosparam>x: '1'</rosparam>", "1"),
        ("<rosparam>x: $(env ONE)</rosparam>", "$(env ONE)"),
        ('<rosparam subst_value="true">x: $(env ONE)</rosparam>', 1),
        ('<rosparam file="$(find p)/c.yaml"/>', "$(env ONE)"),
        ('<rosparam file="$(find p)/c.yaml" subst_value="true"/>', 1),
        ('<node pkg="p" type="e" name="n" args="_x:=2"/>', 2),
        ('<node pkg="p" type="e" name="n"><param name="x" value="a"/></node>', "a"),
    ],
)
def test_ros1(element: str, expected: Any, tmp_path: Path) -> None:
    """roslaunch converts by a rule of its own, rosparam reads YAML."""
    manifest = MANIFEST.replace("'3'", "'2'").replace(
        "</package>", "<buildtool_depend>catkin</buildtool_depend></package>"
    )
    files = {"c.yaml": "x: $(env ONE)\n", "package.xml": manifest}
    assert typed(given(tmp_path, "a.launch", f"<launch>{element}</launch>", files)) == typed({"x": expected})
