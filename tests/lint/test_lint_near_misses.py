"""What looks like a finding and is none, or less of one, beside what differs a little and is one."""

from __future__ import annotations

from typing import Any

import near_miss_files as files_of
import near_miss_sources as sources_of
import pytest
from lint_fixtures import lint
from near_miss_files import Files

ROWS = [
    ("a reader of anything", "LNT007", 1, files_of.wildcard("rospy.AnyMsg"), files_of.wildcard("String"), None),
    ("the overload that serves", "LNT007", 1, files_of.overload("pkg::Update"), files_of.overload("pkg::Other"), None),
    (
        "its own name",
        "LNT005",
        1,
        files_of.own_name("ros::this_node::getName()"),
        files_of.own_name('std::string("gps")'),
        None,
    ),
    ("read with its map", "LNT005", 1, files_of.whole_map("axis_linear/x"), files_of.whole_map("axis_linea"), None),
    (
        "remap of a parameter",
        "LNT006",
        1,
        files_of.remapped("hand_description"),
        files_of.remapped("foot_description"),
        None,
    ),
    ("links below a namespace", "LNT027", 1, files_of.pair("x"), files_of.pair("", "-2"), None),
    ("exported by CUDA", "LNT009", 1, files_of.plugin(".cu"), files_of.plugin(".txt"), None),
    ("a file of the machine", "LNT002", 1, files_of.described("/etc/a.xacro"), files_of.described("b.xacro"), None),
    ("the last part is missing", "LNT001", 2, files_of.included(""), files_of.included("b.launch.xml"), None),
    ("a part of another description", "LNT002", 1, files_of.part("inner.xacro"), files_of.part("other.xacro"), None),
    ("an argument for somebody to give", "LNT001", 1, files_of.chosen(""), files_of.chosen("b"), None),
    ("absolute in the middle", "LNT001", 2, files_of.joined("a"), files_of.joined("b"), None),
    (
        "a command that builds",
        "LNT003",
        1,
        files_of.generated("add_executable(${x} a.cpp)"),
        files_of.generated(""),
        None,
    ),
    ("filled in by the build", "LNT002", 1, files_of.filled_in("b.xacro.in"), files_of.filled_in("c.xacro.in"), None),
    (
        "made by a function",
        "LNT024",
        1,
        sources_of.sent("origin()"),
        sources_of.sent("geometry_msgs::PoseStamped()"),
        None,
    ),
    ("copied by a command", "LNT003", 1, sources_of.copied("runner"), sources_of.copied("other"), None),
    ("a plugin of Python", "LNT009", 1, sources_of.view("pkg.view.View"), sources_of.view("pkg::View"), None),
    ("both of two results", "LNT024", 1, sources_of.filled("tie(image, depth)"), sources_of.filled("x"), None),
    ("one of two results", "LNT028", 1, sources_of.converted("auto [enu, b]"), sources_of.converted("auto enu"), None),
    ("scoped by its model", "LNT054", 1, sources_of.sensor("m->SensorScopedName(n)[0]"), sources_of.sensor("n"), None),
    ("a centimeter on purpose", "LNT049", 1, sources_of.shape("0.01"), sources_of.shape("0.02"), "info"),
    (
        "of one of two stars",
        "LNT007",
        1,
        sources_of.starred("from two_msgs.msg import *\n"),
        sources_of.starred(""),
        None,
    ),
    (
        "made for an action",
        "LNT017",
        1,
        sources_of.goal_of("RunActionGoal"),
        sources_of.goal_of("RunActionStart"),
        None,
    ),
    ("listed by the build", "LNT010", 1, sources_of.made_by_build("Made.msg"), sources_of.made_by_build(""), None),
    ("installed by its path", "LNT003", 1, sources_of.configured("bin/runner"), sources_of.configured("bin/x"), None),
    ("of a stranger", "LNT029", 1, files_of.moved(""), files_of.moved("driver"), None),
    ("named by another parameter", "LNT005", 1, files_of.pipeline("pipeline_of_filters"), files_of.pipeline("x"), None),
    ("one build or the other", "LNT014", 1, sources_of.read_twice("#else"), sources_of.read_twice(""), None),
    (
        "a parameter called as its node",
        "LNT014",
        1,
        files_of.self_named("plane"),
        files_of.self_named("plane/height"),
        None,
    ),
    ("told to be absolute", "LNT042", 1, files_of.lidar("/lidar/scan"), files_of.lidar("~scan"), None),
    ("a bridge both ways", "LNT012", 2, files_of.bridge("/cmd_vel"), files_of.bridge("/cmd"), None),
    ("given by people in rviz", "LNT015", 1, files_of.pose("/initialpose"), files_of.pose("/initialpose2d"), None),
    (
        "remapped in the simulator",
        "LNT015",
        1,
        files_of.simulated("arm/follow_joint_trajectory"),
        files_of.simulated("leg/x"),
        None,
    ),
    (
        "a topic called as a controller",
        "LNT045",
        1,
        files_of.named_alike("controller"),
        files_of.named_alike("node"),
        None,
    ),
    ("two meet there", "LNT045", 1, files_of.meeting("/arm/limb/left"), files_of.meeting("/elsewhere"), None),
    ("one angle, one way", "LNT016", 1, files_of.limited("0"), files_of.limited("-3.142"), "info"),
    ("a namespace of several", "LNT046", 1, files_of.read_below("/robot"), files_of.read_below("/monitor"), "info"),
    ("no namespace", "LNT046", 1, files_of.read_below(""), files_of.read_below("/monitor"), "info"),
    ("a metapackage names all", "LNT036", 1, files_of.deprecated("<metapackage/>"), files_of.deprecated(""), None),
    ("fetched from source", "LNT055", 1, files_of.fetched("nodelet"), files_of.fetched("other"), None),
    (
        "given by who includes it",
        "LNT042",
        1,
        files_of.given("$(arg labels)"),
        files_of.given("/decomposer/label"),
        "info",
    ),
    (
        "made of a template",
        "LNT001",
        1,
        sources_of.made_of_template("left"),
        sources_of.made_of_template("right"),
        None,
    ),
    ("launched from source", "LNT055", 1, files_of.from_source("nodelet"), files_of.from_source("other"), "info"),
    ("spelled otherwise", "LNT055", 1, files_of.misspelled("other"), files_of.misspelled("micro_arm_agent"), None),
    ("letters of another package", "LNT055", 2, files_of.turned("rclcpp"), files_of.turned("rclpy"), "info"),
    ("given to a port", "LNT006", 1, files_of.given_to_port("goal_pose"), files_of.given_to_port("start"), None),
    ("a folder of modules", "LNT011", 1, sources_of.in_folder("arms"), sources_of.in_folder("legs"), None),
    (
        "a module of parameters",
        "LNT011",
        1,
        sources_of.asked_of_build("", "generate_parameter_module('made', find())"),
        sources_of.asked_of_build("", "generate_other_module('made', find())"),
        None,
    ),
    (
        "a module of protoc",
        "LNT011",
        1,
        sources_of.asked_of_build("add_custom_target(made ALL COMMAND protoc --python_out=src/pkg made.proto)"),
        sources_of.asked_of_build("add_custom_target(made ALL COMMAND doxygen made.proto)"),
        None,
    ),
    ("how a name begins", "LNT040", 1, files_of.analyzed("pkg", "dri"), files_of.analyzed("pkg", "xd"), None),
    (
        "statuses that are named by hand",
        "LNT040",
        1,
        files_of.states("diagnostic_msgs"),
        files_of.states("diagnostic_updater"),
        None,
    ),
    ("nodes of another repository", "LNT040", 1, files_of.analyzed("other_bringup"), files_of.analyzed("pkg"), None),
]


@pytest.mark.parametrize(
    ("rule", "ros", "less", "more", "severity"), [row[1:] for row in ROWS], ids=[r[0] for r in ROWS]
)
def test_less(rule: str, ros: int, less: Files, more: Files, severity: str | None, workspace: Any) -> None:
    """The two differ in what the condition is about, so that the first is not quiet for another reason."""
    assert found(workspace, more, ros).get(rule) in {"warning", "error"}
    assert found(workspace, less, ros).get(rule) == severity


def found(workspace: Any, files: Files, ros: int) -> dict[str, str]:
    """Severity by rule, the worst that there is."""
    for old in workspace.root.rglob("*"):
        if old.is_file():
            old.unlink()
    workspace.package(files, ros=ros)
    for path in [path for path in files if path.endswith("package.xml")]:
        (workspace.root / "pkg" / path).write_text(files[path])
    return {finding.rule: finding.severity for finding in reversed(lint(workspace.root))}
