"""What plugins are given by the hosts of the tree that load them."""

from __future__ import annotations

from typing import Any

import pytest

PLUGIN = """
#include <ros/ros.h>
class Part {{ public: virtual ~Part() {{}} virtual void start(ros::NodeHandle & nh, int rate) = 0; }};
class Sonar : public Part {{
 public:
  void start(ros::NodeHandle & given, int rate) {{
    below_ = ros::NodeHandle(given, "sonar");
    {base}
    given.param("range", range_, 2.0);
    pub_ = below_.advertise<std_msgs::String>("echo", rate);
  }}
 private:
  ros::NodeHandle below_;
  ros::Publisher pub_;
  double range_;
}};
PLUGINLIB_EXPORT_CLASS(Sonar, Part)
class Host {{
 public:
  explicit Host(const ros::NodeHandle & given) : nh_(given), other_("elsewhere") {{
    boost::shared_ptr<Part> part = loader_.createInstance("sonar");
    {call}
  }}
 private:
  ros::NodeHandle nh_, other_;
  pluginlib::ClassLoader<Part> loader_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "board"); ros::NodeHandle nh("~"); Host host(nh); ros::spin(); }}
"""
CASES = {
    "as the maker of the host says": ("part->start(nh_, 4);", "", "~/range", "~/sonar/echo"),
    "as the host makes it itself": ("part->start(other_, 4);", "", "/elsewhere/range", "/elsewhere/sonar/echo"),
    "two that agree": ("part->start(nh_, 4); part->start(nh_, 5);", "", "~/range", "~/sonar/echo"),
    "two that do not": (
        "part->start(nh_, 4); part->start(other_, 5);",
        "",
        "/{given}/range",
        "/{given}/sonar/echo",
    ),
    "nobody": ("", "", "/{given}/range", "/{given}/sonar/echo"),
    "its own base is no host": ("", "Part::start(given, rate);", "/{given}/range", "/{given}/sonar/echo"),
    "another method is not asked": ("part->begin(nh_, 4);", "", "/{given}/range", "/{given}/sonar/echo"),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_a_plugin_gets_the_handle_of_its_host(workspace: Any, case: tuple[str, ...]) -> None:
    """A call on the base class hands it over; hosts that do not agree, and no host at all, leave it unknown."""
    call, base, parameter, topic = case
    found = workspace.package({"src/board.cpp": PLUGIN.format(call=call, base=base)}, ros=1)
    assert found.only("parameter").name == parameter
    assert found.only("publisher").name == topic


def test_hosts_that_give_each_other_what_they_were_given_end(workspace: Any) -> None:
    """`start` of one part calls `start` of the next: nobody has made the handle."""
    chain = PLUGIN.format(call="", base="boost::shared_ptr<Part> next; next->start(given, rate);")
    found = workspace.package({"src/board.cpp": chain}, ros=1)
    assert found.only("parameter").name == "/{given}/range"


KEPT = """
#include <ros/ros.h>
class Sensor {{
 public:
  virtual void start(ros::NodeHandle nh, std::string name) {{
    nh_ = nh;
    below_ = ros::NodeHandle(nh_, "sensors");
    below_.param("mode", mode_, 1);
  }}
  ros::NodeHandle nh_, below_;
  int mode_;
}};
class Camera : public Sensor {{
 public:
  void start(ros::NodeHandle nh, std::string name) override {{
    Sensor::start(nh, name);
    pub_ = nh_.advertise<std_msgs::String>("seen", 1);
  }}
  ros::Publisher pub_;
}};
PLUGINLIB_EXPORT_CLASS(Camera, Sensor)
class Estimator {{
 public:
  void begin(ros::NodeHandle nh) {{ nh_ = nh; }}
  void load(const std::string & name) {{
    sensors_.push_back(loader_.createInstance(name));
    sensors_.back()->start(nh_, name);
  }}
  ros::NodeHandle nh_;
  pluginlib::ClassLoader<Sensor> loader_;
  std::vector<boost::shared_ptr<Sensor>> sensors_;
}};
int main(int c, char ** v) {{
  ros::init(c, v, "board");
  ros::NodeHandle nh, other("other");
  auto estimator = boost::make_shared<Estimator>();
  {begun}
  estimator->load(v[1]);
}}
"""
BEGUN = {
    "by one": ("estimator->begin(nh);", "/sensors/mode", "/seen"),
    "by two that do not agree": (
        "if (c > 2) { estimator->begin(nh); } else { estimator->begin(other); }",
        "/{nh}/sensors/mode",
        "/{nh}/seen",
    ),
}


@pytest.mark.parametrize("case", BEGUN.values(), ids=BEGUN.keys())
def test_a_base_keeps_the_handle_that_a_host_was_given(workspace: Any, case: tuple[str, ...]) -> None:
    """The host has the handle of a method of its own, and the base of the plugin keeps what it is called with."""
    begun, parameter, topic = case
    found = workspace.package({"src/board.cpp": KEPT.format(begun=begun)}, ros=1)
    assert {entry.name for entry in found.interfaces() if entry.role == "parameter"} == {parameter}
    assert found.only("publisher").name == topic


TEMPLATE = """
#include <ros/ros.h>
class Planner {{
 public:
  {declared}
  void begin(ros::NodeHandle & nh) {{
    own_ = ros::NodeHandle("~" + getName());
    other_ = ros::NodeHandle("~other");
    {calls}
  }}
  virtual std::string getName() = 0;
  ros::NodeHandle own_, other_;
}};
class Short : public Planner {{
 public:
  std::string getName() {{ return "short"; }}
  void load(ros::NodeHandle & given) {{ pub_ = given.advertise<std_msgs::String>("path", 1); }}
  ros::Publisher pub_;
}};
PLUGINLIB_EXPORT_CLASS(Short, Planner)
"""
PURE = "virtual void load(ros::NodeHandle & nh) = 0;"
OF_BASES = {
    "what the base made": (PURE, "load(own_);", {"~/short/path"}),
    "by this": (PURE, "this->load(own_);", {"~/short/path"}),
    "two that do not agree": (PURE, "load(own_); load(other_);", {"~/other/path", "~/short/path"}),
    "a method that hides another": ("void load(ros::NodeHandle & nh) {}", "load(own_);", {"/{given}/path"}),
    "that of the base": ("virtual void load(ros::NodeHandle & nh) {}", "Planner::load(own_);", {"/{given}/path"}),
    "another method": (PURE, "begin(own_);", {"/{given}/path"}),
}


@pytest.mark.parametrize("case", OF_BASES.values(), ids=OF_BASES.keys())
def test_a_base_is_the_host_of_what_derives_from_it(workspace: Any, case: tuple[str, str, set[str]]) -> None:
    """What a base hands to its own virtual method is what the method of the object at hand gets, names of it included."""
    declared, calls, topics = case
    found = workspace.package({"src/short.cpp": TEMPLATE.format(declared=declared, calls=calls)}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "publisher"} == topics


OF_ONE_HOST = """
#include <ros/ros.h>
class Planner {
 public:
  virtual ~Planner() {}
  void begin(ros::NodeHandle & nh) {
    std::string topic;
    nh.getParam("topic", topic);
    sub_ = nh.subscribe(topic, 1, &Planner::heard, this);
    pub_ = nh.advertise<std_msgs::String>("fixed", 1);
  }
  void heard(const std_msgs::String & text) {}
  ros::Subscriber sub_;
  ros::Publisher pub_;
};
class Short : public Planner {};
PLUGINLIB_EXPORT_CLASS(Short, Planner)
int main(int c, char ** v) {
  ros::init(c, v, "board");
  ros::NodeHandle nh("~");
  pluginlib::ClassLoader<Planner> loader("pkg", "Planner");
  boost::shared_ptr<Planner> planner = loader.createInstance("short");
  planner->begin(nh);
  ros::spin();
}
"""


def test_what_a_base_names_by_itself_is_of_the_program_that_calls_it(workspace: Any) -> None:
    """A name that a parameter gives in the base is no name that its host gives: it lies where its neighbours do."""
    modules = workspace.package({"src/board.cpp": OF_ONE_HOST}, ros=1).modules()
    found = {entry.name: name for name, module in modules.items() for entry in module.signature.interfaces}
    assert len(found) == 3, found
    assert len(set(found.values())) == 1, found


SHARED = """
#include <ros/ros.h>
class Part {{
 public:
  static void begin(ros::NodeHandle * node) {{ node_ = node; }}
  virtual void init() = 0;
 protected:
  static ros::NodeHandle * node_;
}};
ros::NodeHandle * Part::node_;
class Arm : public Part {{
 public:
  void init() {{ pub_ = node_->advertise<std_msgs::String>("out", 1); }}
  ros::Publisher pub_;
}};
class Robot {{
 public:
  explicit Robot(ros::NodeHandle & node) : node_(&node) {{
    Part::begin(node_);
    {other}
    parts_.push_back(new Arm());
    parts_[0]->init();
  }}
  ros::NodeHandle * node_;
  std::vector<Part *> parts_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle node{space};
  Robot robot(node);
  ros::spin();
}}
"""
GIVEN_TO_ALL = [
    ("its node's", "", "", "/out"),
    ("a private one", '("~")', "", "/demo/out"),
    ("another one, too", "", 'ros::NodeHandle second("b"); Part::begin(&second);', "/{node}/out"),
]


@pytest.mark.parametrize(
    ("space", "other", "expected"), [row[1:] for row in GIVEN_TO_ALL], ids=[row[0] for row in GIVEN_TO_ALL]
)
def test_what_a_class_is_given_for_all_of_its_objects(workspace: Any, space: str, other: str, expected: str) -> None:
    """Who calls a static method with a handle gives it to all objects; where callers differ it is open."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": SHARED.format(space=space, other=other),
    }
    assert workspace.package(files, ros=1).only("publisher").name == expected
