"""Parameters that a helper reads of a node which takes what it does not declare: whoever makes the node says so."""

from __future__ import annotations

from typing import Any

import pytest

SETTINGS = """
#include <rclcpp/rclcpp.hpp>
class Settings {
public:
  void load(const rclcpp::Node * node) {
    if (node->has_parameter("level")) node->get_parameter("level", level_);
  }
  int level_ = 0;
};
"""
CAMERA = """
#include "settings.hpp"
class Camera : public rclcpp::Node {
public:
  explicit Camera(const rclcpp::NodeOptions & options) : Node("camera", options) { settings_.load(this); }
  Settings settings_;
};
"""
MAIN = """
#include "camera.hpp"
int main(int argc, char ** argv) {{
  rclcpp::NodeOptions options;
  options.automatically_declare_parameters_from_overrides({says});
  rclcpp::spin(std::make_shared<Camera>(options));
}}
"""


@pytest.mark.parametrize(("says", "names"), [("true", {"level"}), ("false", set())])
def test_what_a_member_of_a_node_reads_is_a_parameter_where_the_node_takes_any(
    workspace: Any, says: str, names: set[str]
) -> None:
    """The helper is no node: the class that has it, or whoever makes that one, says what is taken."""
    files = {"src/settings.hpp": SETTINGS, "src/camera.hpp": CAMERA, "src/main.cpp": MAIN.format(says=says)}
    found = workspace.package(files).interfaces()
    assert {each.name for each in found if each.role == "parameter"} == names


HELPERS = [
    (
        "free",
        "template <typename T> T asked(rclcpp::Node::SharedPtr node, const std::string & name) {{ {body} }}",
        "asked",
    ),
    (
        "static",
        "class Utils {{ public: template <typename T> static T asked(rclcpp::Node::SharedPtr node, const std::string & name) {{ {body} }} }};",
        "Utils::asked",
    ),
]
READS = "T value; if (!node->get_parameter(name, value)) throw std::runtime_error(name); return value;"
CONFIG = """
#include "utils.hpp"
class Config {{ public:
  using SharedPtr = std::shared_ptr<Config>;
  explicit Config(rclcpp::Node::SharedPtr node) : node_(node) {{ parse(); }}
  void parse() {{ level_ = {call}<int>(node_, "level"); }}
  rclcpp::Node::SharedPtr node_; int level_;
}};
class Camera : public rclcpp::Node {{ public:
  explicit Camera(const rclcpp::NodeOptions & options) : Node("camera", options) {{}}
  void init() {{ config_ = std::make_shared<Config>(shared_from_this()); }}
  Config::SharedPtr config_;
}};
"""


@pytest.mark.parametrize(("says", "names"), [("true", {"level"}), ("false", set())])
@pytest.mark.parametrize(("helper", "call"), [row[1:] for row in HELPERS], ids=[row[0] for row in HELPERS])
def test_who_calls_a_function_without_an_object_says_what_its_node_takes(
    workspace: Any, helper: str, call: str, says: str, names: set[str]
) -> None:
    """The function that reads has no node: it is given that of its callers."""
    files = {
        "src/utils.hpp": "#include <rclcpp/rclcpp.hpp>\n" + helper.format(body=READS),
        "src/camera.hpp": CONFIG.format(call=call),
        "src/main.cpp": MAIN.format(says=says),
    }
    found = workspace.package(files).interfaces()
    assert {(each.name, each.type) for each in found if each.role == "parameter"} == {
        (name, "integer") for name in names
    }


CONTROLLER = """
#include "controller_interface/controller_interface.hpp"
class Held : public controller_interface::ControllerInterface {{
public:
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {{ {body} }}
  std::string level_;
}};
PLUGINLIB_EXPORT_CLASS(Held, controller_interface::ControllerInterface)
"""


@pytest.mark.parametrize(
    "body",
    [
        'get_node()->get_parameter("level", level_);',
        'auto read = rclcpp::Parameter(); if (!get_node()->get_parameter("level", read)) return CallbackReturn::ERROR; level_ = read.as_string();',
    ],
)
def test_controllers_take_what_they_do_not_declare(workspace: Any, body: str) -> None:
    """Their base makes the node, with both options."""
    entry = workspace.package({"src/held.cpp": CONTROLLER.format(body=body)}).only("parameter")
    assert (entry.name, entry.type, entry.default) == ("level", "string", None)


ARM = """
#include <rclcpp/rclcpp.hpp>
class Arm : public rclcpp::Node {{
public:
  explicit Arm(const rclcpp::NodeOptions & options = rclcpp::NodeOptions().allow_undeclared_parameters({says}));
  double rate_;
}};
"""
ARM_SOURCE = """
#include "arm.hpp"
Arm::Arm(const rclcpp::NodeOptions & options) : Node("arm", options) { rate_ = get_parameter("rate").as_double(); }
int main(int argc, char ** argv) {
  rclcpp::spin(std::make_shared<Arm>());
}
"""


@pytest.mark.parametrize(("says", "names"), [("true", {"rate"}), ("false", set())])
def test_options_that_a_constructor_has_by_default_say_what_its_node_takes(
    workspace: Any, says: str, names: set[str]
) -> None:
    """The default stands where the constructor is declared, not where it is defined."""
    found = workspace.package({"src/arm.hpp": ARM.format(says=says), "src/main.cpp": ARM_SOURCE}).interfaces()
    assert {each.name for each in found if each.role == "parameter"} == names


DERIVED = """
#include "joint_trajectory_controller/joint_trajectory_controller.hpp"
class Scaled : public {base} {{
public:
  CallbackReturn on_activate(const rclcpp_lifecycle::State & state) override {{
    if (get_node()->has_parameter("order")) order_ = get_node()->get_parameter("order").as_int();
    return CallbackReturn::SUCCESS;
  }}
  int order_ = 1;
}};
PLUGINLIB_EXPORT_CLASS(Scaled, controller_interface::ControllerInterface)
"""
BASES = [
    ("controller_interface::ControllerInterface", {"order"}),
    ("joint_trajectory_controller::JointTrajectoryController", {"order"}),
    ("steering_controllers_library::SteeringControllersLibrary", {"order"}),
    ("elsewhere::Base", set()),
]


@pytest.mark.parametrize(("base", "names"), BASES, ids=[row[0] for row in BASES])
def test_controllers_take_what_they_do_not_declare_also_by_others(workspace: Any, base: str, names: set[str]) -> None:
    """A controller that another one of ros2_controllers is the base of has its node from the same one."""
    found = workspace.package({"src/scaled.cpp": DERIVED.format(base=base)}).interfaces()
    assert {row.name for row in found if row.role == "parameter"} == names
