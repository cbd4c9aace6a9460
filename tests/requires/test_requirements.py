"""What packages require: one row for each way in which an artefact depends on a name."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.hub.kinds import kinds, uses
from ecm_checker.match.names import NAMES
from workspaces import Workspace

from ecm_extract.entities.workspace import read_workspace
from ecm_extract.extraction_model import Options
from ecm_extract.requires.collect import requirements
from ecm_extract.tree import open_tree

NODE = """#include <arm_lib/arm.hpp>
#include <vector>
namespace user {
class Mine : public arm_lib::Arm {
 public:
  int grip(double force) override;
};
void use(arm_lib::Arm & arm, std::shared_ptr<arm_lib::Hand> hand) {
  arm.move(1, 2);
  hand->open();
  int size = arm.size;
  arm_lib::reset(3);
}
}
"""
SCRIPT = """from arm_lib.tools import Gripper, count
import arm_lib.other
from arm_msgs.msg import Force


def use():
    message = Force()
    message.value = 1
    left, right = count()
    Gripper(speed=2)
    arm_lib.other.reset()
"""
LAUNCH_XML = """<launch>
  <include file="$(find arm_bringup)/launch/arm.launch">
    <arg name="side" value="left"/></include>
  <node pkg="arm" type="arm_node" name="arm" if="$(arg real)">
    <param name="rate" value="3"/>
    <remap from="joints" to="/arm/joints"/>
  </node>
  <rosparam file="$(find arm_bringup)/config/arm.yaml"/>
  <node pkg="nodelet" type="nodelet" name="hand" args="load hand/Hand manager">
    <param name="force" value="3"/>
    <remap from="hand/state" to="arm/state"/>
  </node>
</launch>
"""
PARAMETERS = """arm_node:
  ros__parameters:
    rate: 3
    plugin: "arm_lib::Simple"
    base_frame: tool
"""
ANALYZERS = """pub_rate: 1.0
analyzers:
  power:
    type: diagnostic_aggregator/GenericAnalyzer
    path: Power
    remove_prefix: arm_driver
    contains: [Battery]
  other:
    type: diagnostic_aggregator/GenericAnalyzer
    path: Other
    remove_prefix: "the arm: "
"""
SWITCH = """#include <hardware_interface/system_interface.hpp>
namespace arm {
hardware_interface::return_type Hardware::prepare_command_mode_switch(
  const std::vector<std::string> & start, const std::vector<std::string> & stop) {
  for (const auto & each : start) {
    effort_ = effort_ || each.substr(each.find("/") + 1) == "effort";
  }
  return hardware_interface::return_type::OK;
}
}
"""
CONTAINED = """<launch>
  <node pkg="nodelet" type="nodelet" name="hand" args="load hand/Hand /manager"/>
</launch>
"""
TREE = """<root main_tree_to_execute="Main"><BehaviorTree ID="Main">
<Grip force="3"/>
</BehaviorTree></root>
"""
XACRO = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:include filename="$(find arm_description)/urdf/arm.xacro"/>
<link name="own"/>
<joint name="j" type="fixed"><parent link="tool"/><child link="own"/></joint>
</robot>
"""
REACHED = """#include <arm_lib/arm.hpp>
namespace user {
class Mine : public arm_lib::Arm {
 public:
  void run(int count);
  int own_;
};
void Mine::run(int count) {
  own_ = count;
  joints_[0].turn(1, 2);
  stop();
  for (auto & found : arm_lib::read_all()) {
    use(found.label);
  }
  std::vector<arm_lib::Hand> hands;
  hands[0].open();
}
}
"""
BUILD = """project(pkg)
find_package(arm_lib REQUIRED)
add_library(user src/user.cpp)
target_link_libraries(user arm_lib::arm_core ${arm_msgs_TARGETS})
"""
RVIZ = """Panels:
  - Class: rviz_common/Displays
Visualization Manager:
  Displays:
    - Class: arm_rviz/Force
      Name: Class
"""
PIPELINE = """pipeline:
  adapters: >-
    arm_adapters/First
    arm_adapters/Second
  note: two words
"""
CASES: dict[str, tuple[int, dict[str, str], list[dict[str, Any]]]] = {
    "C++": (
        2,
        {"src/user.cpp": NODE, "CMakeLists.txt": "project(pkg)\nadd_library(user src/user.cpp)\n"},
        [
            {"use": "includes", "kind": "file", "name": "arm_lib/arm.hpp", "line": 1},
            {"use": "derives", "kind": "class", "name": "arm_lib::Arm", "line": 4},
            {"use": "overrides", "kind": "method", "owner": "arm_lib::Arm", "name": "grip", "line": 6},
            {"use": "calls_method", "kind": "method", "owner": "arm_lib::Arm", "name": "move", "line": 9},
            {"use": "calls_method", "kind": "method", "owner": "arm_lib::Hand", "name": "open", "line": 10},
            {"use": "reads_member", "kind": "member", "owner": "arm_lib::Arm", "name": "size", "line": 11},
            {"use": "names_symbol", "kind": "class", "name": "arm_lib::reset", "line": 12},
        ],
    ),
    "what is reached in C++": (
        2,
        {"src/user.cpp": REACHED, "CMakeLists.txt": BUILD},
        [
            {"use": "reads_member", "owner": "arm_lib::Arm", "name": "joints_", "line": 10},
            {"use": "calls_method", "owner": "arm_lib::Arm.joints_", "name": "turn", "line": 10},
            {"use": "calls_method", "owner": "arm_lib::Arm", "name": "stop", "line": 11},
            {"use": "reads_member", "owner": "arm_lib::read_all()", "name": "label", "line": 13},
            {"use": "calls_method", "owner": "arm_lib::Hand", "name": "open", "line": 16},
        ],
    ),
    "build files": (
        2,
        {"src/user.cpp": "", "CMakeLists.txt": BUILD},
        [
            {"use": "depends", "kind": "package", "name": "arm_lib", "line": 2, "certainty": "likely"},
            {"use": "links", "kind": "library", "package": "arm_lib", "name": "arm_core", "line": 3},
        ],
    ),
    "RViz": (
        2,
        {"rviz/arm.rviz": RVIZ},
        [
            {"use": "loads_plugin", "name": "rviz_common/Displays", "line": 2},
            {"use": "loads_plugin", "name": "arm_rviz/Force", "line": 5},
        ],
    ),
    "plugins in one text": (
        2,
        {"config/pipeline.yaml": PIPELINE},
        [
            {"use": "loads_plugin", "name": "arm_adapters/First", "line": 2},
            {"use": "loads_plugin", "name": "arm_adapters/Second", "line": 2},
        ],
    ),
    "Python": (
        1,
        {"scripts/user.py": SCRIPT},
        [
            {"use": "imports", "name": "arm_lib.tools.Gripper", "line": 1},
            {"use": "imports", "name": "arm_lib.other", "line": 2},
            {"use": "reads_field", "owner": "arm_msgs.msg.Force", "name": "value", "line": 8},
            {"use": "takes_result", "name": "arm_lib.tools.count", "line": 9},
            {"use": "gives_keyword", "name": "arm_lib.tools.Gripper", "line": 10},
            {"use": "calls", "name": "arm_lib.tools.Gripper", "line": 10},
            {"use": "uses_name", "name": "arm_lib.other.reset", "line": 11},
        ],
    ),
    "launch": (
        1,
        {"launch/user.launch": LAUNCH_XML},
        [
            {"use": "includes_launch", "package": "arm_bringup", "name": "arm.launch", "line": 2},
            {"use": "includes_launch", "name": "arm.launch", "target": "launch/arm.launch", "line": 2},
            {"use": "gives_argument", "package": "arm_bringup", "owner": "arm.launch", "name": "side", "line": 3},
            {"use": "starts", "package": "arm", "name": "arm_node", "line": 4, "conditions": ("$(arg real)",)},
            {"use": "gives_parameter", "package": "arm", "name": "rate", "line": 5},
            {"use": "remaps", "package": "arm", "name": "joints", "target": "/arm/joints", "line": 6},
            {"use": "reads_file", "package": "arm_bringup", "name": "config/arm.yaml", "line": 8},
            {"use": "gives_parameter", "package": "hand", "name": "force", "line": 10},
            {"use": "remaps", "package": "hand", "name": "~/state", "target": "arm/state", "line": 11},
        ],
    ),
    "parameters": (
        2,
        {"config/arm.yaml": PARAMETERS},
        [
            {"use": "sets_parameter", "owner": "/arm_node", "name": "rate", "type": "integer", "value": 3, "line": 3},
            {"use": "loads_plugin", "name": "arm_lib::Simple", "line": 4},
            {"use": "names_frame", "name": "tool", "line": 5, "certainty": "likely"},
        ],
    ),
    "analyzers": (
        1,
        {"config/analyzers.yaml": ANALYZERS},
        [{"use": "strips_prefix", "kind": "node", "name": "arm_driver", "line": 3}],
    ),
    "switch": (
        2,
        {"src/hardware.cpp": SWITCH},
        [{"use": "answers_switch", "name": "*", "scope": "arm::Hardware", "line": 3}],
    ),
    "container": (
        1,
        {"launch/hand.launch": CONTAINED},
        [{"use": "loads_into", "name": "manager", "target": "/manager", "line": 2}],
    ),
    "behaviour tree": (
        2,
        {"trees/main.xml": TREE},
        [
            {"use": "names_bt_node", "name": "Grip", "line": 2},
            {"use": "sets_bt_port", "owner": "Grip", "name": "force", "line": 2},
        ],
    ),
    "description": (
        2,
        {"urdf/robot.xacro": XACRO},
        [
            {"use": "includes_description", "package": "arm_description", "name": "urdf/arm.xacro", "line": 2},
            {"use": "hangs_joint", "name": "tool", "line": 4, "certainty": "likely"},
        ],
    ),
}


def rows(workspace: Workspace) -> list[dict[str, Any]]:
    found = requirements(read_workspace(open_tree(workspace.root), Options(jobs=1, cache=False), {}))
    flat = [each for entries in found.values() for each in entries]
    fields = (
        "use",
        "kind",
        "package",
        "owner",
        "name",
        "type",
        "value",
        "certainty",
        "conditions",
        "scope",
        "said",
        "target",
    )
    return [{**{f: getattr(each, f) for f in fields}, "line": at.line} for each in flat for at in each.evidence]


@pytest.mark.parametrize(("ros", "files", "expected"), CASES.values(), ids=CASES)
def test_each_dependence_is_a_requirement(
    workspace: Workspace, ros: int, files: dict[str, str], expected: list[dict[str, Any]]
) -> None:
    """Each line that needs a name is told, with what it needs of whom."""
    found = rows(workspace.package(files, ros))
    missing = [want for want in expected if not any(want.items() <= row.items() for row in found)]
    assert not missing, found


def test_a_file_whose_name_the_launch_decides_is_nobodys(workspace: Workspace) -> None:
    """`$(arg arm)_arm.launch` is not `_arm.launch`."""
    text = '<launch><arg name="arm"/><include file="$(find arm)/launch/$(arg arm)_arm.launch"/></launch>'
    found = rows(workspace.package({"launch/a.launch": text}, 1))
    assert [(row["package"], row["certainty"]) for row in found if row["use"] == "includes_launch"] == [
        (None, "unknown")
    ]


def test_a_prefix_that_is_no_name_is_of_no_node(workspace: Workspace) -> None:
    found = rows(workspace.package({"config/analyzers.yaml": ANALYZERS}, 1))
    assert [row["name"] for row in found if row["use"] == "strips_prefix"] == ["arm_driver"]


@pytest.mark.parametrize("own", ['"joint_1/" + each', 'each == info_.joints[0].name + "/effort"'])
def test_who_looks_at_its_own_names_answers_for_itself(workspace: Workspace, own: str) -> None:
    text = SWITCH.replace('each.substr(each.find("/") + 1) == "effort"', f"mine({own})" if "joint_1" in own else own)
    found = rows(workspace.package({"src/hardware.cpp": text}))
    assert not [row for row in found if row["use"] == "answers_switch"]


def test_what_the_language_brings_is_not_required(workspace: Workspace) -> None:
    """Nobody provides the standard library."""
    found = rows(workspace.package(CASES["C++"][1]))
    assert not [row for row in found if row["name"].startswith("std::")]


def test_the_vocabulary_fits_together() -> None:
    """Each use means kinds that there are, and compares names in a way that there is."""
    for row in uses().values():
        assert set(row.of) <= kinds().keys()
        assert row.names in NAMES


OWN = """namespace user {
class Base { public: int size_; void stop(); };
class Mine : public Base {
 public:
  void run(int count);
};
void Mine::run(int count) {
  int local = count;
  size_ = local;
  stop();
  MINE_LOG(local);
}
}
"""


def test_what_a_package_has_itself_is_no_requirement(workspace: Workspace) -> None:
    """Members of its own bases, locals, parameters and macros are nobody else's."""
    files = {"src/user.cpp": OWN, "CMakeLists.txt": "project(pkg)\nadd_library(user src/user.cpp)\n"}
    assert not [row for row in rows(workspace.package(files, 2)) if row["use"] in {"reads_member", "calls_method"}]
