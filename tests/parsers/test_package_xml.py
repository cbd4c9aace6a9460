"""package.xml of all three formats gives the facts of a manifest."""

import pytest
from ecm_parsers.package_facts import BuildType, Dependency, Export, Manifest, PluginExport
from ecm_parsers.package_xml import parse, ros_version, ros_versions
from hypothesis import given, settings
from hypothesis import strategies as st

HEAD = "<name>p</name><version>1.2.3</version>"

BOTH = """<buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
<buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>"""

FORMAT3 = """<?xml version="1.0"?>
<?xml-model href="x.xsd"?>
<package format="3">
  <name>arm_driver</name>
  <version compatibility="1.0.0">2.1.0</version>
  <description>
    Drives an <b>arm</b>.
  </description>
  <maintainer email="a@example.org">Ada</maintainer>
  <maintainer email="b@example.org">Bo</maintainer>
  <license file="LICENSE">Apache-2.0</license>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>
  <depend version_gte="1.2.0" version_lt="2.0.0">arm_msgs</depend>
  <exec_depend>launch</exec_depend>
  <test_depend>gtest</test_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <group_depend>drivers</group_depend>
  <export>
    <build_type condition="$ROS_VERSION == 1">catkin</build_type>
    <build_type condition="$ROS_VERSION == 2">ament_cmake</build_type>
    <arm_core plugin="${prefix}/plugins.xml"/>
    <rosdoc config="rosdoc.yaml"/>
    <deprecated>Use arm_driver_2.</deprecated>
  </export>
</package>
"""


def manifest(body: str, head: str = HEAD, form: int = 3) -> Manifest:
    parsed = parse(f'<package format="{form}">{head}{body}</package>'.encode())
    assert parsed.diagnostics == ()
    return parsed.facts


def test_format_3() -> None:
    """Every element of a full manifest is a fact with its line; addresses of people are not kept."""
    parsed = parse(FORMAT3.encode())
    assert parsed.diagnostics == ()
    assert parsed.facts == Manifest(
        name="arm_driver",
        line=4,
        version="2.1.0",
        version_line=5,
        format=3,
        description="Drives an arm.",
        maintainers=("Ada", "Bo"),
        licenses=("Apache-2.0",),
        dependencies=(
            Dependency("catkin", "buildtool", 12, (), "$ROS_VERSION == 1"),
            Dependency("ament_cmake", "buildtool", 13, (), "$ROS_VERSION == 2"),
            Dependency("arm_msgs", "depend", 14, (("<", "2.0.0"), (">=", "1.2.0"))),
            Dependency("launch", "exec", 15),
            Dependency("gtest", "test", 16),
            Dependency("rosidl_interface_packages", "member_of_group", 17),
            Dependency("drivers", "group_depend", 18),
        ),
        build_types=(
            BuildType("catkin", 20, "$ROS_VERSION == 1"),
            BuildType("ament_cmake", 21, "$ROS_VERSION == 2"),
        ),
        exports=(Export("rosdoc", (("config", "rosdoc.yaml"),), "", 23),),
        plugins=(PluginExport("arm_core", "plugins.xml", 22),),
        deprecated="Use arm_driver_2.",
    )
    assert ros_versions(parsed.facts) == {1, 2}


def test_format_1() -> None:
    """Without a format it is format 1, whose `run_depend` is kept as such."""
    parsed = parse(f"<package>{HEAD}<run_depend>a</run_depend><build_depend>b</build_depend></package>".encode())
    assert parsed.facts.format == 1
    assert [(item.name, item.kind) for item in parsed.facts.dependencies] == [("a", "run"), ("b", "build")]


@pytest.mark.parametrize("tag", ["metapackage", "architecture_independent", "message_generator"])
def test_exports_are_kept(tag: str) -> None:
    """What nobody interprets here is still a fact."""
    assert [item.tag for item in manifest(f"<export><{tag}/></export>").exports] == [tag]


@pytest.mark.parametrize(
    ("body", "version"),
    [
        ("<buildtool_depend>catkin</buildtool_depend>", 1),
        ("<buildtool_depend>ament_cmake_auto</buildtool_depend>", 2),
        ("<export><build_type>ament_python</build_type></export>", 2),
        ("<export><build_type>catkin</build_type></export>", 1),
        (
            "<buildtool_depend>catkin</buildtool_depend><export><build_type>ament_cmake</build_type></export>",
            2,
        ),
        ("<export><build_type>cmake</build_type></export>", None),
        ("<buildtool_depend>cmake</buildtool_depend>", None),
        ('<buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>', 2),
        (BOTH, None),
        ("", None),
    ],
)
def test_ros_version(body: str, version: int | None) -> None:
    """The build type decides, then the build tool, each under its condition; both or neither is None."""
    assert ros_version(manifest(body)) == version


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("\n<launch/>", "package-wrong-root", 2),
        ("\n<package><version>1</version></package>", "package-no-name", 2),
        ("<package><name>p</name></package>", "package-no-version", 0),
        (f"<package>{HEAD}\n<depend condition='$A'>a</depend></package>", "package-bad-condition", 2),
        (f"<package>{HEAD}\n<depend/></package>", "package-empty-depend", 2),
        ("", "xml-empty", 0),
    ],
)
def test_problems(text: str, code: str, line: int) -> None:
    """What is missing or makes no sense is a diagnostic on its line."""
    assert [(found.code, found.line) for found in parse(text.encode()).diagnostics] == [(code, line)]


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(["<name>", "</name>", "<export>", "<depend ", "x", ">", "condition='(' ", "/>"])))
def test_never_raises(parts: list[str]) -> None:
    """Any broken manifest still gives a manifest."""
    assert isinstance(parse(f"<package>{''.join(parts)}</package>".encode()).facts, Manifest)
