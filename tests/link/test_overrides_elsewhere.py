"""A base calls what derived classes of other packages, which it does not know, put in the place of its own methods."""

from __future__ import annotations

from typing import Any

PACKAGE = (
    '<package format="3"><name>{name}</name><version>1.0.0</version>{depends}'
    "<export><build_type>{build}</build_type></export></package>"
)
BASE = """
#pragma once
#include <rclcpp/rclcpp.hpp>
namespace core {
std::string replaced(const std::string & pattern);
class Tools { public:
  explicit Tools(rclcpp::Node::SharedPtr node) : node_(node) {}
  void open() { pub_ = node_->create_publisher<std_msgs::msg::String>("opened_" + replaced(pattern_), 1); }
  void leave() { pub_ = node_->create_publisher<std_msgs::msg::String>("left_" + replaced(pattern_), 1); }
  rclcpp::Node::SharedPtr node_; std::string pattern_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
class Part { public:
  explicit Part(std::shared_ptr<Tools> tools) : tools_(tools) {}
  void start() { take_up(); }
  virtual void take_up() = 0;
  virtual void put_down() {}
  std::shared_ptr<Tools> tools_;
};
}
"""
ARM = """
#include "core/part.hpp"
class Arm : public core::Part { public:
  explicit Arm(std::shared_ptr<core::Tools> tools) : Part(tools) { start(); }
  void take_up() override { tools_->open(); }
  void put_down() override { tools_->leave(); }
};
int main(int c, char ** v) {
  rclcpp::init(c, v);
  auto node = rclcpp::Node::make_shared("arm");
  auto arm = std::make_shared<Arm>(std::make_shared<core::Tools>(node));
  rclcpp::spin(node);
}
"""


def test_a_method_that_overrides_one_of_another_package_runs_where_that_is_called(workspace: Any) -> None:
    """The program makes an object whose base calls it; what nobody calls it does not have."""
    core = {"include/core/part.hpp": BASE, "src/core.cpp": '#include "core/part.hpp"\n'}
    core["package.xml"] = PACKAGE.format(name="core", depends="", build="ament_cmake")
    core["CMakeLists.txt"] = (
        "project(core)\nadd_library(core src/core.cpp)\ntarget_include_directories(core PUBLIC include)\n"
    )
    workspace.package(core, name="core")
    build = "project(pkg)\nfind_package(core REQUIRED)\nadd_executable(arm src/arm.cpp)\nament_target_dependencies(arm core)\n"
    depends = PACKAGE.format(name="pkg", depends="<depend>core</depend>", build="ament_cmake")
    modules = workspace.package({"package.xml": depends, "CMakeLists.txt": build, "src/arm.cpp": ARM}).modules()
    found = modules["ecm.pkg.arm"].signature.interfaces
    assert [entry.name.partition("_")[0] for entry in found] == ["/opened"]
