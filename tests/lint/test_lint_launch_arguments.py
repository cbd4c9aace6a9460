"""Which arguments of launch files nobody declares, reads or gives (LNT056)."""

from __future__ import annotations

from pathlib import Path

import pytest
from lint_fixtures import lint
from workspaces import Workspace

FIND = {1: "$(find pkg)/launch/part.launch", 2: "$(find-pkg-share pkg)/launch/part.launch.xml"}
ROWS = [
    (1, "", '<param name="p" value="$(arg wrong)"/>', "", ["wrong"]),
    (1, "", '<arg name="a" default="1"/><param name="p" value="$(arg a)"/>', "", []),
    (1, "", '<group if="$(arg a)"/>', "", ["a"]),
    (1, "", '<rosparam subst_value="true">p: $(arg a)</rosparam>', "", ["a"]),
    (1, "", "<!-- $(arg a) -->", "", []),
    (1, '<arg name="a"/>', "", '<arg name="a" value="1"/>', []),
    (1, '<arg name="a"/>', "", "", []),
    (1, '<arg name="a"/><param name="p" value="$(arg a)"/>', "", "", ["a"]),
    (1, '<arg name="a"/><group if="$(optenv A 0)"><param name="p" value="$(arg a)"/></group>', "", "", ["a"]),
    (1, '<arg name="a" default="1"/>', "", '<arg name="b" value="1"/>', ["b"]),
    (2, '<arg name="a"/>', "", '<arg name="a" value="1"/>', []),
    (2, '<arg name="a"/>', "", "", ["a"]),
    (2, '<arg name="a"/>', '<arg name="a" default="1"/>', "", ["a"]),
    (2, '<arg name="a"/>', '<let name="a" value="1"/>', "", ["a"]),
    (2, '<group><arg name="a"/></group>', "", "", []),
    (2, '<arg name="a" default="1"/>', "", '<arg name="b" value="1"/>', ["b"]),
    (2, '<let name="c" value="$(var b)"/>', "", '<arg name="b" value="1"/>', []),
    (2, '<include file="$(find-pkg-share other)/x.launch.xml"/>', "", '<arg name="b" value="1"/>', []),
]


@pytest.mark.parametrize(("ros", "part", "outer", "given", "expected"), ROWS)
def test_arguments(workspace: Workspace, ros: int, part: str, outer: str, given: str, expected: list[str]) -> None:
    """A file of ROS 1 has its own arguments; in ROS 2 an include hands over what is declared without a default."""
    include = f'<include file="{FIND[ros]}">{given}</include>'
    ending = "launch" if ros == 1 else "launch.xml"
    files = {
        f"launch/all.{ending}": f"<launch>{outer}{include}</launch>",
        f"launch/part.{ending}": f"<launch>{part}</launch>",
    }
    workspace.package(files, ros=ros)
    assert _names(workspace.root) == expected


@pytest.mark.parametrize(
    ("ros", "part", "severity", "lines"),
    [
        (1, '<arg name="a"/>\n<param name="p" value="$(arg a)"/>', "error", [2, 2, 3]),
        (1, '<arg name="a"/>\n<param name="p" value="$(arg a)" if="$(optenv A 0)"/>', "warning", [2, 2, 3]),
        (2, '<arg name="a"/>', "error", [2, 2]),
    ],
)
def test_what_an_include_leaves_out(workspace: Workspace, ros: int, part: str, severity: str, lines: list[int]) -> None:
    """The include comes first, then the declaration, and in ROS 1 the line that stops roslaunch."""
    ending = "launch" if ros == 1 else "launch.xml"
    files = {
        f"launch/all.{ending}": f'<launch>\n<include file="{FIND[ros]}"/></launch>',
        f"launch/part.{ending}": f"<launch>\n{part}</launch>",
    }
    (found,) = [each for each in lint(workspace.package(files, ros=ros).root) if each.rule == "LNT056"]
    assert (found.severity, [place.line for place in found.evidence]) == (severity, lines)
    assert [place.path.rpartition("/")[2] for place in found.evidence[1:]] == [f"part.{ending}"] * (len(lines) - 1)
    assert "the launch stops there" in found.message


def test_names_in_comments_are_no_uses(workspace: Workspace) -> None:
    """A node that is commented out needs no package."""
    text = '<launch>\n<!-- <node pkg="away" exec="n"/> -->\n<node pkg="here" exec="n"/></launch>'
    found = lint(workspace.package({"launch/a.launch.xml": text}).root)
    assert [(each.evidence[0].line, "here" in each.message) for each in found if each.rule == "LNT004"] == [(3, True)]


@pytest.mark.parametrize(
    ("declared", "includer", "severity"),
    [
        ("", "", "info"),
        ('<arg name="bag_filenam"/>', "", "error"),
        ("", f'<launch><include file="{FIND[1]}"/></launch>', "error"),
    ],
    ids=["started by people", "a slip", "included"],
)
def test_who_could_give_what_is_not_declared(workspace: Workspace, declared: str, includer: str, severity: str) -> None:
    """A person can, on the command line; a file that includes it cannot."""
    part = f'<launch>{declared}<node pkg="rosbag" type="play" name="play" args="$(arg bag_filename)"/></launch>'
    files = {"launch/part.launch": part, **({"launch/all.launch": includer} if includer else {})}
    root = workspace.package(files, ros=1).root
    assert [each.severity for each in lint(root) if "bag_filename) is used" in each.message] == [severity]


def test_all_arguments_are_passed(workspace: Workspace) -> None:
    """A file that is included with all arguments of another one may use any of them."""
    include = f'<include file="{FIND[1]}" pass_all_args="true"/>'
    files = {
        "launch/all.launch": f'<launch><arg name="a" default="1"/>{include}</launch>',
        "launch/part.launch": '<launch><param name="p" value="$(arg a)"/></launch>',
    }
    assert _names(workspace.package(files, ros=1).root) == []


def test_a_parameter_file_reads_arguments(workspace: Workspace) -> None:
    """A file that is loaded with substitutions reads what the launch sets."""
    include = f'<include file="{FIND[2]}"><arg name="b" value="1"/></include>'
    load = '<node pkg="pkg" exec="n"><param from="$(find-pkg-share pkg)/n.yaml" allow_substs="true"/></node>'
    files = {
        "launch/all.launch.xml": f"<launch>{include}</launch>",
        "launch/part.launch.xml": f"<launch>{load}</launch>",
        "n.yaml": "n:\n  ros__parameters:\n    p: $(var b)\n",
    }
    assert _names(workspace.package(files).root) == []


@pytest.mark.parametrize(
    ("part", "severity"),
    [
        ('<node pkg="pkg" exec="n"/>', "info"),
        ('<arg name="rat" default="1"/><node pkg="pkg" exec="n"/>', "warning"),
        ('<node pkg="pkg" exec="n"><param name="rate" value="1"/></node>', "warning"),
    ],
    ids=["nothing like it", "a slip", "fixed there"],
)
def test_a_value_that_nothing_reads(workspace: Workspace, part: str, severity: str) -> None:
    """It is likely meant for something where the file has that name, or nearly."""
    include = f'<include file="{FIND[2]}"><arg name="rate" value="1"/></include>'
    files = {
        "launch/all.launch.xml": f"<launch>{include}</launch>",
        "launch/part.launch.xml": f"<launch>{part}</launch>",
    }
    found = [each for each in lint(workspace.package(files).root) if each.rule == "LNT056"]
    assert [each.severity for each in found] == [severity]


def _names(root: Path) -> list[str]:
    found = [finding for finding in lint(root) if finding.rule == "LNT056"]
    return [next(word for word in ("wrong", "a", "b") if f" {word}" in f" {f.message.split(':')[0]}") for f in found]
