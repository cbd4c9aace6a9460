"""What modules can run: how much is read for it."""

from __future__ import annotations

import cProfile
import pstats
from pathlib import Path

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
