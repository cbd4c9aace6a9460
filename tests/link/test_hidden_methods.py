"""What a class defines under another name of itself is its own, and what nobody can call it does not have."""

from __future__ import annotations

from typing import Any

HEADER = """
#pragma once
#include <controller_interface/controller_interface.hpp>
namespace own {
class Arm : public controller_interface::ControllerInterface {
public:
  controller_interface::CallbackReturn on_init() override;
private:
  void listen();
  void listen_later();
  void listen_never();
  std::function<void()> later_;
};
}
"""
SOURCE = """
#include "arm.hpp"
#include <pluginlib/class_list_macros.hpp>
namespace own {
namespace ci = controller_interface;
using Self = Arm;
ci::CallbackReturn Self::on_init() {
  auto_declare<double>("rate", 1.0);
  listen();
  later_ = std::bind(&Self::listen_later, this);
  return ci::CallbackReturn::SUCCESS;
}
void Self::listen() { get_node()->create_publisher<std_msgs::msg::String>("called", 1); }
void Self::listen_later() { get_node()->create_publisher<std_msgs::msg::String>("later", 1); }
void Self::listen_never() { get_node()->create_publisher<std_msgs::msg::String>("never", 1); }
}
PLUGINLIB_EXPORT_CLASS(own::Arm, controller_interface::ControllerInterface)
"""


def _controller(workspace: Any) -> set[str]:
    found = workspace.package({"include/arm.hpp": HEADER, "src/arm.cpp": SOURCE}).modules().values()
    told = [each for each in found if each.ecm.kind == "controller"]
    return {entry.name for each in told for entry in each.signature.interfaces}


def test_methods_under_another_name_of_the_class_are_its_own(workspace: Any) -> None:
    """`using Self = Arm; void Self::listen() {}`: the controller has what they declare."""
    assert {"rate", "/called", "/later"} <= _controller(workspace)


def test_a_private_method_that_nobody_names_is_none_of_the_controller(workspace: Any) -> None:
    """Nobody outside of the class can call it, and nobody inside does."""
    assert "/never" not in _controller(workspace)
