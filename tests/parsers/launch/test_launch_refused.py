"""Values of launch files that the launch refuses, and what files in Python do that cannot be meant."""

from __future__ import annotations

import pytest
from ecm_parsers.launch.files import refused_xml_1, refused_xml_2, refused_yaml
from ecm_parsers.launch.python import parse_launch_python

ONE = [
    ("$(arg a)/$(env HOME) $(optenv X a b) $(dirname)", ""),
    ("$(eval arg('a') + '/' + find('p'))", ""),
    ("costs $5 ($a)", ""),
    ("$(find $(arg p))/a", "inside a substitution"),
    ("$(eval arg('a'))/b", "only as the whole value"),
    ("$(eval $(arg a) == 1)", "no substitutions inside `eval`"),
    ("$(eval '$(arg a)' == 'b')", ""),
    ("$(name)", "no substitution of roslaunch"),
    ("$(arg a", "never closed"),
    ("$(arg a b)", "2 values"),
    ("$(env)", "no values"),
]
TWO = [
    ("$(find-pkg-share $(var p))/a $(env HOME /root)", ""),
    (r"$(eval '\'$(var a)\' == \'(b\'')", ""),
    (r"\$(var a and $5", ""),
    ("$(own-substitution x)", ""),
    ("$(var a", "never closed"),
    ("$(find p)/a", "no substitution of ROS 2"),
    ("$(find-pkg-share $(arg p))", "no substitution of ROS 2"),
    ("$( var a)", "no name"),
    ("$(var)", "no value"),
]


@pytest.mark.parametrize(("text", "wrong"), ONE)
def test_roslaunch(text: str, wrong: str) -> None:
    """It takes no substitution inside another one, and `eval` as a whole value only."""
    found = refused_xml_1(f'<launch><arg name="a" default="{text}"/></launch>'.encode())
    assert [wrong in each.wrong for each in found] == [True] * bool(wrong)


@pytest.mark.parametrize(("text", "wrong"), TWO)
def test_ros_2(text: str, wrong: str) -> None:
    """Its grammar nests; names may come from an extension, those of ROS 1 do not."""
    found = refused_xml_2(f'<launch><let name="a" value="{text}"/></launch>'.encode())
    assert [wrong in each.wrong for each in found] == [True] * bool(wrong)


def test_yaml() -> None:
    """Launch files in YAML have the same substitutions."""
    assert refused_yaml(b"launch:\n- let:\n    name: a\n    value: $(var b\n")[0].line in {2, 3, 4}


def test_conditions() -> None:
    """A condition is true, false, 1 or 0, and there is one; what is switched off as written is never read."""
    text = b"""<launch>
  <group if="yes"/>
  <group if="1" unless="0"/>
  <group if="false"><param name="a" value="$(b)"/></group>
  <group if="$(arg c)"><param name="a" value="$(b)"/></group>
</launch>"""
    assert [(each.line, each.is_sure) for each in refused_xml_1(text)] == [(2, True), (3, True), (5, False)]


def problems(body: str, before: str = "") -> list[str]:
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    text = f"{before}\ndef generate_launch_description():\n{lines}    return LaunchDescription([])\n"
    return [each.code for each in parse_launch_python(text.encode()).diagnostics]


@pytest.mark.parametrize(
    "body",
    [
        "if LaunchConfiguration('a'): pass",
        "x = 1 if not LaunchConfiguration('a') else 2",
        "x = LaunchConfiguration('a') == 'b'",
        "x = LaunchConfiguration('a').perform(None) == True",
        "x = LaunchConfiguration('a') or 'b'",
    ],
)
def test_objects(body: str) -> None:
    """A configuration is an object: it always holds and equals no text."""
    assert problems(body) == ["launch-object-tested"]


@pytest.mark.parametrize(
    "body",
    [
        "x = LaunchConfiguration('a').perform(None) == 'b'",
        "x = LaunchConfiguration('a') is None",
        "x = IfCondition(LaunchConfiguration('a'))",
        "if load(LaunchConfiguration('a')): pass",
        "x = LaunchConfiguration('a') == unknown()",
        "if yaml.safe_load(LaunchConfiguration('a').perform(None)): pass",
    ],
)
def test_values(body: str) -> None:
    """Its text, and what is made of that, are values."""
    assert problems(body) == []


@pytest.mark.parametrize(
    ("body", "codes"),
    [
        ("a = Node(package='p', executable='x')\na = Node(package='p', executable='y')\nuse(a)", ["replaced"]),
        ("a = Node(package='p', executable='x')\na = Node(package='p', executable='x')\nuse(a)", []),
        ("a = Node(package='p', executable='x')\na = [a, Node(package='p', executable='y')]\nuse(a)", []),
        ("a = Node(package='p', executable='x')\nif b:\n    a = Node(package='p', executable='y')\nuse(a)", []),
        (
            "if b:\n    a = Node(package='p', executable='x')\nelse:\n    a = Node(package='q', executable='x')\nuse(a)",
            [],
        ),
        ("for i in [1, 2]:\n    a = Node(package='p', executable=str(i))\n    use(a)", []),
        ("a = Node(package='p', executable='x')", ["unused"]),
        ("a = Node(package='p', executable='x')\nuse(lambda: a)", []),
        ("a = 1\na = 2", []),
    ],
)
def test_lost(body: str, codes: list[str]) -> None:
    """An action is lost where its variable is bound anew, on the same path, before anything takes it."""
    assert problems(body) == [f"launch-action-{code}" for code in codes]
