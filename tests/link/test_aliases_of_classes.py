"""What a type asks a class for is that class's: every class of a tree may call its pointers `SharedPtr`."""

from __future__ import annotations

from typing import Any

import pytest

TOOLS = """
#pragma once
#include <rclcpp/rclcpp.hpp>
namespace core {{
std::string replaced(const std::string & pattern);
using Said = std_msgs::msg::String;
class Tools {{ public:
  using SharedPtr = std::shared_ptr<Tools>;
  explicit Tools(rclcpp::Node::SharedPtr node) : node_(node) {{}}
  void left() {{ left_ = node_->create_publisher<std_msgs::msg::String>("left_" + replaced(pattern_), 1); }}
  void right() {{ right_ = node_->create_publisher<std_msgs::msg::Bool>("right_" + replaced(pattern_), 1); }}
  rclcpp::Node::SharedPtr node_; std::string pattern_;
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr left_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr right_;
}};
class Base : public rclcpp::Node {{ public:
  explicit Base(const std::string & name) : Node(name) {{}}
  void init() {{ tools_ = std::make_shared<Tools>(shared_from_this()); begin(); }}
  virtual void begin() = 0;
  void said(const Said::SharedPtr msg);
  {held} tools_;
}};
class Left {{ public:
  using SharedPtr = std::shared_ptr<Left>;
  explicit Left(Tools::SharedPtr tools) {{ tools->left(); }}
}};
class Right {{ public:
  using SharedPtr = std::shared_ptr<Right>;
  explicit Right(Tools::SharedPtr tools) {{ tools->right(); }}
}};
}}
"""
MAIN = """
#include "tools.hpp"
class {side}Node : public core::Base {{ public:
  {side}Node() : Base("{name}") {{}}
  void begin() override {{ made_ = std::make_shared<core::{side}>(tools_); }}
  core::{side}::SharedPtr made_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); auto node = std::make_shared<{side}Node>(); node->init(); rclcpp::spin(node); }}
"""
BUILD = "project(pkg)\nadd_executable(left src/left.cpp)\nadd_executable(right src/right.cpp)\n"


@pytest.mark.parametrize("held", ["Tools::SharedPtr", "core::Tools::SharedPtr", "std::shared_ptr<Tools>"])
def test_a_pointer_of_one_class_leads_to_no_other_class(workspace: Any, held: str) -> None:
    """Each program had what the parts of all others ask a helper for."""
    mains = {f"src/{side.lower()}.cpp": MAIN.format(side=side, name=side.lower()) for side in ("Left", "Right")}
    files = {"CMakeLists.txt": BUILD, "src/tools.hpp": TOOLS.format(held=held), **mains}
    modules = workspace.package(files).modules()
    names = {
        name.rpartition(".")[2]: {entry.name.partition("_")[0] for entry in module.signature.interfaces}
        for name, module in modules.items()
    }
    assert {name: found for name, found in names.items() if found} == {"left": {"/left"}, "right": {"/right"}}
