"""What a method does that is called through a base is of the programs that make an object which has it."""

from __future__ import annotations

from typing import Any

BASE = """#pragma once
#include <ros/ros.h>
#include <memory>
#include <vector>

struct Settings {
  typedef std::shared_ptr<Settings> Ptr;
  static void read(const std::vector<Settings::Ptr>& all, ros::NodeHandle& nh);
  virtual void load(const ros::NodeHandle& nh) = 0;
};
"""
ALL = """#include "pkg/settings.hpp"

void Settings::read(const std::vector<Settings::Ptr>& all, ros::NodeHandle& nh)
{
  for (const Settings::Ptr& one : all) {
    one->load(nh);
  }
}
"""
KIND = """#pragma once
#include "pkg/settings.hpp"

struct KIND : public Settings {
  void load(const ros::NodeHandle& nh) override;
};

void run_KIND(ros::NodeHandle& nh);
"""
KIND_SOURCE = """#include "pkg/KIND.hpp"

void KIND::load(const ros::NodeHandle& nh)
{
  double found;
  nh.getParam("KIND_rate", found);
}

void run_KIND(ros::NodeHandle& nh)
{
  Settings::read({std::make_shared<KIND>()}, nh);
}
"""
PROGRAM = """#include "pkg/KIND.hpp"

int main(int argc, char** argv)
{
  ros::init(argc, argv, "KIND");
  ros::NodeHandle nh;
  run_KIND(nh);
  ros::spin();
}
"""
BUILD = """project(pkg)
find_package(catkin REQUIRED COMPONENTS roscpp)
include_directories(include)
add_library(all src/settings.cpp src/Play.cpp src/Record.cpp)
add_executable(Play src/Play_main.cpp)
target_link_libraries(Play all)
add_executable(Record src/Record_main.cpp)
target_link_libraries(Record all)
"""


def test_a_program_has_the_parameters_of_the_objects_that_it_makes(workspace: Any) -> None:
    """Each of two programs was told the parameters that only an object of the other one reads."""
    files = {"CMakeLists.txt": BUILD, "include/pkg/settings.hpp": BASE, "src/settings.cpp": ALL}
    for kind in ("Play", "Record"):
        files[f"include/pkg/{kind}.hpp"] = KIND.replace("KIND", kind)
        files[f"src/{kind}.cpp"] = KIND_SOURCE.replace("KIND", kind)
        files[f"src/{kind}_main.cpp"] = PROGRAM.replace("KIND", kind)
    modules = workspace.package(files, ros=1).modules()
    for kind in ("Play", "Record"):
        contract = next(each for name, each in modules.items() if name.casefold().endswith(f".{kind.casefold()}"))
        assert {each.name for each in contract.signature.interfaces} == {f"/{kind}_rate"}
