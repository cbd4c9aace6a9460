"""Who has an endpoint: objects that programs and classes make, hold through aliases, or define twice."""

from __future__ import annotations

from typing import Any


def endpoints(workspace: Any) -> dict[str, set[str]]:
    """Names of the endpoints of each module, modules without any included."""
    return {
        name.removeprefix("ecm.pkg."): {entry.name for entry in module.signature.interfaces}
        for name, module in workspace.modules().items()
    }


def test_what_a_program_gives_its_node_is_the_nodes(workspace: Any) -> None:
    """A name that main passes to the constructor does not make a second module."""
    text = """
class Demo : public rclcpp::Node { public: Demo(std::string ns) : Node("demo") { create_publisher<std_msgs::msg::Bool>(ns + "on", 1); } };
int main(int c, char ** v) { rclcpp::spin(std::make_shared<Demo>("/robot/")); }"""
    cmake = "project(pkg)\nadd_executable(demo src/d.cpp)\n"
    assert endpoints(workspace.package({"src/d.cpp": text, "CMakeLists.txt": cmake})) == {"demo": {"/robot/on"}}


def test_what_a_plugin_gives_another_is_of_both(workspace: Any) -> None:
    """A plugin has no node of its own: who makes it has its endpoints too."""
    text = """
class One : public other::Base { public: One(std::string ns) { node_->create_client<std_srvs::srv::Empty>(ns + "/reset"); } };
class All : public other::Base { void fill() { auto one = std::make_shared<One>("arm"); } };
PLUGINLIB_EXPORT_CLASS(One, other::Base)
PLUGINLIB_EXPORT_CLASS(All, other::Base)
"""
    assert endpoints(workspace.package({"src/d.cpp": text})) == {"one": {"/arm/reset"}, "all": {"/arm/reset"}}


def test_a_class_held_through_an_alias_is_held(workspace: Any) -> None:
    """`using Bools = Reader<Bool>`: who holds a `Bools` has what the template subscribes to, with its type."""
    header = """
namespace lib {
template <typename T> class Reader { public:
  void open(rclcpp::Node * node, const std::string & name) { node->create_subscription<T>(name, 1, [](auto m) {}); }
};
using Bools = Reader<std_msgs::msg::Bool>;
}"""
    node = '#include "pkg/reader.hpp"\nclass Demo : public rclcpp::Node { public: Demo() : Node("demo") { bools_.open(this, "on"); } lib::Bools bools_; };'
    workspace.package({"include/pkg/reader.hpp": header, "src/d.cpp": node})
    assert endpoints(workspace) == {"demo": {"/on"}}
    assert workspace.only("subscriber").type == "std_msgs/msg/Bool"


def test_a_method_of_a_template_base_knows_its_arguments(workspace: Any) -> None:
    """What a class gives its base template is known where a method of the base is called on a member."""
    text = """
template <typename T> class Base { public: void open(rclcpp::Node * n, std::string name) { n->create_publisher<T>(name, 1); } };
class Bools : public Base<std_msgs::msg::Bool> {};
class Demo : public rclcpp::Node { public: Demo() : Node("demo") { bools_.open(this, "on"); } Bools bools_; };"""
    assert workspace.package({"src/d.cpp": text}).only("publisher").type == "std_msgs/msg/Bool"


def test_a_class_of_two_distributions_is_one(workspace: Any) -> None:
    """Definitions of a class in branches of `#if` are one class, with the bases and methods of both."""
    text = """
#if ROS1
class Demo : public ros::NodeHandle { public: Demo(); };
#else
class Demo : public rclcpp::Node { public: explicit Demo(const rclcpp::NodeOptions & options); };
#endif
Demo::Demo(const rclcpp::NodeOptions & options) : Node("demo", options) { create_publisher<std_msgs::msg::Bool>("on", 1); }
RCLCPP_COMPONENTS_REGISTER_NODE(Demo)
"""
    assert endpoints(workspace.package({"src/d.cpp": text})) == {"demo": {"/on"}}


def test_an_object_outside_of_functions_is_of_its_program(workspace: Any) -> None:
    """A global object belongs to the program whose file defines it."""
    lib = "class Engine { public: void run() { send(); } };\nvoid send() { static tf::TransformBroadcaster sender; }"
    main = (
        '#include "pkg/engine.h"\nEngine engine;\nint main(int c, char ** v) { ros::init(c, v, "demo"); engine.run(); }'
    )
    cmake = "project(pkg)\nadd_executable(demo src/main.cpp)\n"
    files = {"include/pkg/engine.h": lib, "src/main.cpp": main, "CMakeLists.txt": cmake}
    assert endpoints(workspace.package(files, ros=1)) == {"demo": {"/tf"}}


def test_a_held_object_stands_where_its_member_does(workspace: Any) -> None:
    """The evidence of a member is the line of the header, also where the methods stand in another file."""
    header = "class Demo : public rclcpp::Node {\n public:\n  Demo();\n  tf2_ros::TransformListener listener_;\n};"
    source = '#include "pkg/zz.hpp"\nDemo::Demo() : Node("demo") {}\n'
    entry = workspace.package({"src/a.cpp": source, "include/pkg/zz.hpp": header, "include/pkg/a.hpp": ""}).only(
        "tf_lookup"
    )
    assert [(one.path, one.line) for one in entry.evidence] == [("pkg/include/pkg/zz.hpp", 4)]


def test_macros_that_register_other_things_make_no_plugin(workspace: Any) -> None:
    """Point types, edges of graphs and metatypes are registered too; no loader of ROS loads them."""
    text = "struct Point { float x; };\nPOINT_CLOUD_REGISTER_POINT_STRUCT(Point, (float, x, x))\nclass Edge : public g2o::Base {};\nG2O_REGISTER_TYPE(EDGE, Edge)\n"
    assert endpoints(workspace.package({"src/d.cpp": text})) == {"pkg": set()}


def test_a_default_of_a_constructor_stands_at_its_declaration(workspace: Any) -> None:
    """`name = "go"` in the header is what the definition in the source gets."""
    header = 'class Server { public: Server(rclcpp::Node * node, const std::string & name = "go"); };'
    source = '#include "pkg/s.hpp"\nServer::Server(rclcpp::Node * node, const std::string & name) { node->create_service<std_srvs::srv::Empty>(name, f); }'
    node = '#include "pkg/s.hpp"\nclass Demo : public rclcpp::Node { public: Demo() : Node("demo"), server_(this) {} Server server_; };'
    files = {"include/pkg/s.hpp": header, "src/s.cpp": source, "src/d.cpp": node}
    assert endpoints(workspace.package(files)) == {"demo": {"/go"}}


def test_a_program_without_suffix_may_stand_anywhere(workspace: Any) -> None:
    """A file that can be run and begins with the name of Python is a program, one that cannot is none."""
    script = "#!/usr/bin/env python3\nimport rclpy\nfrom std_msgs.msg import String\nnode = rclpy.create_node('s')\nnode.create_publisher(String, 'b', 1)\n"
    workspace.package({"pkg/state/say": script, "pkg/state/notes": script})
    (workspace.root / "pkg/pkg/state/say").chmod(0o755)
    assert endpoints(workspace) == {"say": {"/b"}}


def test_a_static_method_is_of_whoever_calls_it(workspace: Any) -> None:
    """`static` stands at the declaration in the header; the definition declares for its caller."""
    header = "struct Config { static void load(rclcpp::Node::SharedPtr & node); };"
    source = '#include "pkg/c.hpp"\nvoid Config::load(rclcpp::Node::SharedPtr & node) { node->declare_parameter("rate", 1.0); }'
    main = '#include "pkg/c.hpp"\nint main(int c, char ** v) { auto node = std::make_shared<rclcpp::Node>("demo"); Config::load(node); }'
    cmake = "project(pkg)\nadd_executable(demo src/main.cpp src/c.cpp)\n"
    files = {"include/pkg/c.hpp": header, "src/c.cpp": source, "src/main.cpp": main, "CMakeLists.txt": cmake}
    assert endpoints(workspace.package(files)) == {"demo": {"rate"}}


def test_a_static_method_brings_no_object_along_unless_it_makes_one(workspace: Any) -> None:
    """Who calls a helper of a class has no object of it; who asks for the only object has."""
    text = """
class Loader { public: Loader(rclcpp::Node * n) { n->create_publisher<std_msgs::msg::Bool>("loaded", 1); } static int size(); };
int Loader::size() { return 1; }
class Only { public: static Only & get(); Only() { rclcpp::Node::make()->create_client<std_srvs::srv::Empty>("once"); } };
Only & Only::get() { static Only only; return only; }
class A : public rclcpp::Node { public: A() : Node("a") { Loader::size(); } };
class B : public rclcpp::Node { public: B() : Node("b") { Only::get(); } };
class C : public rclcpp::Node { public: C() : Node("c"), loader_(this) {} Loader loader_; };"""
    assert endpoints(workspace.package({"src/d.cpp": text})) == {"a": set(), "b": {"/once"}, "c": {"/loaded"}}


_FACTORY = """
#include <ros/ros.h>
class Part {
 public:
  virtual void initialize() = 0;
};
typedef Part * (*Maker)(void);
class Arm : public Part {
 public:
  static Part * Create() { return new Arm(); }
  void initialize() { pub_ = nh_.advertise<std_msgs::String>("arm", 1); }
 private:
  Arm() {}
  ros::NodeHandle nh_;
  ros::Publisher pub_;
};
class Leg : public Part {
 public:
  static Part * Create() { return new Leg(); }
  void initialize() { pub_ = nh_.advertise<std_msgs::String>("leg", 1); }
 private:
  ros::NodeHandle nh_;
  ros::Publisher pub_;
};
class Factory {
 public:
  Factory() { keep("arm", &Arm::Create); }
  void keep(const std::string & name, Maker maker) { makers_[name] = maker; }
  std::map<std::string, Maker> makers_;
};
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  Factory factory;
  factory.makers_["arm"]()->initialize();
  ros::spin();
}
"""


def test_a_static_method_that_is_handed_over_makes_what_it_makes(workspace: Any) -> None:
    """A factory that keeps `&Arm::Create` has arms, which it makes by a word; what nobody hands over it has not."""
    files = {"CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n", "src/demo.cpp": _FACTORY}
    assert endpoints(workspace.package(files, ros=1))["demo"] == {"/arm"}
