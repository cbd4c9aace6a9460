"""Parameter files that users get: who starts the launch file of a package runs with their values."""

from __future__ import annotations

import pytest
from diff_repos import package

CMAKE = "project(arm)\n%s"
SETUP = "from setuptools import setup\nsetup(name='arm', data_files=[('share/arm/config', ['config/%s'])])\n"
FILE = "arm:\n  ros__parameters:\n    rate: %s\n"
MORE = "arm:\n  ros__parameters:\n    more: 1\n"
LAUNCH = '<launch><node pkg="arm" exec="arm"><param from="$(find-pkg-share arm)/config/arm.yaml"/></node></launch>\n'
LAUNCH1 = '<launch><rosparam command="load" file="$(find arm)/config/arm.yaml"/></launch>\n'
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
CONFIG = "arm/config/arm.yaml"


def _told(found: list[dict[str, object]]) -> list[tuple[object, ...]]:
    names = ("kind", "change", "owner", "old", "new", "old_value", "new_value", "breaking")
    return [tuple(each[name] for name in names) for each in found if each["kind"] == "parameter_setting"]


@pytest.mark.parametrize(
    "given",
    [
        {"arm/CMakeLists.txt": CMAKE % "install(DIRECTORY config DESTINATION share/arm)\n"},
        {"arm/CMakeLists.txt": CMAKE % "install(DIRECTORY config/ DESTINATION share/arm)\n"},
        {"arm/CMakeLists.txt": CMAKE % "install(FILES config/arm.yaml DESTINATION share/arm)\n"},
        {"arm/setup.py": SETUP % "arm.yaml"},
        {"arm/setup.py": SETUP % "*.yaml"},
        {"arm/launch/a.launch.xml": LAUNCH},
    ],
)
def test_a_value_of_a_file_that_users_get(changes, given: dict[str, str]) -> None:  # type: ignore[no-untyped-def]
    """Another value there is another default, with both values, and breaks nobody."""
    found = changes({CONFIG: FILE % "10", **given}, {CONFIG: FILE % "20"})
    setting = ("parameter_setting", "default_changed", "config/arm.yaml", "arm.rate", "arm.rate", "10", "20", False)
    assert _told(found) == [setting]


@pytest.mark.parametrize(
    "given",
    [
        {"arm/CMakeLists.txt": CMAKE % ""},
        {"arm/CMakeLists.txt": CMAKE % "install(DIRECTORY launch DESTINATION share/arm)\n"},
        {"arm/CMakeLists.txt": CMAKE % "install(FILES other/arm.yaml DESTINATION share/arm)\n"},
    ],
)
def test_a_file_that_nobody_gets_says_nothing(changes, given: dict[str, str]) -> None:  # type: ignore[no-untyped-def]
    """A file that is neither installed nor loaded is the maintainers' own."""
    assert _told(changes({CONFIG: FILE % "10", **given}, {CONFIG: FILE % "20"})) == []


def test_ros_1_files_count_where_a_launch_file_loads_them(changes) -> None:  # type: ignore[no-untyped-def]
    """Any map is a parameter file there, so an installed one that nobody loads says nothing."""
    rules = CMAKE % "install(DIRECTORY config DESTINATION share/arm)\n"
    old = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": rules, "arm/launch/a.launch": LAUNCH1}
    settings = {CONFIG: "rate: 10\n", "arm/config/other.yaml": "a: 1\n"}
    found = changes({**old, **settings}, {CONFIG: "rate: 20\n", "arm/config/other.yaml": "a: 2\n"})
    assert [entry[3:7] for entry in _told(found)] == [("rate", "rate", "10", "20")]


@pytest.mark.parametrize(
    ("new", "expected"),
    [
        ({CONFIG: FILE % "10\n    more: 1"}, [(None, "arm.more", None, "1")]),
        (
            {CONFIG: "arm:\n  ros__parameters:\n    more: 1\n"},
            [(None, "arm.more", None, "1"), ("arm.rate", None, "10", None)],
        ),
        ({CONFIG: None}, []),
        ({CONFIG: None, "arm/config/renamed.yaml": FILE % "10"}, []),
        ({CONFIG: None, "arm/config/renamed.yaml": FILE % "10" + "# moved\n"}, []),
        ({CONFIG: FILE % ".nan"}, [("arm.rate", "arm.rate", "10", "nan")]),
        ({CONFIG: FILE % "[1, 2]"}, [("arm.rate", "arm.rate", "10", "[1, 2]")]),
    ],
)
def test_settings_that_come_and_go(changes, new: dict[str, str | None], expected: list[tuple[object, ...]]) -> None:  # type: ignore[no-untyped-def]
    """What a file no longer sets falls back to the node; a file that went is no change of each value."""
    rules = CMAKE % "install(DIRECTORY config DESTINATION share/arm)\n"
    found = changes({CONFIG: FILE % "10", "arm/CMakeLists.txt": rules}, new)
    assert sorted((entry[3:7] for entry in _told(found)), key=str) == sorted(expected, key=str)


@pytest.mark.parametrize(("included", "told"), [("config/std.xml", 1), ("config/other.xml", 0)])
def test_a_file_that_is_included_loads_as_well(changes, included: str, told: int) -> None:  # type: ignore[no-untyped-def]
    """What is included is a launch file, whatever it is called and wherever it lies; another one is only a file."""
    top = f'<launch><include file="$(find arm)/{included}"/></launch>\n'
    old = {"arm/package.xml": ROS1, "arm/launch/a.launch": top, "arm/config/std.xml": LAUNCH1}
    found = changes({**old, CONFIG: "rate: 10\n"}, {CONFIG: "rate: 20\n"})
    assert [entry[3:7] for entry in _told(found)] == [("rate", "rate", "10", "20")] * told


def _launch1(inner: str) -> str:
    return f'<launch><arg name="space" default="w"/><param name="frame" value="base"/>{inner}</launch>\n'


@pytest.mark.parametrize(
    ("inner", "gone", "came"),
    [
        ('<param name="$(arg space)/model" value="m"/>', "model", "$(arg space)/model"),
        ('<group ns="left"><param name="model" value="m"/></group>', "model", "left/model"),
        ('<param name="model" value="m"/>', None, None),
        ('<node pkg="a" type="b" name="c"><param name="model" value="m"/></node>', "model", None),
    ],
)
def test_what_a_launch_file_puts_on_the_server_of_parameters(changes, inner: str, gone: object, came: object) -> None:  # type: ignore[no-untyped-def]
    """Any node may read it by its name, so that another name is one less and one more; what a node gets is its own."""
    old = {"arm/package.xml": ROS1, "arm/launch/a.launch": _launch1('<param name="model" value="m"/>')}
    found = _told(changes(old, {"arm/launch/a.launch": _launch1(inner), "arm/README": "two\n"}))
    assert {each[3] for each in found if each[3]} == ({gone} if gone else set())
    assert {each[4] for each in found if each[4]} == ({came} if came else set())


def test_another_value_on_the_server_is_told(changes) -> None:  # type: ignore[no-untyped-def]
    """Who reads it gets another one, and nobody breaks."""
    old = {"arm/package.xml": ROS1, "arm/launch/a.launch": _launch1('<param name="model" value="m"/>')}
    found = _told(changes(old, {"arm/launch/a.launch": _launch1('<param name="model" value="n"/>')}))
    assert [each[2:] for each in found] == [("launch/a.launch", "model", "model", "m", "n", False)]


@pytest.mark.parametrize(
    ("rules", "is_told"), [("install(DIRECTORY config DESTINATION share/arm)\n", True), ("", False)]
)
def test_a_file_that_users_got_is_gone(told, rules: str, is_told: bool) -> None:  # type: ignore[no-untyped-def]
    """Who names it by the package finds nothing; what it set goes with it."""
    old = {CONFIG: FILE % "10", "arm/config/other.yaml": MORE, "arm/CMakeLists.txt": CMAKE % rules}
    gone = ("parameter_file", "removed", "config/arm.yaml", None)
    assert told(old, {CONFIG: None}) == ({gone} if is_told else set())


def test_a_file_that_users_got_lies_elsewhere(told) -> None:  # type: ignore[no-untyped-def]
    """It is the same file, and those who name it must follow."""
    rules = CMAKE % "install(DIRECTORY config params DESTINATION share/arm)\n"
    old = {CONFIG: FILE % "10", "arm/CMakeLists.txt": rules}
    found = told(old, {CONFIG: None, "arm/params/arm.yaml": FILE % "10"})
    assert found == {("parameter_file", "moved", "config/arm.yaml", "params/arm.yaml")}


MANAGER = (
    "controller_manager:\n  ros__parameters:\n    {0}:\n      type: {1}\n{0}:\n  ros__parameters:\n    joints: [a]\n"
)
DRIVE = "diff_drive_controller/DiffDriveController"
MANAGED = f"controller_manager:\n  ros__parameters:\n    base:\n      type: {DRIVE}\n"
RULES = {"arm/CMakeLists.txt": CMAKE % "install(DIRECTORY config DESTINATION share/arm)\n"}
CONTROLLERS = {
    "another name": (MANAGER.format("base", DRIVE), MANAGER.format("wheels", DRIVE), {("renamed", "wheels")}),
    "none any more": (
        MANAGED,
        MANAGED.replace("base", "rate").replace(f"\n      type: {DRIVE}", " 1"),
        {("removed", None)},
    ),
    "another of another type": (MANAGED, MANAGED.replace("base", "arm").replace(DRIVE, "a/B"), {("removed", None)}),
    "two others": (MANAGED, MANAGED.replace("base", "a") + f"    b:\n      type: {DRIVE}\n", {("removed", None)}),
    "still there": (MANAGED, MANAGED + "    rate: 1\n", set()),
}


@pytest.mark.parametrize("case", CONTROLLERS)
def test_a_controller_of_a_file(changes, case: str) -> None:  # type: ignore[no-untyped-def]
    """It is known by its name: whoever starts it or sends to it by that needs the new one."""
    old, new, told = CONTROLLERS[case]
    found = [each for each in changes({CONFIG: old, **RULES}, {CONFIG: new}) if each["breaking"]]
    assert {(each["change"], each["new"]) for each in found} == {
        (how, name and f"controller_manager.{name}.type") for how, name in told
    }


def test_a_controller_that_another_file_has(changes) -> None:  # type: ignore[no-untyped-def]
    """It has its name still, wherever it is written."""
    found = changes(
        {CONFIG: MANAGED, **RULES}, {CONFIG: "arm:\n  ros__parameters:\n    a: 1\n", "arm/config/b.yaml": MANAGED}
    )
    assert not [each for each in found if each["breaking"]]


def test_a_controller_of_ros_1(changes) -> None:  # type: ignore[no-untyped-def]
    """There its settings stand below its name, and are told by the new one."""
    launch = {"arm/package.xml": ROS1, "arm/launch/a.launch": LAUNCH1}
    file = "{}:\n  type: position_controllers/JointTrajectoryController\n  rate: {}\n"
    found = changes({CONFIG: file.format("arm", 1), **launch}, {CONFIG: file.format("leg", 2)})
    assert [(each["change"], each["old"], each["new"], each["breaking"]) for each in found] == [
        ("renamed", "arm/type", "leg/type", True),
        ("default_changed", "arm/rate", "leg/rate", False),
    ]
