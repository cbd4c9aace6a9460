"""What modules can run: how much is read for it."""

from __future__ import annotations

import cProfile
import pstats
from pathlib import Path

import pytest
from workspaces import Workspace

from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

_HELPER = """
#include <rclcpp/rclcpp.hpp>
void report(rclcpp::Node & node) { node.create_publisher<std_msgs::msg::String>("report", 1); }
void relay(rclcpp::Node & node) { report(node); }
"""
_MAIN = """
#include "helper.hpp"
int main() { auto node = rclcpp::Node("node"); relay(node); }
"""


def _programs(workspace: Workspace, count: int) -> None:
    """A package of programs that share a helper."""
    mains = {f"src/main{number}.cpp": _MAIN for number in range(count)}
    targets = "\n".join(f"add_executable(main{number} src/main{number}.cpp)" for number in range(count))
    build = f"project(pkg)\ninclude_directories(include)\n{targets}\n"
    workspace.package({"include/helper.hpp": _HELPER, "CMakeLists.txt": build, **mains})


def _looked_up(root: Path) -> int:
    """How often it was asked what a name of a body can mean."""
    packages = Reader(open_tree(root), cached=False).read(1, None)
    profile = cProfile.Profile()
    profile.runcall(Linker(packages, form_table()).link)
    calls = pstats.Stats(profile).stats.items()  # type: ignore[attr-defined]
    return sum(counts[1] for (_, _, name), counts in calls if name == "seen_constants")


def test_what_a_name_leads_to_is_asked_once_for_all_modules(tmp_path: Path) -> None:
    """Ten programs that share a helper ask as much as two: what it leads to does not depend on who runs it."""
    two, ten = Workspace(tmp_path / "two"), Workspace(tmp_path / "ten")
    for workspace, count in ((two, 2), (ten, 10)):
        workspace.root.mkdir()
        _programs(workspace, count)
        modules = workspace.modules().values()
        assert sum("/report" in {entry.name for entry in each.signature.interfaces} for each in modules) == count
    assert 0 < _looked_up(ten.root) == _looked_up(two.root)


_MONITOR = """
import rclpy
from std_msgs.msg import String


class {name}Monitor:
    def run(self):
        node = rclpy.create_node("{low}")
        node.create_subscription(String, "{low}", self.called, 10)

    @staticmethod
    def main():
        {name}Monitor().run()


if __name__ == "__main__":
    {name}Monitor.main()
"""


def _subscribed(workspace: Workspace) -> dict[str, set[str]]:
    return {name: {each.name for each in module.signature.interfaces} for name, module in workspace.modules().items()}


def test_a_method_that_is_asked_of_a_class_is_that_of_no_other_program(workspace: Workspace) -> None:
    """`OneMonitor.main()` runs nothing of `TwoMonitor.main`, which another program of the package has."""
    scripts = {f"pkg/{low}.py": _MONITOR.format(name=low.title(), low=low) for low in ("one", "two")}
    build = "project(pkg)\ninstall(PROGRAMS pkg/one.py pkg/two.py DESTINATION lib/${PROJECT_NAME})\n"
    workspace.package({**scripts, "CMakeLists.txt": build})
    assert _subscribed(workspace) == {"ecm.pkg.one": {"/one"}, "ecm.pkg.two": {"/two"}}


def _made_by_demo(workspace: Workspace, files: dict[str, str]) -> set[str]:
    workspace.package(files, ros=1)
    for path in files:
        (workspace.root / "pkg" / path).chmod(0o755)
    return _subscribed(workspace)["ecm.pkg.demo"]


_HOLDING = {
    "python": """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String


class Inner:
    def begin(self):
        self.load()

    def load(self):
        rospy.Publisher("inner", String, queue_size=1)


class Outer:
    def __init__(self):
        self.inner = Inner()
        self.inner.begin()

    def load(self):
        rospy.Publisher("outer", String, queue_size=1)


rospy.init_node("demo")
Outer()
""",
    "cpp": """
#include <ros/ros.h>
#include <std_msgs/String.h>
class Inner {
 public:
  void begin() { {call}load(); }
  void load() { pub_ = nh_.advertise<std_msgs::String>("inner", 1); }
  ros::NodeHandle nh_;
  ros::Publisher pub_;
};
class Outer {
 public:
  Outer() { inner_.begin(); }
  void load() { pub_ = nh_.advertise<std_msgs::String>("outer", 1); }
  Inner inner_;
  ros::NodeHandle nh_;
  ros::Publisher pub_;
};
int main(int argc, char ** argv) { ros::init(argc, argv, "demo"); Outer outer; ros::spin(); }
""",
}


@pytest.mark.parametrize(("language", "call"), [("python", ""), ("cpp", "this->"), ("cpp", "")])
def test_a_method_that_an_object_calls_itself_is_that_of_its_class(
    workspace: Workspace, language: str, call: str
) -> None:
    """`self.load()` of one class runs nothing of another class that is made, too, and has a method of that name."""
    path = {"python": "scripts/demo.py", "cpp": "src/demo.cpp"}[language]
    assert _made_by_demo(workspace, {path: _HOLDING[language].replace("{call}", call)}) == {"/inner"}


_MIXED = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String


class Part:
    def begin(self):
        self.load()

    def load(self):
        pass


class Other:
    def load(self):
        rospy.Publisher("other", String, queue_size=1)


class Whole(Other, Part):
    pass


rospy.init_node("demo")
Whole().begin()
"""


def test_a_method_of_a_base_beside_another_is_run_in_its_place(workspace: Workspace) -> None:
    """Which of two bases has the method, a class that derives from both says, not the one that calls it."""
    assert _made_by_demo(workspace, {"scripts/demo.py": _MIXED}) == {"/other"}
