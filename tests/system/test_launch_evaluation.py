"""Launch files evaluated over a tree: names, remaps, parameters, conditions, includes."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from ecm_extract.read.reader import Reader
from ecm_extract.system.evaluate import launched
from ecm_extract.system.files import Files
from ecm_extract.system.model import Given, Launched
from ecm_extract.system.package_folders import folders_read
from ecm_extract.tree import open_tree

MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version></package>"
NODE = '<node pkg="p" exec="e" name="{}"/>'


def launch(folder: Path, files: dict[str, str], given: Given | None = None) -> Launched:
    return evaluated(folder, files, given or Given())[0]


def codes(folder: Path, files: dict[str, str]) -> list[str]:
    return evaluated(folder, files, Given())[1]


def evaluated(folder: Path, files: dict[str, str], given: Given) -> tuple[Launched, list[str]]:
    for name, text in {"package.xml": MANIFEST, **files}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    tree = open_tree(str(folder))
    packages = Reader(tree).read(1)
    return launched(tree, Files(tree, folders_read(packages)), [next(iter(files))], given), [
        entry.code for entry in tree.diagnostics
    ]


def names(found: Launched) -> list[str | None]:
    return [instance.full_name for instance in found.instances]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            '<group><push_ros_namespace namespace="a"/><node pkg="p" exec="e" name="n"/></group>' + NODE.format("m"),
            ["/a/n", "/m"],
        ),
        ('<node pkg="p" exec="e" name="n" namespace="/b"/>', ["/b/n"]),
        ('<arg name="x" default="true"/><node pkg="p" exec="e" name="n" if="$(var x)"/>', ["/n"]),
        ('<arg name="x" default="true"/><node pkg="p" exec="e" name="n" unless="$(var x)"/>', []),
        ('<arg name="x" default="2"/><node pkg="p" exec="e" name="n" if="$(eval \'$(var x) > 1\')"/>', ["/n"]),
        ('<let name="x" value="q"/><node pkg="p" exec="e" name="$(var x)"/>', ["/q"]),
        ('<group scoped="false"><let name="x" value="q"/></group><node pkg="p" exec="e" name="$(var x)"/>', ["/q"]),
        ('<arg name="x"/><node pkg="p" exec="e" name="n_$(var x)"/>', ["/n_{x}"]),
        ('<node pkg="p" exec="e" name="$(env HOME_OF)"/>', ["/{env HOME_OF}"]),
    ],
)
def test_names(body: str, expected: list[str], tmp_path: Path) -> None:
    """Namespaces, conditions and substitutions decide what is started under which name."""
    assert names(launch(tmp_path, {"launch/a.launch.xml": f"<launch>{body}</launch>"})) == expected


def test_given_arguments_win(tmp_path: Path) -> None:
    """What a person gives overrides the default; the environment is what a person says."""
    text = '<launch><arg name="x" default="a"/><node pkg="p" exec="e" name="$(var x)_$(env Y z)"/></launch>'
    assert names(launch(tmp_path, {"a.launch.xml": text}, Given({"x": "b"}, {"Y": "c"}))) == ["/b_c"]


def test_unknown_condition_is_taken_and_said(tmp_path: Path) -> None:
    """Without a value the node may run, so it is shown with its condition."""
    text = '<launch><arg name="x"/><node pkg="p" exec="e" name="n" if="$(var x)"/></launch>'
    (instance,) = launch(tmp_path, {"a.launch.xml": text}).instances
    assert instance.conditional == "x"


@pytest.mark.parametrize(
    ("condition", "shown"),
    [
        ('if="$(env A)"', "env A"),
        ('unless="$(env A)"', "not (env A)"),
        ('if="$(equals $(env A) 1)"', "env A == 1"),
        ('if="$(not $(equals $(env A) 1))"', "not (env A == 1)"),
        ('if="$(and $(env A) $(env B))"', "env A and env B"),
        ('if="$(or $(env A) true)"', ""),
    ],
)
def test_condition_is_shown_as_a_person_would_say_it(condition: str, shown: str, tmp_path: Path) -> None:
    """What decides is named, however deep it stands."""
    text = f'<launch><node pkg="p" exec="e" name="n" {condition}/></launch>'
    (instance,) = launch(tmp_path, {"a.launch.xml": text}).instances
    assert instance.conditional == shown


@pytest.mark.parametrize(
    ("expression", "name"),
    [
        ("optenv('X', 'a') + 'b'", "/ab"),
        ("optenv('X') + 'b'", "/b"),
        ("env('Y') + 'b'", "/yb"),
        ("arg('z')", "/w"),
        ("env(z.upper()[:0] + 'Y')", "/y"),
        ("optenv('X', arg('z'))", "/w"),
        ("optenv('X', find('p')).split(':')[0]", "/tree"),
    ],
)
def test_calls_in_expressions_of_ros1(expression: str, name: str, tmp_path: Path) -> None:
    """`$(eval)` of roslaunch asks for arguments and the environment, with defaults."""
    text = f'<launch><arg name="z" default="w"/><node pkg="p" type="e" name="$(eval {expression})"/></launch>'
    assert names(launch(tmp_path, {"a.launch": text}, Given({}, {"Y": "y"}))) == [name]


def test_include_passes_arguments(tmp_path: Path) -> None:
    """In ROS 2 an included file sees what it is given, and what it sets is seen after it."""
    outer = (
        '<launch><include file="$(find-pkg-share p)/launch/b.launch.xml"><arg name="x" value="1"/></include>'
        '<node pkg="p" exec="e" name="after_$(var x)"/></launch>'
    )
    inner = '<launch><arg name="x" default="0"/><node pkg="p" exec="e" name="in_$(var x)"/></launch>'
    found = launch(tmp_path, {"launch/a.launch.xml": outer, "launch/b.launch.xml": inner})
    assert names(found) == ["/in_1", "/after_1"]


def test_python_file_follows_what_it_imports(tmp_path: Path) -> None:
    """Modules are found in the package, beside the launch file and by path; what nobody can read is said."""
    build = "from launch_ros.actions import Node\ndef made(name):\n    return Node(package='p', executable='e', name=name)\n"
    text = (
        "from p.parts import made as first\nfrom beside import made as second\nfrom nowhere import made as fourth\n"
        "lib = load_python_launch_file_as_module(os.path.join(get_package_share_directory('p'), 'launch/lib/by_path.py'))\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([first('a'), second('b'), lib.made('c'), fourth('d')])\n"
    )
    tree = {"launch/a.launch.py": text, "p/parts.py": build, "launch/beside.py": build, "launch/lib/by_path.py": build}
    found, diagnostics = evaluated(tmp_path, tree, Given())
    assert names(found) == ["/a", "/b", "/c"]
    assert {instance.place for instance in found.instances} == {("launch/a.launch.py", 6)}
    assert diagnostics == ["launch-action-unread"]


def test_what_an_event_starts_is_outside_of_groups(tmp_path: Path) -> None:
    """A pushed namespace is popped again before a handler or timer takes its actions."""
    text = (
        "from launch_ros.actions import Node\n"
        "def made(name):\n"
        "    return Node(package='p', executable='e', name=name)\n"
        "def generate_launch_description():\n"
        "    later = RegisterEventHandler(OnProcessExit(target_action=None, on_exit=[made('b')]))\n"
        "    timed = TimerAction(period=1.0, actions=[made('c')])\n"
        "    group = GroupAction([PushRosNamespace('g'), made('a'), later, timed])\n"
        "    return LaunchDescription([PushRosNamespace('o'), group, later])\n"
    )
    assert names(launch(tmp_path, {"launch/a.launch.py": text})) == ["/o/g/a", "/o/b", "/o/c", "/o/b"]


def test_ros1_include_sees_only_what_it_is_given(tmp_path: Path) -> None:
    """In ROS 1 the arguments of the outer file are not those of the inner one."""
    outer = '<launch><arg name="x" default="1"/><include file="$(find p)/b.launch" ns="deep"><arg name="y" value="2"/></include></launch>'
    inner = (
        '<launch><arg name="x" default="0"/><arg name="y"/><node pkg="p" type="t" name="n_$(arg x)_$(arg y)"/></launch>'
    )
    assert names(launch(tmp_path, {"a.launch": outer, "b.launch": inner})) == ["/deep/n_0_2"]


def test_include_that_the_launch_decides_branches(tmp_path: Path) -> None:
    """Every file that it can be is taken, each under its condition."""
    outer = '<launch><include file="$(find p)/robot_$(env MODEL).launch"/></launch>'
    inner = '<launch><node pkg="p" type="t" name="{}"/></launch>'
    files = {"a.launch": outer, "robot_x.launch": inner.format("x"), "robot_y.launch": inner.format("y")}
    found = launch(tmp_path, files)
    assert names(found) == ["/x", "/y"]
    assert all(instance.conditional for instance in found.instances)


def test_parameter_files_reach_their_nodes(tmp_path: Path) -> None:
    """Values come with the line of the file, rewrites replace them, substitutions in them are evaluated."""
    text = (
        "from launch import LaunchDescription\n"
        "def generate_launch_description():\n"
        "    f = os.path.join(get_package_share_directory('p'), 'c.yaml')\n"
        "    r = RewrittenYaml(source_file=f, root_key='', param_rewrites={'rate': '7'}, convert_types=True)\n"
        "    return LaunchDescription([Node(package='p', executable='e', name='n', parameters=[ParameterFile(r, allow_substs=True), {'z': 'y'}])])\n"
    )
    config = "n:\n  ros__parameters:\n    rate: 5\n    topic: $(env HOST h)/scan\n"
    (instance,) = launch(tmp_path, {"a.launch.py": text, "c.yaml": config}).instances
    values = {entry.name: (entry.value, entry.place.path, entry.place.line) for entry in instance.settings}
    assert values == {"rate": (7, "c.yaml", 3), "topic": ("h/scan", "c.yaml", 4), "z": ("y", "a.launch.py", 5)}


def test_ros1_parameters_have_absolute_names(tmp_path: Path) -> None:
    """Private ones stand below their node, others below the namespace."""
    text = (
        '<launch><param name="a" value="1"/><group ns="g"><rosparam>b: {c: 2}</rosparam>'
        '<node pkg="p" type="t" name="n"><param name="d" value="3"/><param name="/e" value="4"/></node></group></launch>'
    )
    found = launch(tmp_path, {"a.launch": text})
    assert [(entry.name, entry.value) for entry in found.globals] == [("/a", 1), ("/g/b/c", 2)]
    assert [(entry.name, entry.value) for entry in found.instances[0].settings] == [("/g/n/d", 3), ("/g/n/e", 4)]


@pytest.mark.parametrize(
    ("files", "code"),
    [
        ({"a.launch": '<launch><include file="$(find p)/a.launch"/></launch>'}, "launch-cycle"),
        ({"a.launch": '<launch><include file="$(find p)/no.launch"/></launch>'}, "launch-include-missing"),
        ({"a.launch": '<launch><include file="$(find q)/no.launch"/></launch>'}, "launch-include-outside"),
        ({"a.launch": '<launch><include file="/etc/ros/robot.launch"/></launch>'}, "launch-include-outside"),
        (
            {"a.launch": '<launch><include file="$(find p)/b.launch"/></launch>', "b.launch.in": "<launch/>"},
            "launch-include-outside",
        ),
        (
            {"a.launch": '<launch><include file="./b.launch"/></launch>', "b.launch": "<launch/>"},
            "launch-include-relative",
        ),
        (
            {
                "a.launch.xml": '<launch><node pkg="p" exec="e"><param from="$(find-pkg-share p)/no.yaml"/></node></launch>'
            },
            "launch-file-missing",
        ),
    ],
)
def test_what_is_missing_is_told_at_once(files: dict[str, str], code: str, tmp_path: Path) -> None:
    """Cycles end, files that are not there are named."""
    started = time.process_time()
    assert code in codes(tmp_path, files)
    assert time.process_time() - started < 1


def test_exponential_includes_end(tmp_path: Path) -> None:
    """A file that includes the next one twice is bounded."""
    files = {
        f"f{at}.launch": "<launch>" + f'<include file="$(find p)/f{at + 1}.launch"/>' * 2 + "</launch>"
        for at in range(20)
    }
    started = time.process_time()
    assert "launch-too-large" in codes(tmp_path, files)
    assert time.process_time() - started < 1
