"""Changes that guides describe, each in a small repository with two releases."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from diff_repos import node, package, release, write

from ecm_extract.cli.run import run

CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib)\n"
Told = set[tuple[str, str, str | None, str | None]]
Files = dict[str, str | None]
HELPER = (
    "#pragma once\nnamespace util {\ntemplate<typename N, typename T>\n"
    "void declare(N node, const std::string & name, T v) {\n"
    "  node->declare_parameter(name, v);\n}\n}\n"
)


def _header(*lines: str) -> Files:
    return {"arm/include/arm/driver.hpp": "\n".join(("#pragma once", "namespace arm {", *lines, "}")) + "\n"}


def _class(*lines: str) -> Files:
    return _header("class Driver {", "public:", *lines, "};")


HEADERS = {
    "another name with the very signature": (
        _class("virtual void setPlan(const Path & path) = 0;"),
        _class("virtual void newPathReceived(const Path & raw) = 0;"),
        {("method", "renamed", "setPlan", "newPathReceived")},
    ),
    "a name that was given to something else": (
        _class("const State & get_state() const;"),
        _class("const State & get_lifecycle_state() const;", "double get_state(const std::string & name) const;"),
        {("method", "renamed", "get_state", "get_lifecycle_state"), ("method", "added", None, "get_state")},
    ),
    "an alias has all that its class has": (
        _header("class Actuator {", "public:", "void start(int rate);", "};"),
        _header("class Component {", "public:", "void start(double rate);", "};", "using Actuator = Component;"),
        {("method", "signature_changed", "start", "start")},
    ),
    "fields of a base with a private name": (
        _header(
            "struct ALIGN16 _Point {", "uint32_t signal;", "MAKE_ALIGNED_NEW", "};", "struct Point : public _Point {};"
        ),
        _header(
            "struct ALIGN16 _Point {", "uint16_t signal;", "MAKE_ALIGNED_NEW", "};", "struct Point : public _Point {};"
        ),
        {("member", "type_changed", "signal", "signal")},
    ),
    "a comment announces the end": (
        _class("void stop();", "void halt();"),
        _class("/// deprecated: use halt()", "void stop();", "void halt();"),
        {("method", "deprecated", "stop", "halt")},
    ),
    "a header announces its end": (
        {"arm/include/arm/old.h": "#pragma once\n", "arm/include/arm/old.hpp": "#pragma once\n"},
        {"arm/include/arm/old.h": "#pragma once\n#warning This is obsolete, please include arm/old.hpp instead\n"},
        {("file", "deprecated", "arm/old.h", "arm/old.hpp")},
    ),
    "a file with bodies of templates announces its end": (
        {"arm/include/arm/old.ipp": "#pragma once\n", "arm/include/arm/old.hpp": "#pragma once\n"},
        {"arm/include/arm/old.ipp": "#pragma once\n#warning This is obsolete, please include arm/old.hpp instead\n"},
        {("file", "deprecated", "arm/old.ipp", "arm/old.hpp")},
    ),
}


QUIET = {
    "an overload takes each call that was right": (
        _class("Driver(const std::string & name, double * value = nullptr);"),
        _class("Driver(const std::string & name, double * value);", "Driver(const std::string & name, int kind = 0);"),
    ),
    "a constant reference takes what was given": (
        _class("void move(Pose & pose, Plan plan);"),
        _class("void move(const Pose & pose, const Plan & plan);"),
    ),
    "a class has a constructor without being told": (_class("Driver();", "void stop();"), _class("void stop();")),
    "a base has what was an override": (
        _class("void stop() override;", "void halt();"),
        _class("void halt();"),
    ),
    "a template takes what was given": (
        _class("bool get_value(double & value);"),
        _class("template <typename T> bool get_value(T & value);"),
    ),
    "a macro is no member": (_class("SMART_PTR_DEFINITIONS(Driver)", "void stop();"), _class("void stop();")),
}


@pytest.mark.parametrize("case", QUIET)
def test_nobody_breaks(told, case: str) -> None:  # type: ignore[no-untyped-def]
    """What callers need not notice is no change of a method."""
    old, new = QUIET[case]
    words = {word for kind, word, _, _ in told(old, new) if kind in {"method", "member"}}
    assert not words & {"removed", "signature_changed", "renamed"}


def test_annotations_change_no_signature(told) -> None:  # type: ignore[no-untyped-def]
    """Python callers name and count arguments; nobody checks their types."""
    files: Files = {
        "arm/setup.py": "from setuptools import setup\nsetup(name='arm', packages=['arm'])\n",
        "arm/arm/__init__.py": "",
    }
    old = {**files, "arm/arm/tool.py": "def warn(text):\n    pass\n"}
    assert not told(old, {"arm/arm/tool.py": "def warn(text: str) -> None:\n    pass\n"})


def test_a_constant_of_another_value_is_another_constant(told) -> None:  # type: ignore[no-untyped-def]
    """Alike names of numbers say nothing when the numbers differ."""
    old: Files = {"arm/msg/Frame.msg": "uint8 FRAME_VISION_NED=16\nuint8 frame\n"}
    found = told(old, {"arm/msg/Frame.msg": "uint8 FRAME_RESERVED_NED=14\nuint8 frame\n"})
    assert ("constant", "removed", "FRAME_VISION_NED", None) in found


@pytest.mark.parametrize("case", HEADERS)
def test_headers(told, case: str) -> None:  # type: ignore[no-untyped-def]
    """Each way in which a public symbol changes is one change of its kind."""
    old, new, expected = HEADERS[case]
    assert expected <= told(old, new)


def test_parameters_that_share_a_helper_are_told_apart(told) -> None:  # type: ignore[no-untyped-def]
    """The line of a helper says nothing of the parameters of the packages that use it."""
    user = node('util::declare(this, "transform_tolerance", 0.1);', 'util::declare(this, "rate", 1.0);')
    less = node('util::declare(this, "rate", 1.0);')
    include = '#include "util/helper.hpp"\n'
    user, less = include + user, include + less
    other = {"leg/package.xml": package("leg"), "leg/src/leg.cpp": user.replace("Arm", "Leg").replace("arm", "leg")}
    old = {
        "arm/include/util/helper.hpp": HELPER,
        "arm/src/arm.cpp": user,
        "arm/CMakeLists.txt": CMAKE,
        **other,
    }
    found = told(old, {"arm/src/arm.cpp": less})
    assert ("parameter", "removed", "transform_tolerance", None) in found


def test_a_common_word_makes_no_rename(told) -> None:  # type: ignore[no-untyped-def]
    """`use_interpolation` and `use_cancel_deceleration` share the word `use`, which says nothing."""
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": node('declare_parameter("use_interpolation", true);')}
    new = {"arm/src/arm.cpp": node('declare_parameter("use_cancel_deceleration", false);')}
    assert ("parameter", "removed", "use_interpolation", None) in told(old, new)


def test_a_description_announces_the_end(told) -> None:  # type: ignore[no-untyped-def]
    """Generated parameters say in their description that they will go, and what to use."""
    yaml = 'arm:\n  front: {{type: bool, default_value: true, description: "{}"}}\n'
    yaml += "  side: {{type: bool, default_value: true}}\n"
    sources = {
        "arm/CMakeLists.txt": f"{CMAKE}generate_parameter_library(arm_parameters src/arm.yaml)\n",
        "arm/src/arm.cpp": node("param_listener_ = std::make_shared<arm::ParamListener>(this);").replace(
            "#include <rclcpp", "#include <arm/arm_parameters.hpp>\n#include <rclcpp", 1
        ),
    }
    found = told(
        {**sources, "arm/src/arm.yaml": yaml.format("Front.")},
        {"arm/src/arm.yaml": yaml.format("DEPRECATED: use side")},
    )
    assert ("parameter", "deprecated", "front", "side") in found


def test_what_ament_auto_installs_is_installed(told) -> None:  # type: ignore[no-untyped-def]
    """`ament_auto_package` installs the targets that `ament_auto_add_*` made."""
    auto = "project(arm)\nament_auto_add_executable(arm src/arm.cpp)\nament_auto_package()\n"
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": node()}
    assert not told(old, {"arm/CMakeLists.txt": auto})


@pytest.mark.parametrize(
    ("install", "shown"),
    [
        ("", set()),
        ("install(DIRECTORY include/ DESTINATION include)", {("file", "removed", "arm/driver.hpp", None)}),
    ],
)
def test_what_is_not_installed_is_nobody_s(told, install: str, shown: Told) -> None:  # type: ignore[no-untyped-def]
    """Headers that a package keeps to itself and extension modules of Python are no interface of C++."""
    built = (
        "project(arm)\nadd_library(arm SHARED src/arm.cpp)\n"
        "install(TARGETS arm DESTINATION ${PYTHON_INSTALL_DIR}/arm)\n"
    )
    old = {"arm/CMakeLists.txt": f"{built}{install}\n", **_header()}
    assert told(old, {"arm/include/arm/driver.hpp": None, "arm/CMakeLists.txt": "project(arm)\n"}) == shown


def test_a_placeholder_is_no_name(told) -> None:  # type: ignore[no-untyped-def]
    """A default that says that a value must be given is the name of no topic."""
    old = {
        "arm/CMakeLists.txt": CMAKE,
        "arm/src/arm.cpp": node(
            'auto topic = declare_parameter("topic", "<undefined>");',
            "create_publisher<std_msgs::msg::Bool>(topic, 1);",
        ),
    }
    new = {"arm/src/arm.cpp": node('declare_parameter("topic", "<undefined>");')}
    assert told(old, new) == set()


def test_the_output_name_of_a_target_is_the_executable(told) -> None:  # type: ignore[no-untyped-def]
    """`ros2 run` knows the file that is built, not the target."""
    old = {
        "arm/CMakeLists.txt": f"{CMAKE}set_target_properties(arm PROPERTIES OUTPUT_NAME arm_driver)\n",
        "arm/src/arm.cpp": node(),
    }
    assert ("executable", "removed", "arm_driver", None) in told(old, {"arm/CMakeLists.txt": "project(arm)\n"})


def test_a_package_moves_with_most_of_its_files(told) -> None:  # type: ignore[no-untyped-def]
    """A package whose files went to the folder of a new package has its name."""
    files = {f"src/part{number}.cpp": f"int part{number}() {{ return {number}; }}\n" * 5 for number in range(4)}
    old: Files = {
        "nav_recoveries/package.xml": package("nav_recoveries"),
        **{f"nav_recoveries/{p}": t for p, t in files.items()},
    }
    new: Files = {
        "nav_behaviors/package.xml": package("nav_behaviors"),
        **{f"nav_behaviors/{p}": t for p, t in files.items()},
    }
    assert ("package", "renamed", "nav_recoveries", "nav_behaviors") in told(old, {**dict.fromkeys(old), **new})


LAUNCH = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("use_fake_hardware", default_value="false"),
        DeclareLaunchArgument("rate", default_value="10"),
        DeclareLaunchArgument("speed", default_value="1"),
    ])
"""


def test_launch_arguments(told) -> None:  # type: ignore[no-untyped-def]
    """An argument is renamed, has another default, or must be given from now on."""
    changed = LAUNCH.replace("fake", "mock").replace('"10"', '"20"').replace('"speed", default_value="1"', '"speed"')
    changed = changed.replace("    ])", '        DeclareLaunchArgument("robot_ip"),\n    ])')
    found = told({"arm/launch/arm.launch.py": LAUNCH}, {"arm/launch/arm.launch.py": changed})
    assert found == {
        ("launch_argument", "renamed", "use_fake_hardware", "use_mock_hardware"),
        ("launch_argument", "default_changed", "rate", "rate"),
        ("launch_argument", "default_changed", "speed", "speed"),
        ("launch_argument", "added", None, "robot_ip"),
    }


def test_a_launch_file_takes_its_arguments_along(told) -> None:  # type: ignore[no-untyped-def]
    """A file that goes is one change; one that is renamed keeps its arguments."""
    old: Files = {"arm/launch/arm.launch.py": LAUNCH, "arm/launch/view.launch.py": LAUNCH.replace('"rate"', '"fps"')}
    new: Files = {
        "arm/launch/arm.launch.py": None,
        "arm/launch/arm_bringup.launch.py": LAUNCH,
        "arm/launch/view.launch.py": None,
    }
    assert told(old, new) == {
        ("launch_file", "renamed", "arm.launch.py", "arm_bringup.launch.py"),
        ("launch_file", "removed", "view.launch.py", None),
    }


TREE_NODE = """#include "behaviortree_cpp/bt_factory.h"
namespace arm {
class Wait : public BT::SyncActionNode {
public:
  static BT::PortsList providedPorts() {
    return {BT::InputPort<int>("wait_duration", 1, "seconds"), BT::InputPort<std::string>("frame", "frame")};
  }
};
}
BT_REGISTER_NODES(factory)
{
  factory.registerNodeType<arm::Wait>("Wait");
}
"""


def test_behaviour_tree_nodes_and_ports(told) -> None:  # type: ignore[no-untyped-def]
    """The names that behaviour tree files use: a port of another type, one that is gone, a node of another name."""
    ports = TREE_NODE.replace("InputPort<int>", "InputPort<double>").replace(
        ', BT::InputPort<std::string>("frame", "frame")', ""
    )
    assert told({"arm/src/wait.cpp": TREE_NODE}, {"arm/src/wait.cpp": ports}) >= {
        ("bt_port", "type_changed", "wait_duration", "wait_duration"),
        ("bt_port", "removed", "frame", None),
    }


def test_the_finding_of_a_diff_has_a_page(capsys: pytest.CaptureFixture[str]) -> None:
    """`explain` prints it like that of any other rule."""
    assert run(["explain", "VER001"]) == 0
    assert capsys.readouterr().out.startswith("# VER001 field_break")


def test_includes_that_break(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Who includes a file that is gone, gives an argument that has another name, or leaves out one that is needed."""
    old: Files = {
        "arm/package.xml": package("arm"),
        "arm/launch/arm.launch.py": LAUNCH,
        "arm/launch/view.launch.py": LAUNCH,
    }
    changed = LAUNCH.replace("fake", "mock").replace("    ])", '        DeclareLaunchArgument("robot_ip"),\n    ])')
    release(tmp_path / "repo", old, "1.0.0")
    release(tmp_path / "repo", {"arm/launch/arm.launch.py": changed, "arm/launch/view.launch.py": None}, "2.0.0")
    lines = (
        "<launch>",
        '<include file="$(find-pkg-share arm)/launch/arm.launch.py">',
        '<arg name="use_fake_hardware" value="true"/></include>',
        '<include file="$(find-pkg-share arm)/launch/view.launch.py"/>',
        "</launch>",
    )
    write(tmp_path / "user", {"package.xml": package("user"), "launch/user.launch.xml": "\n".join(lines)})
    repo = ["--repo", str(tmp_path / "repo"), "--consumer", str(tmp_path / "user"), "--format", "json", "--no-cache"]
    assert run(["diff", "1.0.0", "2.0.0", *repo]) == 1
    found = json.loads(capsys.readouterr().out)["findings"]
    assert {(each["evidence"][0]["line"], each["resolution"].split(";")[0]) for each in found} == {
        (3, "write use_mock_hardware instead of use_fake_hardware"),
        (2, "give robot_ip a value where the file is included"),
        (4, "stop using view.launch.py"),
    }
