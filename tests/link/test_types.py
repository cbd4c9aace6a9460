"""Types of endpoints and parameters from what the source writes around them."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include "pkg/types.hpp"
#define renamed_msgs sensor_msgs::msg
#define renamed_package sensor_msgs
namespace pkg {{
using Outer = Holder::Outer;
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ pub_ = create_publisher<{kind}>("a", 10); }}
}};
}}
"""
HEADER = """
#include "pkg/Bare.h"
namespace pkg { struct Holder { using Outer = nav_msgs::msg::Path; using Action = nav2_msgs::action::Wait; }; }
namespace sensor_msgs { template <class A> struct Imu_ {}; typedef ::sensor_msgs::Imu_<std::allocator<void>> Imu; }
"""
NAMES = [
    ("pkg_msgs::msg::Goal", "pkg_msgs/msg/Goal"),
    ("pkg_msgs::msg::Result", "pkg_msgs/msg/Result"),
    ("pkg_msgs::msg::Feedback", "pkg_msgs/msg/Feedback"),
    ("pkg_msgs::msg::Request", "pkg_msgs/msg/Request"),
    ("pkg_msgs::Goal", "pkg_msgs/msg/Goal"),
    ("pkg_msgs::msg::tfMessage", "pkg_msgs/msg/tfMessage"),
    ("::nav_msgs::msg::Odometry", "nav_msgs/msg/Odometry"),
    ("renamed_msgs::Imu", "sensor_msgs/msg/Imu"),
    ("renamed_package::msg::Imu", "sensor_msgs/msg/Imu"),
    ("sensor_msgs::Imu", "sensor_msgs/msg/Imu"),
    ("Outer", "nav_msgs/msg/Path"),
    ("Bare", "pkg/msg/Bare"),
    ("unheard_of::Thing", "unheard_of/msg/Thing"),
    ("msg::Goal", "pkg/msg/Goal"),
    ("sensor_msgs ::msg:: Imu", "sensor_msgs/msg/Imu"),
    ("Unheard", None),
]


@pytest.mark.parametrize(("kind", "expected"), NAMES, ids=[row[0] for row in NAMES])
def test_message_types(workspace: Any, kind: str, expected: str | None) -> None:
    """Aliases, macros that rename a package, generated classes and headers of headers say which message it is."""
    files = {"src/demo.cpp": CPP.format(kind=kind), "include/pkg/types.hpp": HEADER}
    assert workspace.package(files).only("publisher").type == expected


LOWER = [
    ("pkg_msgs::cloud_info", "pkg_msgs/msg/cloud_info"),
    ("const pkg_msgs::cloud_infoConstPtr &", "pkg_msgs/msg/cloud_info"),
    ("pkg_msgs::other_info", None),
]


@pytest.mark.parametrize(("kind", "expected"), LOWER, ids=[row[0] for row in LOWER])
def test_a_message_in_lower_case_is_told_by_its_header(workspace: Any, kind: str, expected: str | None) -> None:
    """`pkg::cloud_info` is a message where the header that generation makes of one is included."""
    text = f'#include <pkg_msgs/cloud_info.h>\nvoid on({kind} m);\nint main(int c, char ** v) {{ ros::NodeHandle nh; auto s = nh.subscribe("in", 1, on); }}'
    assert workspace.package({"src/d.cpp": text}, ros=1).only("subscriber").type == expected


def test_a_message_in_lower_case_that_a_template_is_given_is_told_by_the_header_of_who_gives_it(workspace: Any) -> None:
    """The class of the template stands in a header of its own, which includes no message."""
    header = "template <class M> class Out { public: Out(const std::string & name) { ros::NodeHandle nh; pub_ = nh.advertise<M>(name, 1); } ros::Publisher pub_; };"
    text = '#include "out.hpp"\n#include <pkg_msgs/cloud_info.h>\nint main(int c, char ** v) { Out<pkg_msgs::cloud_info> out("x"); }'
    files = {"src/out.hpp": header, "src/d.cpp": text}
    assert workspace.package(files, ros=1).only("publisher").type == "pkg_msgs/msg/cloud_info"


@pytest.mark.parametrize(("kind", "expected"), [("std::string", "string"), ("int", "integer"), ("Thing", None)])
def test_a_parameter_has_the_type_of_what_it_is_read_into(workspace: Any, kind: str, expected: str | None) -> None:
    """`declare_parameter("port")` says no type, `get_parameter("port", port)` after it does."""
    text = f'int main() {{ auto node = rclcpp::Node::make_shared("d"); {kind} port; node->declare_parameter("port"); node->get_parameter("port", port); }}'
    assert workspace.package({"src/d.cpp": text}).only("parameter").type == expected


def test_an_alias_within_a_function_is_known_there_only(workspace: Any) -> None:
    """Two functions may give one name to two types, and a third knows neither."""
    text = """
void one(ros::NodeHandle nh = ros::NodeHandle()) { using M = std_msgs::Bool; auto p = nh.advertise<M>("one", 1); }
void two(ros::NodeHandle nh = ros::NodeHandle()) { typedef std_msgs::Int8 M; auto p = nh.advertise<M>("two", 1); }
void three(ros::NodeHandle nh = ros::NodeHandle()) { auto p = nh.advertise<M>("three", 1); }"""
    found = {entry.name: entry.type for entry in workspace.package({"src/d.cpp": text}, ros=1).interfaces()}
    assert found == {"/one": "std_msgs/msg/Bool", "/two": "std_msgs/msg/Int8", "/three": None}


def test_aliases_that_stand_for_each_other_end(workspace: Any) -> None:
    """Two libraries that replace each other name each other's type, and neither stands in the tree."""
    text = """
namespace old_utils { using Point = new_utils::Point; }
namespace new_utils { using Point = old_utils::Point; }
class Node : public new_utils::Point { public: Node() { p_ = nh_.advertise<std_msgs::Bool>("out", 1); }
  ros::NodeHandle nh_; ros::Publisher p_; };
int main(int c, char ** v) { ros::init(c, v, "d"); Node node; }"""
    assert workspace.package({"src/d.cpp": text}, ros=1).only("publisher").name == "/out"


def test_a_callback_in_a_variable_says_its_type(workspace: Any) -> None:
    """`std::function<void(const M::ConstPtr &)>` takes messages of type M."""
    text = 'void attach(ros::NodeHandle & nh, const boost::function<void(const std_msgs::Bool::ConstPtr &)> & f) { auto s = nh.subscribe("in", 1, f); }'
    assert workspace.package({"src/d.cpp": text}, ros=1).only("subscriber").type == "std_msgs/msg/Bool"


@pytest.mark.parametrize(
    ("cast", "expected"), [("int", "integer"), ("float", "double"), ("str", "string"), ("f", None)]
)
def test_a_cast_of_python_says_the_type(workspace: Any, cast: str, expected: str | None) -> None:
    """`int(rospy.get_param('~port'))` is an integer."""
    text = f"#!/usr/bin/env python\nimport rospy\nrospy.init_node('d')\nport = {cast}(rospy.get_param('~port'))\n"
    assert workspace.package({"scripts/d.py": text}, ros=1).only("parameter").type == expected


PARTLY = [
    ("os.path.join(folder(), 'a.yaml')", "string"),
    ("folder() + '/a.yaml'", "string"),
    ("f'{folder()}/a.yaml'", "string"),
    ("held", "string"),
    ("folder()", None),
    ("folder() + 1", None),
    ("folder(1)", None),
]


@pytest.mark.parametrize(("default", "expected"), PARTLY, ids=[row[0] for row in PARTLY])
def test_a_default_that_is_partly_a_text_is_one(workspace: Any, default: str, expected: str | None) -> None:
    """What a path is put together of may be unknown, and it is a text all the same."""
    text = f"""import os
from rclpy.node import Node
from somewhere import folder
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        held = os.path.join(folder(), 'a.yaml')
        self.declare_parameter('file', {default})
"""
    assert workspace.package({"pkg/demo.py": text}).only("parameter").type == expected


DEDUCED = [("0.5", "double"), ("count_", "integer"), ('std::string("a")', "string")]


@pytest.mark.parametrize(("default", "expected"), DEDUCED, ids=[row[0] for row in DEDUCED])
def test_a_template_parameter_is_deduced_from_an_argument(workspace: Any, default: str, expected: str) -> None:
    """`T value; getParam(name, value)` has the type of the argument that is declared with `T`."""
    text = f"""
template <class T> T load(const ros::NodeHandle & nh, const std::string & name, const T & fallback) {{
  T value;
  if (nh.getParam(name, value)) return value;
  return fallback;
}}
class Demo {{ public: Demo() {{ load(nh_, "p", {default}); }} ros::NodeHandle nh_; int count_; }};
int main(int c, char ** v) {{ Demo demo; }}"""
    assert workspace.package({"src/d.cpp": text}, ros=1).only("parameter").type == expected


ALIASED = ["std::vector<Id>", "Ids", "core::Ids", "std::vector<core::Id>"]


@pytest.mark.parametrize("written", ALIASED)
def test_what_a_list_holds_may_have_another_name(workspace: Any, written: str) -> None:
    """`std::vector<Id>` is a list of texts where `Id` is one."""
    text = f"""
namespace core {{ using Id = std::string; using Ids = std::vector<Id>; }}
using namespace core;
class Demo : public rclcpp::Node {{ Demo() : Node("demo") {{ declare_parameter<{written}>("p"); }} }};"""
    assert workspace.package({"src/d.cpp": text}).only("parameter").type == "string_array"


REQUESTS = [
    ("std_srvs::SetBool::Request", "std_srvs/srv/SetBool"),
    ("std_srvs::SetBoolRequest", "std_srvs/srv/SetBool"),
    ("std_srvs::MakeRequest::Request", "std_srvs/srv/MakeRequest"),
]


@pytest.mark.parametrize(("request_type", "expected"), REQUESTS, ids=[row[0] for row in REQUESTS])
def test_services_of_ros1_callbacks(workspace: Any, request_type: str, expected: str) -> None:
    """The request of a callback names the service, in both ways that ROS 1 generates it."""
    text = (
        f"bool set({request_type} & request, Other & response);"
        ' int main(int c, char ** v) { ros::init(c, v, "n"); ros::NodeHandle nh;'
        ' auto s = nh.advertiseService("set", set); }'
    )
    assert workspace.package({"src/m.cpp": text}, ros=1).only("service_server").type == expected


CALLBACKS = """
#include <ros/ros.h>
void said(const std_msgs::String::ConstPtr & message){end}
bool set(std_srvs::SetBool::Request & request, std_srvs::SetBool::Response & response){end}
"""


def test_callbacks_that_another_file_defines(workspace: Any) -> None:
    """A header declares the functions that a program hands over, and another source of it defines them."""
    main = """#include "callbacks.h"
int main(int c, char ** v) {
  ros::init(c, v, "n");
  ros::NodeHandle nh;
  auto sub = nh.subscribe("said", 1, said);
  auto server = nh.advertiseService("set", set);
}"""
    build = "project(pkg)\ninclude_directories(include)\nadd_executable(n src/main.cpp src/callbacks.cpp)\n"
    files = {"CMakeLists.txt": build, "include/callbacks.h": CALLBACKS.format(end=";"), "src/main.cpp": main}
    workspace.package({**files, "src/callbacks.cpp": CALLBACKS.format(end=" { }")}, ros=1)
    assert workspace.only("subscriber").type == "std_msgs/msg/String"
    assert workspace.only("service_server").type == "std_srvs/srv/SetBool"


def test_names_of_macros_side_by_side(workspace: Any) -> None:
    """`#define FULL NODE LEAF` is both texts, as the compiler joins them."""
    text = """#define NODE "demo"
#define LEAF "/port"
#define FULL NODE LEAF
int main(int c, char ** v) { ros::init(c, v, NODE); ros::NodeHandle nh; int port; nh.getParam(FULL, port); }"""
    assert workspace.package({"src/m.cpp": text}, ros=1).only("parameter").name == "/demo/port"


PARAMETERS = [
    ('int level = declare_parameter("p", (int)given_);', "integer"),
    ('member_ = declare_parameter("p", TABLE[0]);', "double"),
    ('std::string text = this->declare_parameter("p", entry->second);', "string"),
    ('auto level = declare_parameter("p", entry->second);', None),
    ('int sum = combine(declare_parameter("p", entry->second), 1.5);', None),
]


@pytest.mark.parametrize(("statement", "expected"), PARAMETERS, ids=[row[0] for row in PARAMETERS])
def test_a_parameter_has_the_type_of_the_variable_that_takes_it(
    workspace: Any, statement: str, expected: str | None
) -> None:
    """Where the default says no type, the variable does that the value is assigned to, and no other."""
    text = f'class D : public rclcpp::Node {{ D() : Node("d") {{ {statement} }} double member_; }};'
    assert workspace.package({"src/d.cpp": text}).only("parameter").type == expected


CASTS = [
    ("static_cast<double>(0)", "double", 0.0),
    ("(float)1", "double", 1.0),
    ("static_cast<std::int64_t>(2.0)", "integer", 2),
    ("(int)LEVEL", "integer", 3),
    ("static_cast<size_t>(unknown())", "integer", None),
    ("(Other)entry", None, None),
    ("std::pow(2, 3)", "double", 8.0),
    ("pow(1e9, 1e9)", None, None),
]


@pytest.mark.parametrize(("default", "kind", "value"), CASTS, ids=[row[0] for row in CASTS])
def test_a_cast_says_the_type_of_a_default(workspace: Any, default: str, kind: str | None, value: object) -> None:
    """`static_cast<double>(0)` is a double, not an integer."""
    text = f'#define LEVEL 3\nclass D : public rclcpp::Node {{ D() : Node("d") {{ declare_parameter("p", {default}); }} }};'
    found = workspace.package({"src/d.cpp": text}).only("parameter")
    assert (found.type, found.default, type(found.default)) == (kind, value, type(value))


def test_a_member_of_the_outermost_namespace_is_an_object(workspace: Any) -> None:
    """`::tf2_ros::TransformListener` is the class without the leading colons."""
    text = 'class D : public rclcpp::Node { D() : Node("d") {} ::tf2_ros::TransformListener listener_; };'
    assert workspace.package({"src/d.cpp": text}).only("tf_lookup").name == "/tf"


RELATIVE = [
    ('class D : public rclcpp::Node {{ D() : Node("d") {{ {made} }} }};', None),
    ('namespace own {{ class D : public rclcpp::Node {{ D() : Node("d") {{ {made} }} }}; }}', "own/msg/Goal"),
    ('namespace own::in {{ class D : public rclcpp::Node {{ D() : Node("d") {{ {made} }} }}; }}', "own/msg/Goal"),
    ("namespace own {{ void make(rclcpp::Node * node) {{ node->{made} }} }}", "own/msg/Goal"),
    ('struct O {{ class D : public rclcpp::Node {{ D() : Node("d") {{ {made} }} }}; }};', None),
]


@pytest.mark.parametrize(("text", "kind"), RELATIVE, ids=[row[0][:60] for row in RELATIVE])
def test_a_type_without_its_package_is_of_the_namespace(workspace: Any, text: str, kind: str | None) -> None:
    """No package is called `msg`: without a namespace around it nothing tells whose type it is."""
    made = 'create_publisher<msg::Goal>("a", 10);'
    assert workspace.package({"src/d.cpp": text.format(made=made)}).only("publisher").type == kind


HANDED_ON = """
import rclpy
from rclpy.node import Node
from {module} import Thing
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.create_publisher(Thing, "x", 10)
"""
FALLBACK = """
try:
    from pkg.msg import Made as Thing
except ImportError:
    class Thing:
        def __init__(self):
            self.text = ""
"""


@pytest.mark.parametrize(
    ("module", "text", "found"),
    [
        (".shared", "from std_msgs.msg import String as Thing", "std_msgs/msg/String"),
        (".shared", "from .msg import Thing", "pkg/msg/Thing"),
        (".shared", FALLBACK, "pkg/msg/Made"),
        ("pkg.shared", FALLBACK, "pkg/msg/Made"),
        (".shared", "class Thing: pass", None),
        (".msg", "", "pkg/msg/Thing"),
        (".absent", "", None),
    ],
)
def test_a_message_that_a_module_of_the_package_hands_on(
    workspace: Any, module: str, text: str, found: str | None
) -> None:
    """A module beside is no package of messages, whatever it has; what it imports is what it hands on."""
    files = {"pkg/__init__.py": "", "pkg/shared.py": text, "pkg/demo.py": HANDED_ON.format(module=module)}
    assert workspace.package(files).only("publisher").type == found
