"""One cause is one finding, with all the lines that show it."""

from __future__ import annotations

from typing import Any

from lint_fixtures import lint

MESH = '<visual><geometry><mesh filename="package://pkg/meshes/{}.dae"/></geometry></visual>'
CONTROLLER = "{}:\n  type: effort_controllers/JointTrajectoryController\n  joints: [a, b]\n"


def findings(workspace: Any, rule: str) -> list[tuple[str, int]]:
    """What each finding of a rule says before its consequence, and how many lines it has."""
    found = [each for each in lint(workspace.root) if each.rule == rule]
    return [(each.message.partition(": ")[0], len(each.evidence)) for each in found]


def test_a_file_that_is_missing_twice(workspace: Any) -> None:
    """A launch file that names one missing file on two lines."""
    load = '<rosparam command="load" file="$(find pkg)/param/a.yaml"/>'
    workspace.package({"launch/a.launch": f"<launch>\n{load}\n{load}\n</launch>"}, ros=1)
    assert findings(workspace, "LNT001") == [("pkg/launch/a.launch names pkg/param/a.yaml, which is not there", 2)]


def test_a_program_that_two_launch_files_start(workspace: Any) -> None:
    """The build that makes no such program is the cause, not each file that starts it."""
    start = '<launch><node pkg="pkg" type="gone" name="a"/></launch>'
    cmake = "cmake_minimum_required(VERSION 3.0)\nproject(pkg)\nadd_executable(other a.cpp)\ncatkin_package()\n"
    workspace.package({"launch/a.launch": start, "launch/b.launch": start, "CMakeLists.txt": cmake}, ros=1)
    assert [(text.partition(";")[0], lines) for text, lines in findings(workspace, "LNT003")] == [
        ("pkg builds no program gone", 2)
    ]


def test_programs_that_were_removed_and_two_launch_files_still_start(workspace: Any) -> None:
    """What a package once built is one cause; a name that is nearly that of a program it builds is a slip."""
    start = '<launch><node pkg="pkg" type="{}" name="a"/></launch>'
    cmake = "cmake_minimum_required(VERSION 3.0)\nproject(pkg)\nadd_executable(planner a.cpp)\ncatkin_package()\n"
    files = {"launch/a.launch": "manual_drive", "launch/b.launch": "automatic_drive", "launch/c.launch": "plannr"}
    workspace.package({path: start.format(name) for path, name in files.items()} | {"CMakeLists.txt": cmake}, ros=1)
    assert [(text.partition(";")[0], lines) for text, lines in findings(workspace, "LNT003")] == [
        ("pkg builds no programs manual_drive, automatic_drive", 2),
        ("pkg builds no program plannr", 1),
    ]


def test_a_mesh_that_two_descriptions_name(workspace: Any) -> None:
    """The file that is not there is the cause, not who names it."""
    robot = f'<robot name="a"><link name="l">{MESH.format("toe")}</link></robot>'
    workspace.package({"meshes/sole.dae": "", "urdf/a.urdf": robot, "urdf/b.urdf": robot}, ros=1)
    assert findings(workspace, "LNT025") == [("pkg has no meshes/toe.dae", 2)]


def test_a_folder_that_is_missing(workspace: Any) -> None:
    """Meshes of a folder that is not there are missing with it, those of one that is are missing one by one."""
    named = ["hand/palm", "hand/thumb", "foot/toe", "foot/heel"]
    links = "".join(f'<link name="{at}">{MESH.format(name)}</link>\n' for at, name in enumerate(named))
    files = {"meshes/foot/sole.dae": "", "urdf/a.urdf": f'<robot name="a">\n{links}</robot>'}
    workspace.package(files, ros=1)
    assert sorted(findings(workspace, "LNT025")) == [
        ("pkg has no folder meshes/hand, where 2 meshes should be", 2),
        ("pkg has no meshes/foot/heel.dae", 1),
        ("pkg has no meshes/foot/toe.dae", 1),
    ]


def test_two_controllers_that_share_two_joints(workspace: Any) -> None:
    """The pair is the cause."""
    spawner = '<node name="s" pkg="controller_manager" type="spawner" args="left right"/>'
    load = '<rosparam command="load" file="$(find pkg)/config/c.yaml"/>'
    files = {
        "config/c.yaml": CONTROLLER.format("left") + CONTROLLER.format("right"),
        "launch/a.launch": f"<launch>{load}{spawner}</launch>",
    }
    workspace.package(files, ros=1)
    assert [text for text, _ in findings(workspace, "LNT013")] == ["left and right both claim a/effort, b/effort"]


def test_a_line_that_many_robots_run(workspace: Any) -> None:
    """One remap that is launched for each of two robots is one line to mend."""
    part = (
        '<launch><arg name="id"/>\n<node pkg="pkg" type="hand" name="hand$(arg id)"/>\n'
        '<node pkg="pkg" type="arm" name="arm$(arg id)">\n'
        '<remap from="~state" to="/hand$(arg id)/state"/>\n<remap from="gone" to="/gone$(arg id)"/></node></launch>'
    )
    one = '<include file="$(find pkg)/launch/part.launch"><arg name="id" value="{}"/></include>'
    main = '#include <ros/ros.h>\nint main(int c, char** v) {{\n  ros::init(c, v, "a");\n  ros::NodeHandle n("~");\n'
    main += '  auto p = n.advertise<std_msgs::String>("state", 1);\n  ros::spin();\n}}\n'
    cmake = "project(pkg)\nadd_executable(arm arm.cpp)\nadd_executable(hand hand.cpp)\ncatkin_package()\n"
    files = {
        "launch/part.launch": part,
        "launch/all.launch": f"<launch>{one.format(1)}{one.format(2)}</launch>",
        "arm.cpp": main.format(),
        "hand.cpp": main.format(),
        "CMakeLists.txt": cmake,
    }
    workspace.package(files, ros=1)
    assert [text.split(" is absolute")[0] for text, _ in findings(workspace, "LNT042")] == ["/hand1/state"]
    assert [text.split(" has nothing")[0] for text, _ in findings(workspace, "LNT006")] == ["/arm1"]


def test_a_topic_that_all_copies_of_a_node_write(workspace: Any) -> None:
    """Two launch files start two and three of them: the line that publishes is one."""
    main = '#include <ros/ros.h>\nint main(int c, char** v) {\n  ros::init(c, v, "a");\n  ros::NodeHandle n;\n'
    main += '  auto p = n.advertise<geometry_msgs::Twist>("/cmd_vel", 1);\n  ros::spin();\n}\n'
    start = '<node pkg="pkg" type="arm" name="arm{}"/>'
    files = {
        "launch/two.launch": f"<launch>{''.join(map(start.format, range(2)))}</launch>",
        "launch/many.launch": f"<launch>{''.join(map(start.format, range(7)))}</launch>",
        "arm.cpp": main,
        "CMakeLists.txt": "project(pkg)\nadd_executable(arm arm.cpp)\ncatkin_package()\n",
    }
    workspace.package(files, ros=1)
    ((text, lines),) = findings(workspace, "LNT012")
    assert (text, lines) == ("/arm0, /arm1, /arm2, /arm3, /arm4 and 2 more all publish /cmd_vel", 1)
