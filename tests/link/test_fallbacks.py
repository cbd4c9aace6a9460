"""Defaults that no call states: what a variable holds when its parameter is not set."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
class Demo {{
 public:
  Demo() : pnh_("~"), initialised_(3) {{
    {body}
  }}
  void later() {{ elsewhere_ = 4; }}
  ros::NodeHandle pnh_;
  int member_ = 2, initialised_, elsewhere_, plain_;
  double wide_;
  std::string text_;
  Config config_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "demo"); Demo demo; }}
"""
ROWS = [
    ('if (!pnh_.getParam("p", plain_)) plain_ = 5;', "integer", 5),
    ('if (!pnh_.getParam("p", text_)) { ROS_WARN("unset"); text_ = "map"; }', "string", "map"),
    ('if (pnh_.getParam("p", plain_) == false) { plain_ = 6; }', "integer", 6),
    ('if (!pnh_.getParam("p", wide_)) wide_ = 1;', "double", 1),
    ('if (!ros::param::getCached("~p", wide_)) wide_ = 1;', "double", 1),
    ('int cached = 4; ros::param::getCached("~p", cached);', "integer", 4),
    ('double rate = 0.5; pnh_.getParam("p", rate);', "double", 0.5),
    ('pnh_.getParam("p", member_);', "integer", 2),
    ('pnh_.getParam("p", initialised_);', "integer", 3),
    ('double rate; pnh_.getParam("p", rate);', "double", None),
    ('pnh_.getParam("p", elsewhere_);', "integer", None),
    ('pnh_.getParam("p", config_.member_);', None, None),
    ('int must = 1; if (!pnh_.getParam("p", must)) { return; }', "integer", None),
    ('int both = 1; bool ok = pnh_.getParam("p", both) && other();', "integer", None),
    ('if (!pnh_.getParam("p", plain_) || !ready()) { plain_ = 7; }', "integer", None),
    ('if (!pnh_.getParam("p", plain_)) { warn(); } plain_ = 8;', "integer", None),
    ('pnh_.param("p", wide_, grid_->resolution());', "double", None),
    ('if (!pnh_.getParam("p", member_)) ROS_ERROR_STREAM("unset, " << member_);', "integer", 2),
    ('if (!pnh_.getParam("p", member_)) { ROS_BREAK(); }', "integer", None),
    ('if (!pnh_.getParam("p", member_)) { throw Unset(); }', "integer", None),
    ('bool on{true}; pnh_.getParam("p", on);', "bool", True),
    ('pnh_.getParam("p", this->member_); this->member_ = 9;', "integer", 2),
    ('pnh_.getParam("p", plain_); plain_ = 9;', "integer", None),
    ('pnh_.getParam("p", plain_); this->plain_ = 9;', "integer", None),
    ('bool off = true; if (pnh_.getParam("p", off)) off = !off;', "bool", None),
    ('bool off = true; if (pnh_.getParam("p", off)) { ROS_INFO("set"); off = !off; }', "bool", None),
    ('if (!pnh_.getParam("p", text_)) { text_ = "a.b"; } else { text_ = "a." + text_; }', "string", None),
    ('int n = 3; if (pnh_.getParam("p", n)) { if (n < 0) n = 3; }', "integer", 3),
    ('int n = 3; if (pnh_.getParam("p", n) && pnh_.hasParam("q")) { ROS_INFO("set"); }', "integer", None),
]


@pytest.mark.parametrize(("body", "kind", "default"), ROWS, ids=[row[0] for row in ROWS])
def test_what_a_variable_holds_is_the_default(workspace: Any, body: str, kind: str | None, default: object) -> None:
    """`if (!getParam(x)) x = 5;` and a value given before are defaults; what may have happened otherwise is none."""
    found = workspace.package({"src/d.cpp": TEXT.format(body=body)}, ros=1).only("parameter")
    assert (found.type, found.default) == (kind, default)


TOGETHER = [
    ('if (!(pnh_.getParam("p", n) && pnh_.getParam("q", q))) { ROS_ERROR("unset"); }', 3),
    ('if (pnh_.getParam("q", q) && pnh_.getParam("p", n)) { ROS_INFO("set"); } else { ROS_ERROR("unset"); }', 3),
    ('if (!(pnh_.getParam("p", n) && pnh_.getParam("q", q))) { return; }', None),
    ('if (!(pnh_.getParam("p", n) && pnh_.getParam("q", q))) { n = 5; }', None),
]


@pytest.mark.parametrize(("asked", "default"), TOGETHER, ids=[row[0] for row in TOGETHER])
def test_parameters_that_are_read_together(workspace: Any, asked: str, default: object) -> None:
    """Reads of one condition leave what there was where nothing else is done behind it."""
    package = workspace.package({"src/d.cpp": TEXT.format(body=f"int n = 3, q = 4; {asked}")}, ros=1)
    found = {entry.name: entry.default for entry in package.interfaces() if entry.role == "parameter"}
    assert found["/demo/p"] == default


READ_TWICE = [("plain_", None), ("initialised_", 3), ("member_", 2)]


@pytest.mark.parametrize(("member", "default"), READ_TWICE, ids=[row[0] for row in READ_TWICE])
def test_what_a_later_read_gives_a_member_is_no_default_of_the_first(
    workspace: Any, member: str, default: object
) -> None:
    """`getParam("p", m_); param("q", m_, 4);`: before the first read the member has what the class gives it."""
    body = f'pnh_.getParam("p", {member}); pnh_.param("q", {member}, 4);'
    package = workspace.package({"src/d.cpp": TEXT.format(body=body)}, ros=1)
    found = {entry.name: entry.default for entry in package.interfaces() if entry.role == "parameter"}
    assert found == {"/demo/p": default, "/demo/q": 4}


HOSTED = """
#include <ros/ros.h>
class Demo : public {base} {{
 public:
  void onInit() {{ pnh_ = getPrivateNodeHandle(); {begin} }}
  void prepare() {{ given_ = 4; read(); }}
  void read() {{ {read} }}
 private:
  ros::NodeHandle pnh_;
  int given_, after_, begun_ = 2;
}};
PLUGINLIB_EXPORT_CLASS(Demo, nodelet::Nodelet)
"""
LEFT = [
    ("prepare();", 'pnh_.getParam("p", given_);', 4),
    ("prepare();", 'if (pnh_.getParam("p", given_)) { if (given_ < 0) given_ = 4; }', 4),
    ("prepare(); given_ = 5; read();", 'pnh_.getParam("p", given_);', None),
    ("if (ready()) given_ = 3; read();", 'pnh_.getParam("p", given_);', None),
    ("read(); after_ = 6;", 'pnh_.getParam("p", after_);', None),
    ('pnh_.getParam("p", this->after_); this->after_ = 6;', "", None),
    ('pnh_.getParam("p", this->begun_); this->begun_ = 6;', "", None),
    ('if (pnh_.getParam("p", this->after_)) { warn(); } this->after_ = 6;', "", None),
]


@pytest.mark.parametrize(("begin", "read", "default"), LEFT, ids=[f"{row[0]} {row[1]}" for row in LEFT])
def test_what_callers_left_in_a_member_is_the_default(
    workspace: Any, begin: str, read: str, default: int | None
) -> None:
    """What all callers give a member before they call who reads is the default; what is given later is none."""
    text = HOSTED.format(base="nodelet::Nodelet", begin=begin, read=read)
    found = workspace.package({"src/d.cpp": text}, ros=1).only("parameter")
    assert found.default == default


def test_what_an_unknown_caller_may_have_left_is_no_default(workspace: Any) -> None:
    """A base that nobody sees may call the method that reads."""
    text = HOSTED.format(base="unseen::Base", begin="prepare();", read='pnh_.getParam("p", given_);')
    assert workspace.package({"src/d.cpp": text}, ros=1).only("parameter").default is None


HELPERS = [
    ("if rospy.has_param('~' + name):\n        return rospy.get_param('~' + name)\n    return value", 10),
    ("return rospy.get_param('~' + name)", None),
    ("print(rospy.get_param('~' + name))\n    return value", None),
]


@pytest.mark.parametrize(("body", "default"), HELPERS, ids=range(len(HELPERS)))
def test_what_a_helper_returns_instead_is_the_default(workspace: Any, body: str, default: object) -> None:
    """A helper that returns what it read, or else its argument, gives the parameter that default."""
    text = f"#!/usr/bin/env python\nimport rospy\ndef get(name, value=None):\n    {body}\nrospy.init_node('d')\nrate = get('rate', 10)\n"
    found = workspace.package({"scripts/d.py": text}, ros=1).only("parameter")
    assert (found.name, found.default) == ("/d/rate", default)


def test_what_a_helper_returns_instead_is_the_default_in_cpp(workspace: Any) -> None:
    """The same with a variable that is read into."""
    text = """
template <class T> T load(const ros::NodeHandle & nh, const std::string & name, const T & fallback) {
  T value;
  if (nh.hasParam(name)) { nh.getParam(name, value); return value; }
  return fallback;
}
class Demo { public: Demo() { load(nh_, "rate", 2.5); } ros::NodeHandle nh_; };
int main(int c, char ** v) { Demo demo; }"""
    found = workspace.package({"src/d.cpp": text}, ros=1).only("parameter")
    assert (found.type, found.default) == ("double", 2.5)


ASKING = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String

class Robot:
    def __init__(self):
        rospy.init_node("robot")
        self.topic = {call}
        rospy.Subscriber(self.topic, String, self.take)

    def take(self, message):
        pass
{helper}

Robot()
"""
METHOD = """
    def get_param(self, name, default=None):
        if rospy.has_param(name):
            value = rospy.get_param(name)
            return value
        elif default is not None:
            return default
        exit(1)
"""
FUNCTION = """
def get_param(node, name, default=None):
    if rospy.has_param(name):
        value = rospy.get_param(name)
        return value
    return default
"""


@pytest.mark.parametrize(
    ("call", "helper"), [('self.get_param("~topic", "/in")', METHOD), ('get_param(self, "~topic", "/in")', FUNCTION)]
)
def test_a_helper_that_is_called_like_what_it_wraps(workspace: Any, call: str, helper: str) -> None:
    """What it returns instead is the default of the parameter, and the value of whoever asks."""
    workspace.package({"scripts/robot.py": ASKING.format(call=call, helper=helper)}, ros=1)
    assert (workspace.only("parameter").default, workspace.only("subscriber").name) == ("/in", "/in")


def test_a_helper_without_a_default_leaves_the_name_open(workspace: Any) -> None:
    """`get_param(name)` of the class itself gives what the parameter is set to."""
    workspace.package({"scripts/robot.py": ASKING.format(call='self.get_param("~topic")', helper=METHOD)}, ros=1)
    assert workspace.only("subscriber").name == "/{topic}"


FILLING = """
#include <ros/ros.h>
std::string load(ros::NodeHandle & nh, const std::string & name, const std::string & otherwise, bool force) {{
  std::string value;
  {body}
  return value;
}}
int main(int c, char ** v) {{
  ros::init(c, v, "d");
  ros::NodeHandle nh;
  ros::Publisher out = nh.advertise<std_msgs::String>(load(nh, "topic", "/a", false), 1);
}}
"""
FILLED = [
    ("if (!nh.getParam(name, value)) { value = otherwise; }", "/a"),
    ("if (nh.getParam(name, value) == false) value = otherwise;", "/a"),
    ("if (!nh.getParam(name, value) || force) { value = otherwise; }", "/{topic}"),
    ("if (nh.getParam(name, value)) { value = otherwise; }", "/{topic}"),
    ('if (!nh.getParam(name, value)) { ROS_WARN("unset"); } value = otherwise;', "/{topic}"),
]


@pytest.mark.parametrize(("body", "name"), FILLED, ids=[row[0] for row in FILLED])
def test_what_a_helper_fills_in_is_the_default(workspace: Any, body: str, name: str) -> None:
    """A name that a helper reads from a parameter has the default that the helper gives its variable otherwise."""
    found = workspace.package({"src/d.cpp": FILLING.format(body=body)}, ros=1).only("publisher")
    assert found.name == name
