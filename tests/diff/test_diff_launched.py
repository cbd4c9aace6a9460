"""Nodes that a launch file started and does not start any more."""

from __future__ import annotations

import pytest
from diff_repos import package

Files = dict[str, str | None]
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
ARM = '<node pkg="arm" type="arm" name="arm"/>'
LEG = '<node pkg="leg" type="leg" name="leg"/>'
INCLUDED = '<include file="$(find arm)/launch/legs.launch"/>'
FOREIGN = '<include file="$(find legs)/launch/legs.launch"/>'


def _launch(*lines: str, name: str = "all") -> Files:
    return {f"arm/launch/{name}.launch": "\n".join(("<launch>", *lines, "</launch>")) + "\n"}


GONE = {
    "taken out": (_launch(ARM, LEG), _launch(ARM)),
    "its include is taken out": (
        {**_launch(ARM, LEG), **_launch(LEG, name="legs")},
        {**_launch(ARM), **_launch(LEG, name="legs")},
    ),
    "beside a file of another package that was there before": (
        _launch(ARM, LEG, '<include file="$(find other)/launch/a.launch"/>'),
        _launch(ARM, '<include file="$(find other)/launch/a.launch"/>'),
    ),
}
STARTED = {
    "by a file that is included now": (_launch(ARM, LEG), {**_launch(ARM, INCLUDED), **_launch(LEG, name="legs")}),
    "perhaps by a file of another package": (_launch(ARM, LEG), _launch(ARM, FOREIGN)),
    "perhaps by a file that only the launch knows": (
        _launch(ARM, LEG),
        _launch('<arg name="legs"/>', ARM, '<include file="$(arg legs)"/>'),
    ),
    "by two nodes of its program": (
        _launch(ARM, LEG),
        _launch(ARM, LEG.replace('name="leg"', 'name="left"'), LEG.replace('name="leg"', 'name="right"')),
    ),
    "by another program": (_launch(ARM, LEG), _launch(ARM, LEG.replace('type="leg"', 'type="leg_2"'))),
    "by no file, as that has another name": (
        _launch(ARM, LEG),
        {**dict.fromkeys(_launch(ARM)), **_launch(ARM, name="all_of_it")},
    ),
    "perhaps by a program that only the launch knows": (
        _launch(ARM, LEG),
        _launch('<arg name="kind"/>', ARM, '<node pkg="leg" type="$(arg kind)" name="$(arg kind)"/>'),
    ),
}


@pytest.mark.parametrize("case", GONE)
def test_a_node_that_is_no_longer_started(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """Who runs or includes the file is without it."""
    old, new = GONE[case]
    found = [each for each in changes({"arm/package.xml": ROS1, **old}, new) if each["breaking"]]
    assert [(each["kind"], each["change"], each["owner"], each["old"]) for each in found] == [
        ("node", "removed", "all.launch", "leg")
    ]


@pytest.mark.parametrize("case", STARTED)
def test_a_node_that_may_still_be_started(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """By what the file includes, under another name or by another program; where not all is known nothing is told."""
    old, new = STARTED[case]
    found = changes({"arm/package.xml": ROS1, **old}, new)
    assert not [each for each in found if each["kind"] == "node" and each["change"] == "removed"]


def test_a_program_that_is_gone_explains_its_node(told) -> None:  # type: ignore[no-untyped-def]
    """It is told of the program."""
    make = "project(arm)\nadd_executable(arm src/a.cpp)\nadd_executable(hand src/b.cpp)\n"
    hand = ARM.replace("arm", "hand").replace('pkg="hand"', 'pkg="arm"')
    sources: Files = {"arm/src/a.cpp": "int main() {}\n", "arm/src/b.cpp": "int main() {}\n"}
    old = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": make, **sources, **_launch(ARM, hand)}
    new = {"arm/CMakeLists.txt": make.replace("add_executable(hand src/b.cpp)\n", ""), **_launch(ARM)}
    assert told(old, new) == {("executable", "removed", "hand", None)}


UNNAMED = '<node pkg="{0}" exec="{0}"/>'
COMPONENT = '<load_composable_node target="c"><composable_node pkg="{0}" plugin="{0}::Node"/></load_composable_node>'
SOME = {
    "taken out": ((UNNAMED.format("leg"),), (), ["leg/leg"]),
    "a component taken out": ((COMPONENT.format("leg"),), (), ["leg/Node"]),
    "it has a name now": ((UNNAMED.format("leg"),), (UNNAMED.format("leg").replace("/>", ' name="left"/>'),), []),
    "another of its package came": ((UNNAMED.format("leg"),), ('<node pkg="leg" exec="leg2"/>',), []),
    "it is included now": (
        (UNNAMED.format("leg"),),
        ('<include file="$(find-pkg-share arm)/launch/legs.launch.xml"/>',),
        [],
    ),
}


@pytest.mark.parametrize("case", SOME)
def test_a_program_without_a_name_that_is_no_longer_started(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """It is told by what it runs, as nobody who reads the launch file knows how it calls itself."""
    before, after, lost = SOME[case]
    arm, legs = UNNAMED.format("arm"), {"arm/launch/legs.launch.xml": f"<launch>{UNNAMED.format('leg')}</launch>"}

    def files(*lines: str) -> Files:
        return {"arm/launch/all.launch.xml": "\n".join(("<launch>", arm, *lines, "</launch>")), **legs}

    found = [each for each in changes(files(*before), files(*after)) if each["kind"] == "node" and each["breaking"]]
    assert [(each["change"], each["owner"], each["old"]) for each in found] == [
        ("removed", "all.launch.xml", name) for name in lost
    ]


MADE = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
{}

def generate_launch_description():
    return {}
"""
RETURNED = {
    "by a function of others": ("from helpers import made", "made('arm')", False),
    "by a function of others, in a list": ("from helpers import made", "LaunchDescription([made('arm')])", False),
    "here": ("", "LaunchDescription([DeclareLaunchArgument('rate')])", True),
}


@pytest.mark.parametrize("case", RETURNED)
def test_an_argument_of_a_description_that_others_make(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """They may declare it: it is told as a doubt, and the verdict is not the all-clear."""
    imported, returned, breaks = RETURNED[case]
    old = '<launch><arg name="depth" default="1"/><arg name="rate" default="1"/></launch>\n'
    new = {"arm/launch/all.launch": None, "arm/launch/all.launch.py": MADE.format(imported, returned)}
    found = changes({"arm/launch/all.launch": old}, new)
    assert [each["breaking"] for each in found if each["old"] == "depth"] == [breaks]
