"""`getNamespace()` of a handle of roscpp is where the names lie that the handle makes."""

from __future__ import annotations

from typing import Any

import pytest

PROGRAM = """
#include <ros/ros.h>
class Server {{
 public:
  explicit Server(const ros::NodeHandle & given) : nh_(given) {{
    pub_ = nh_.advertise<std_msgs::String>({name}, 1);
  }}
  ros::NodeHandle nh_;
  ros::Publisher pub_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh{made};
  Server server(nh);
  ros::spin();
}}
"""
JOINED = 'nh_.getNamespace() + "/x"'
ROWS = [
    ("public", "", JOINED, "/x"),
    ("private", '("~")', JOINED, "/demo/x"),
    ("below a private one", '("~arm")', JOINED, "/demo/arm/x"),
    ("of a name", '("arm")', JOINED, "/arm/x"),
    ("absolute", '("/arm")', JOINED, "/arm/x"),
    ("joined by roscpp", '("~")', 'ros::names::append(nh_.getNamespace(), "x")', "/demo/x"),
]


@pytest.mark.parametrize(("made", "name", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_name_below_the_namespace_of_a_handle(workspace: Any, made: str, name: str, expected: str) -> None:
    """The namespace is absolute, so that the handle itself puts nothing before it."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": PROGRAM.format(made=made, name=name),
    }
    assert workspace.package(files, ros=1).only("publisher").name == expected


CHOSEN = """
#include <ros/ros.h>
class Plugin {{
 public:
  void load(Element given) {{
    {chosen}
    nh_.reset(new ros::NodeHandle({made}));
    pub_ = nh_->advertise<std_msgs::String>("out", 1);
  }}
  std::string space_;
  boost::shared_ptr<ros::NodeHandle> nh_;
  ros::Publisher pub_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "demo"); Plugin plugin; plugin.load(Element()); }}
"""
GIVEN = 'if (!given.has("ns")) ROS_INFO("none"); else space_ = given.get("ns");'
CHOICES = [
    ("nothing or what somebody gives", f'space_ = ""; {GIVEN}', "space_", {("/out", "one_of"), ("/{given}/out", "pattern")}),
    ("one of two", "", 'given.left() ? "a" : "b"', {("/a/out", "one_of"), ("/b/out", "one_of")}),
    ("one of two below another", "", 'ros::NodeHandle("~"), given.left() ? "a" : "b"',
     {("/demo/a/out", "one_of"), ("/demo/b/out", "one_of")}),
]  # fmt: skip


@pytest.mark.parametrize(("chosen", "made", "expected"), [row[1:] for row in CHOICES], ids=[row[0] for row in CHOICES])
def test_of_several_namespaces_none_is_proved(workspace: Any, chosen: str, made: str, expected: set[Any]) -> None:
    """Names below a handle are told below each of the namespaces that it may have, and not the first as proved."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": CHOSEN.format(chosen=chosen, made=made),
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {(entry.name, entry.confidence) for entry in found if entry.role == "publisher"} == expected


KEPT = """
#include <ros/ros.h>
class Laser {{
 public:
  void init(ros::NodeHandle & node, const std::string & topic) {{
    node_ = &node;
    sub_ = node_->subscribe(topic, 10, &Laser::on, this);
  }}
  void on(const sensor_msgs::LaserScan::ConstPtr & scan);
  ros::NodeHandle * node_;
  ros::Subscriber sub_;
}};
class Watchdog {{
 public:
  explicit Watchdog(ros::NodeHandle & node) {{ laser_.init(node, "scan"); }}
  Laser laser_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh{space};
  Watchdog watchdog(nh);
  ros::spin();
}}
"""


@pytest.mark.parametrize(("space", "expected"), [("", "/scan"), ('("~")', "/demo/scan")])
def test_a_handle_that_a_method_keeps_before_it_asks_it(workspace: Any, space: str, expected: str) -> None:
    """`node_ = &node` is what the method was given, which is what the constructor was given that calls it."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": KEPT.format(space=space),
    }
    assert workspace.package(files, ros=1).only("subscriber").name == expected


SCRIPT = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String
rospy.init_node("demo")
rospy.Publisher({name}, String, queue_size=1)
rospy.spin()
"""


@pytest.mark.parametrize("name", ['rospy.get_namespace() + "x"', 'rospy.get_namespace() + "/x"', '"x"'])
def test_the_namespace_of_rospy_ends_with_a_slash(workspace: Any, name: str) -> None:
    """What is written behind it is a name of its own, and not more of the last one."""
    files = {
        "CMakeLists.txt": "project(pkg)\ncatkin_install_python(PROGRAMS demo.py DESTINATION bin)\n",
        "demo.py": SCRIPT.format(name=name),
    }
    found = workspace.package(files, ros=1).only("publisher")
    assert (found.name, found.confidence == "pattern") == ("/x", False)
