"""Parameters that must be set: a node that was started without them stops where the next release asks for one."""

from __future__ import annotations

import pytest
from diff_repos import node, package

CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n"
READ_ONLY = (
    "static rcl_interfaces::msg::ParameterDescriptor read_only() { return {}; }\n"
    "static int initial() { return setup(); }\n"
)
RATE = 'declare_parameter<int>("rate", 1);'
ROWS = [
    ('declare_parameter<int>("depth");', True),
    ('declare_parameter<int>("depth", read_only());', True),
    ('rcl_interfaces::msg::ParameterDescriptor d; declare_parameter<int>("depth", d);', True),
    ('{ rcl_interfaces::msg::ParameterDescriptor d; declare_parameter<int>("depth", d); }', True),
    ('declare_parameter<int>("depth", 5);', False),
    ('declare_parameter<int>("depth", initial());', False),
    ('declare_parameter("depth");', False),
    ('if (get_parameter("rate").as_int() > 3) { declare_parameter<int>("depth"); }', False),
    ('if (ready()) { return; } declare_parameter<int>("depth");', False),
    ('try { declare_parameter<int>("depth"); } catch (const std::exception &) {}', False),
]


def _arm(*lines: str) -> dict[str, str | None]:
    return {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": READ_ONLY + node(*lines)}


@pytest.mark.parametrize(("line", "breaks"), ROWS)
def test_a_new_parameter(changes, line: str, breaks: bool) -> None:  # type: ignore[no-untyped-def]
    """It breaks who starts the node where it surely has no default and is surely declared."""
    found = [each for each in changes(_arm(RATE), _arm(RATE, line)) if each["kind"] == "parameter"]
    assert [(each["change"], each["new"], each["breaking"]) for each in found] == [("added", "depth", breaks)]


def test_a_new_node(changes) -> None:  # type: ignore[no-untyped-def]
    """Nobody started it before, so nothing of it breaks anybody."""
    leg = node(RATE).replace("Arm", "Leg").replace('"arm"', '"leg"')
    other = {"arm/CMakeLists.txt": CMAKE.replace("arm src/arm.cpp", "leg src/leg.cpp"), "arm/src/leg.cpp": leg}
    found = changes(other, _arm(RATE, 'declare_parameter<int>("depth");'))
    assert not [each for each in found if each["kind"] == "parameter" and each["new"] == "depth" and each["breaking"]]


def test_a_default_that_goes(changes) -> None:  # type: ignore[no-untyped-def]
    """Who relied on it must set the parameter now."""
    found = changes(_arm(RATE, 'declare_parameter<int>("depth", 5);'), _arm(RATE, 'declare_parameter<int>("depth");'))
    assert [(each["change"], each["old"], each["breaking"]) for each in found] == [("default_changed", "depth", True)]


ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "rospy")
SCRIPT = """#!/usr/bin/env python3
import rospy


class Arm:
    def __init__(self):
        self.rate = rospy.get_param('~rate', 1)
{}
        self.begin()

    def begin(self):
        {}

    def tick(self, event):
        {}


if __name__ == '__main__':
    rospy.init_node('arm')
    Arm()
    rospy.spin()
"""
NEEDED = "rospy.get_param('~depth')"
IN_PYTHON = [
    ((NEEDED, "pass", "pass"), True),
    (("pass", f"self.depth = {NEEDED}", "pass"), True),
    (("pass", "pass", f"self.depth = {NEEDED}"), False),
    ((f"self.depth = {NEEDED[:-1]}, 5)", "pass", "pass"), False),
    ((f"self.depth = {NEEDED[:-1]}, default=5)", "pass", "pass"), False),
    ((f"self.depth = {NEEDED} if rospy.has_param('~depth') else 5", "pass", "pass"), False),
    ((f"self.depth = rospy.has_param('~depth') and {NEEDED}", "pass", "pass"), False),
    ((f"if rospy.has_param('~depth'): self.depth = {NEEDED}", "pass", "pass"), False),
    ((f"if not rospy.has_param('~depth'): raise ValueError()\n        self.depth = {NEEDED}", "pass", "pass"), True),
    (("pass", f"if rospy.has_param('~depth'): self.depth = {NEEDED}\n        else: raise ValueError()", "pass"), True),
    (("pass", f"try: self.depth = {NEEDED}\n        except KeyError: self.depth = 5", "pass"), False),
]


def _script(lines: tuple[str, str, str]) -> dict[str, str | None]:
    first, *others = lines
    install = "project(arm)\ncatkin_install_python(PROGRAMS scripts/arm.py DESTINATION lib/arm)\n"
    text = SCRIPT.format(f"        {first}", *others)
    return {"arm/package.xml": ROS1, "arm/CMakeLists.txt": install, "arm/scripts/arm.py": text}


@pytest.mark.parametrize(("lines", "breaks"), IN_PYTHON)
def test_a_new_parameter_of_rospy(changes, lines: tuple[str, str, str], breaks: bool) -> None:  # type: ignore[no-untyped-def]
    """Where the node surely asks for it as it starts, and has no default, it ends with a KeyError."""
    found = changes(_script(("pass", "pass", "pass")), _script(lines))
    assert [(each["change"], each["new"], each["breaking"]) for each in found if each["kind"] == "parameter"] == [
        ("added", "depth", breaks)
    ]


NODE1 = """#include <ros/ros.h>
class Arm {{
public:
  Arm() : nh_("~") {{
    nh_.param("rate", rate_, 1);
    {}
  }}
private:
  ros::NodeHandle nh_;
  int rate_, depth_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "arm"); Arm arm; ros::spin(); }}
"""
MISSING = '!nh_.getParam("depth", depth_)'
IN_ROS1 = [
    (f'if ({MISSING}) {{ ROS_FATAL("no"); throw std::runtime_error("no"); }}', True),
    (f"if ({MISSING}) exit(1);", True),
    (f'if (!nh_.getParam("rate", rate_) || {MISSING}) throw 1;', True),
    ('if (nh_.getParam("depth", depth_)) { begin(); } else { throw 1; }', True),
    ('if (nh_.hasParam("depth")) { nh_.getParam("depth", depth_); } else { throw 1; }', True),
    ('if (!nh_.hasParam("depth")) { throw 1; } nh_.getParam("depth", depth_);', True),
    ('CHECK(nh_.getParam("depth", depth_)) << "none";', True),
    ('if (rate_ > 2) { CHECK(nh_.getParam("depth", depth_)); }', False),
    (f"CHECK({MISSING});", False),
    (f"if ({MISSING}) {{ depth_ = begin(); }}", False),
    (f'if ({MISSING}) {{ ROS_WARN("none"); return; }}', False),
    (f"if (rate_ > 2 && {MISSING}) {{ throw 1; }}", False),
    (f"if (rate_ > 2) {{ return; }} if ({MISSING}) {{ throw 1; }}", False),
    (f"try {{ if ({MISSING}) {{ throw 1; }} }} catch (int) {{ }}", False),
    ('if (!nh_.hasParam("depths")) { throw 1; } nh_.getParam("depth", depth_);', False),
    ('nh_.getParam("depth", depth_);', False),
]


@pytest.mark.parametrize(("line", "breaks"), IN_ROS1)
def test_a_new_parameter_that_a_node_ends_without(changes, line: str, breaks: bool) -> None:  # type: ignore[no-untyped-def]
    """Where it throws or exits as it starts, since nobody set it, who starts it must set it now."""
    make = "project(arm)\nadd_executable(arm src/arm.cpp)\n"
    old = {"arm/package.xml": ROS1.replace("rospy", "roscpp"), "arm/CMakeLists.txt": make}
    found = changes({**old, "arm/src/arm.cpp": NODE1.format("")}, {"arm/src/arm.cpp": NODE1.format(line)})
    added = [
        (each["new"], each["breaking"]) for each in found if each["kind"] == "parameter" and each["new"] == "depth"
    ]
    assert added == [("depth", breaks)]


def test_a_node_of_another_name(changes) -> None:  # type: ignore[no-untyped-def]
    """Whoever started its program before starts it now, and must set what it needs."""
    make = "project(arm)\nadd_executable({0} src/{0}.cpp)\n"
    old = {"arm/package.xml": ROS1.replace("rospy", "roscpp"), "arm/CMakeLists.txt": make.format("arm")}
    line = f"if ({MISSING}) {{ throw 1; }}"
    named = NODE1.format(line).replace('"arm")', '"arm_node")')
    new = {"arm/CMakeLists.txt": make.format("arm_node"), "arm/src/arm.cpp": None, "arm/src/arm_node.cpp": named}
    found = changes({**old, "arm/src/arm.cpp": NODE1.format("")}, new)
    assert [each["breaking"] for each in found if each["new"] == "depth"] == [True]
