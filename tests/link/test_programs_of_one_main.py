"""One main function that several targets compile, with other sources each."""

from __future__ import annotations

from typing import Any

MAIN = """
#include "left.hpp"
#include "right.hpp"
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
#ifdef LEFT
  Left part(nh);
#else
  Right part(nh);
#endif
  nh.advertise<std_msgs::Bool>("shared", 1);
  ros::spin();
}
"""
HEADER = "#pragma once\n#include <ros/ros.h>\n#include <std_msgs/Bool.h>\nclass {0} {{ public: explicit {0}(ros::NodeHandle & nh); ros::Publisher pub_; }};\n"
SOURCE = '#include "{1}.hpp"\n{0}::{0}(ros::NodeHandle & nh) {{ pub_ = nh.advertise<std_msgs::Bool>("{1}", 1); }}\n'
FILES = {
    "src/main.cpp": MAIN,
    **{f"src/{low}.hpp": HEADER.format(name) for name, low in (("Left", "left"), ("Right", "right"))},
    **{f"src/{low}.cpp": SOURCE.format(name, low) for name, low in (("Left", "left"), ("Right", "right"))},
}
TWO = "add_executable(one src/main.cpp src/left.cpp)\nadd_executable(two src/main.cpp src/right.cpp)\n"
TEST = "catkin_add_gtest(tests test/all.cpp src/left.cpp src/right.cpp)\n"
LIBRARY = (
    "add_library(parts src/left.cpp src/right.cpp)\n"
    "add_executable(one src/main.cpp)\nadd_executable(two src/main.cpp)\n"
    "target_link_libraries(one parts)\ntarget_link_libraries(two parts)\n"
)


def _told(workspace: Any, cmake: str) -> dict[str, set[str]]:
    modules = workspace.package({"CMakeLists.txt": f"project(pkg)\n{cmake}", **FILES}, ros=1).modules()
    return {
        name.removeprefix("ecm.pkg."): {entry.name for entry in module.signature.interfaces}
        for name, module in modules.items()
    }


def test_each_program_is_told_with_what_it_compiles(workspace: Any) -> None:
    """A second program of a main function is one too, and has nothing of the sources that only the first compiles."""
    assert _told(workspace, TWO) == {"one": {"/shared", "/left"}, "two": {"/shared", "/right"}}


def test_a_test_that_compiles_the_sources_too_changes_nothing(workspace: Any) -> None:
    """What tests compile is no library that programs link."""
    assert _told(workspace, TWO + TEST) == {"one": {"/shared", "/left"}, "two": {"/shared", "/right"}}


def test_what_a_library_has_every_program_may_run(workspace: Any) -> None:
    """Sources of a library are of both, under the conditions that stand in the code."""
    every = {"/shared", "/left", "/right"}
    assert _told(workspace, LIBRARY) == {"one": every, "two": every}


def test_one_name_for_two_ways_to_build_is_one_program(workspace: Any) -> None:
    """A branch of the build that adds sources makes no second program."""
    cmake = "if(SIMULATED)\nadd_executable(one src/main.cpp src/left.cpp)\nelse()\nadd_executable(one src/main.cpp src/right.cpp)\nendif()\n"
    assert set(_told(workspace, cmake)) == {"one"}
