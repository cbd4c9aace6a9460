"""What a framework calls first finds an object as it was made, whatever other methods do to it later."""

from __future__ import annotations

from typing import Any

_CONTROLLER = """
#include <controller_interface/controller_interface.hpp>
namespace pkg {{
{struct}
class Drive : public controller_interface::ControllerInterface {{
 public:
  Drive() : Drive::ControllerInterface() {{ {made} }}
  CallbackReturn on_init() override {{
    auto_declare<bool>("stamped", stamped_);
    auto_declare<std::string>("frame", odometry_.frame);
    auto_declare<double>("radius", wheels_.radius);
    auto_declare<double>("rate", rate_);
    rate_ = 7.0;
    odometry_.frame = "later";
    auto_declare<std::string>("second", odometry_.frame);
    return CallbackReturn::SUCCESS;
  }}
  CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {{
    stamped_ = get_node()->get_parameter("stamped").as_bool();
    odometry_.frame = get_node()->get_parameter("frame").as_string();
    wheels_.radius = get_node()->get_parameter("radius").as_double();
    rate_ = get_node()->get_parameter("rate").as_double();
    auto_declare<bool>("again", stamped_);
    return CallbackReturn::SUCCESS;
  }}
{more}
 private:
  struct Odometry {{ std::string frame = "odom"; }} odometry_;
  Wheels wheels_{{0.3, 0.05}};
  bool stamped_ = true;
  double rate_ = 50.0;
}};
}}
#include "pluginlib/class_list_macros.hpp"
PLUGINLIB_EXPORT_CLASS(pkg::Drive, controller_interface::ControllerInterface)
"""


_WHEELS = "struct Wheels { double separation; double radius; };"


def _defaults(workspace: Any, made: str = "", more: str = "", struct: str = _WHEELS) -> dict[str, Any]:
    cmake = "add_library(drive SHARED src/drive.cpp)\n"
    workspace.package(
        {"src/drive.cpp": _CONTROLLER.format(made=made, more=more, struct=struct), "CMakeLists.txt": cmake}
    )
    return {
        each.name: each.default
        for module in workspace.modules().values()
        for each in module.signature.interfaces
        if each.role == "parameter"
    }


def test_a_controller_is_initialised_before_it_is_configured(workspace: Any) -> None:
    """`on_init` declares what the members begin with; `on_configure` finds what anybody set."""
    found = _defaults(workspace)
    assert {name: found[name] for name in ("stamped", "frame", "radius", "rate", "second")} == {
        "stamped": True,
        "frame": "odom",
        "radius": 0.05,
        "rate": 50.0,
        "second": "later",
    }
    assert found["again"] is not True


def test_what_a_constructor_gives_is_no_default_of_the_class(workspace: Any) -> None:
    """It runs before the first method."""
    found = _defaults(workspace, made='rate_ = 20.0; odometry_.frame = "map"; wheels_ = Wheels{1.0, 2.0};')
    assert (found["rate"], found["frame"], found["radius"]) != (50.0, "odom", 0.05)
    assert found["rate"] in {20.0, None}
    assert found["frame"] in {"map", None}
    assert found["radius"] in {2.0, None}


def test_what_a_constructor_calls_runs_before_as_well(workspace: Any) -> None:
    """A method that it calls, and who gets the address of a member, may give that something."""
    reset = '  void reset() { stamped_ = false; odometry_.frame = "map"; }'
    found = _defaults(workspace, made="reset(); fill(&rate_);", more=reset)
    assert found["stamped"] is not True
    assert found["frame"] != "odom"
    assert found["rate"] is None


def test_braces_fill_what_is_of_the_object(workspace: Any) -> None:
    """A `static` field of the class takes none of the values."""
    found = _defaults(
        workspace, struct="struct Wheels { static constexpr int COUNT = 4; double separation; double radius; };"
    )
    assert found["radius"] == 0.05


def test_who_calls_it_again_finds_what_is_there_then(workspace: Any) -> None:
    """A method that the class calls itself is no first one."""
    found = _defaults(workspace, more="  void reset() { stamped_ = false; on_init(); }")
    assert found["stamped"] is not True
