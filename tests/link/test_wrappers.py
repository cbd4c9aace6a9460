"""Functions and classes that pass their arguments on to a form are forms themselves."""

from __future__ import annotations

from typing import Any

from workspaces import Workspace

HELPER = """
template<typename NodeT>
void declare_once(NodeT node, const std::string & name, const rclcpp::ParameterValue & value) {
  if (!node->has_parameter(name)) { node->declare_parameter(name, value); }
}
"""


def test_a_helper_function_in_another_package_is_a_form(workspace: Any) -> None:
    """The call of the helper is the declaration: its name, its default, its line first."""
    workspace.package({"include/util/util.hpp": f"namespace util {{{HELPER}}}"}, name="util")
    node = 'class D : public rclcpp::Node { D() : Node("d") {\n util::declare_once(this, "speed", rclcpp::ParameterValue(0.5)); } };'
    workspace.package({"src/d.cpp": '#include "util/util.hpp"\n' + node})
    entry = workspace.only("parameter")
    assert (entry.name, entry.type, entry.default) == ("speed", "double", 0.5)
    assert [place.path for place in entry.evidence] == ["pkg/src/d.cpp", "util/include/util/util.hpp"]


def test_a_chain_of_helpers_is_followed(workspace: Any) -> None:
    """A helper of a helper is a form too; each call of the outermost one is its own endpoint."""
    text = """
class D : public rclcpp::Node {
  D() : Node("d") { both("left"); both("right"); }
  void both(const std::string & side) { one(side + "/cmd"); }
  void one(const std::string & topic) { pubs_.push_back(create_publisher<std_msgs::msg::Float64>(topic, 1)); }
};"""
    names = {entry.name for entry in workspace.package({"src/d.cpp": text}).interfaces()}
    assert names == {"/left/cmd", "/right/cmd"}


def test_template_arguments_go_through(workspace: Any) -> None:
    """The message type of a template helper is that of each call."""
    text = """
template<class MessageT> auto make(rclcpp::Node * node, const std::string & topic) { return node->create_publisher<MessageT>(topic, 1); }
class D : public rclcpp::Node { D() : Node("d") { a_ = make<std_msgs::msg::String>(this, "a"); b_ = make<std_msgs::msg::Bool>(this, "b"); } };"""
    found = {(entry.name, entry.type) for entry in workspace.package({"src/d.cpp": text}).interfaces()}
    assert found == {("/a", "std_msgs/msg/String"), ("/b", "std_msgs/msg/Bool")}


def test_constructor_arguments_go_through_members(workspace: Any) -> None:
    """A helper object opens a topic that the maker of the object names."""
    text = """
class Channel { public:
  Channel(rclcpp::Node * node, const std::string & topic) : node_(node), topic_(topic) {}
  void open() { pub_ = node_->create_publisher<std_msgs::msg::String>(topic_, 1); }
  rclcpp::Node * node_; std::string topic_; };
class D : public rclcpp::Node { D() : Node("d"), fixed_(this, "fixed") { made_ = std::make_unique<Channel>(this, "made"); fixed_.open(); made_->open(); }
  Channel fixed_; std::unique_ptr<Channel> made_; };"""
    modules = workspace.package({"src/d.cpp": text}).modules()
    assert {entry.name for entry in modules["ecm.pkg.d"].signature.interfaces} == {"/fixed", "/made"}


def test_base_classes_of_another_package_bring_their_endpoints(workspace: Any) -> None:
    """What a base class declares belongs to each module that derives from it, marked with where it comes from."""
    base = 'namespace base { class Base : public rclcpp::Node { public: Base(const std::string & name, const std::string & topic) : Node(name) { declare_parameter("common", true); create_publisher<std_msgs::msg::String>(topic, 1); } }; }'
    workspace.package({"include/base/base.hpp": base}, name="base")
    workspace.package(
        {
            "src/d.cpp": '#include "base/base.hpp"\nclass D : public base::Base { public: D() : base::Base("derived", "from_derived") {} };'
        }
    )
    contract = workspace.modules()["ecm.pkg.derived"]
    found = {entry.role: entry for entry in contract.signature.interfaces}
    assert found["publisher"].name == "/from_derived"
    assert (found["parameter"].name, found["parameter"].inherited_from) == ("common", "Base")


def test_a_local_lambda_is_a_helper(workspace: Any) -> None:
    """A lambda bound to a name and called with a name is a form."""
    text = """
class D : public rclcpp::Node { D() : Node("d") {
  auto declare = [this](const std::string & name, double value) { return declare_parameter(name, value); };
  declare("gain", 1.5); } };"""
    entry = workspace.package({"src/d.cpp": text}).only("parameter")
    assert (entry.name, entry.default) == ("gain", 1.5)


def test_a_lambda_knows_the_members_of_its_object(workspace: Any) -> None:
    """A name that a lambda puts together from members and its arguments is folded."""
    text = """
class D : public rclcpp::Node { std::string root_ = "~/";
  D() : Node("d") { start(); }
  void start() {
    const std::string left = "left/";
    auto name = [&](const std::string & side, const std::string & leaf) { std::string topic = root_ + side + leaf; return topic; };
    topic_ = name(left, "image"); open(); }
  void open() { create_publisher<std_msgs::msg::String>(topic_, 1); }
  std::string topic_; };"""
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == "/d/left/image"


def test_defaults_stand_at_the_declaration_of_a_function(workspace: Any) -> None:
    """A helper outside of a class is called without the arguments that its declaration gives a default."""
    header = """#pragma once
namespace tools {
template<typename T>
void get(std::shared_ptr<rclcpp::Node> node, std::string name, T value, T & out, std::string log = std::string(), bool dynamic = false);
template<typename T>
void get(std::shared_ptr<rclcpp::Node> node, std::string name, T value, T & out, std::string log, bool dynamic)
{ node->declare_parameter(name, rclcpp::ParameterValue(value)); }
}"""
    text = """#include "tools.hpp"
class D : public rclcpp::Node { D() : Node("d") {
  tools::get(shared_from_this(), "short", 1, out_);
  tools::get(shared_from_this(), "long", 1, out_, "log", true); } int out_; };"""
    workspace.package({"src/tools.hpp": header, "src/d.cpp": text})
    assert {entry.name for entry in workspace.interfaces()} == {"short", "long"}


def test_python_helpers_with_spread_arguments(workspace: Any) -> None:
    """A topic given as a tuple is joined where the helper joins it."""
    text = """
from rclpy.node import Node
from std_msgs.msg import String
class Base(Node):
    def __init__(self, ns='robot'):
        super().__init__('demo')
        self._ns = ns
    def topic(self, *args):
        return '/'.join((self._ns,) + args)
    def subscribe_to(self, kind, *parts):
        return self.create_subscription(kind, self.topic(*parts), print, 10)
class Demo(Base):
    def start(self):
        self.subscribe_to(String, 'state', 'text')
"""
    entry = workspace.package({"pkg/demo.py": text}).only("subscriber")
    assert (entry.name, entry.type, entry.confidence) == (
        "/robot/state/text",
        "std_msgs/msg/String",
        "default",
    )


def test_overloads_are_told_apart_by_their_arguments(workspace: Any) -> None:
    """A default that is a number cannot mean the overload that takes a descriptor there."""
    text = """
class D : public rclcpp::Node { public: D() : Node("d") { get("a", 1.0); get<std::string>("b"); }
  template<class T> T get(const std::string & name, const Descriptor & d = Descriptor()) { return declare_parameter<T>(name, d); }
  template<class T> T get(const std::string & name, const T & value, const Descriptor & d = Descriptor()) { return declare_parameter(name, value, d); } };"""
    found = {(entry.name, entry.default) for entry in workspace.package({"src/d.cpp": text}).interfaces()}
    assert found == {("a", 1.0), ("b", None)}


def test_helpers_are_seen_through_headers_of_headers(workspace: Any) -> None:
    """What a file includes through its own header is in sight, and the argument's class chooses the overload."""
    helpers = HELPER + HELPER.replace(
        "const rclcpp::ParameterValue & value", "const rclcpp::ParameterType & kind"
    ).replace("name, value", "name, kind")
    workspace.package({"include/util/util.hpp": f"namespace util {{ {helpers} }}"}, name="util")
    workspace.package(
        {
            "include/pkg/own.hpp": '#include "util/util.hpp"\nclass D : public rclcpp::Node { public: D(); };',
            "src/d.cpp": '#include "pkg/own.hpp"\nusing util::declare_once;\nD::D() : Node("d") { declare_once(this, "speed", rclcpp::ParameterValue(0.5)); }',
        }
    )
    (entry,) = workspace.modules()["ecm.pkg.d"].signature.interfaces
    assert (entry.name, entry.default, [place.line for place in entry.evidence]) == ("speed", 0.5, [3, 4])


def test_a_method_hides_functions_of_its_name(workspace: Any) -> None:
    """A bare call in a class means the method, not the function that the method calls."""
    text = """
namespace make { template<class T> auto open(rclcpp::Node * node, const std::string & topic, int depth) { return node->create_publisher<T>(topic, depth); } }
class D : public rclcpp::Node { public: D() : Node("d") { open<std_msgs::msg::String>(topic_, depth_ + 1, keep()); }
  template<class T> auto open(const std::string & topic, int depth, bool keep) { return make::open<T>(this, topic, depth); }
  std::string topic_{"chatter"}; };"""
    assert workspace.package({"src/d.cpp": text}).only("publisher").name == "/chatter"


def test_handle_that_a_function_is_given_carries_its_namespace(workspace: Workspace) -> None:
    """`advertise(private_handle)` makes private names, also when the constructor keeps the handle in a member."""
    source = """
    #include <ros/ros.h>
    class Base {
    public:
      explicit Base(ros::NodeHandle & nh) : kept_(nh) { kept_.advertise<std_msgs::Bool>("kept", 1); }
      void init(ros::NodeHandle & nh) { advertise(nh); }
    private:
      void advertise(ros::NodeHandle & nh) { nh.advertise<std_msgs::Bool>("passed", 1); }
      ros::NodeHandle kept_;
    };
    int main(int argc, char ** argv) {
      ros::init(argc, argv, "base");
      ros::NodeHandle own("~");
      Base base(own);
      base.init(own);
    }
    """
    workspace.package({"src/base.cpp": source}, ros=1)
    assert sorted(entry.name for entry in workspace.interfaces()) == ["/base/kept", "/base/passed"]


PLUGINS = """
class Behavior { public: virtual void configure(const std::string & name) = 0; };
template<typename ActionT> class Timed : public Behavior { public:
  void configure(const std::string & name) override {
    server_ = rclcpp_action::create_server<ActionT>(node_, name, goal, cancel, accepted); }
  rclcpp::Node * node_; };
using SpinAction = nav2_msgs::action::Spin;
class Spin : public Timed<SpinAction> { };
PLUGINLIB_EXPORT_CLASS(Spin, Behavior)
class Host : public rclcpp::Node { Host() : Node("host") {
    for (size_t i = 0; i != ids_.size(); i++) { behaviors_[i]->configure(ids_[i]); }
    for (auto & each : behaviors_) { each->configure("all"); } behaviors_.front()->configure("first"); }
  std::vector<std::string> ids_; std::vector<pluginlib::UniquePtr<Behavior>> behaviors_; };
"""


def test_a_plugin_is_configured_by_a_host_that_knows_its_base_only(workspace: Any) -> None:
    """What a base class opens under the name that its host gives is of each plugin, not of the host."""
    modules = workspace.package({"src/p.cpp": PLUGINS}).modules()
    spin = [entry for entry in modules["ecm.pkg.spin"].signature.interfaces if entry.role == "action_server"]
    assert [(entry.name, entry.type) for entry in spin] == [("/{name}", "nav2_msgs/action/Spin")]
    host = [entry for entry in modules["ecm.pkg.host"].signature.interfaces if entry.role == "action_server"]
    assert host == []


def test_the_name_that_a_derived_class_returns_reaches_a_helper_object(workspace: Any) -> None:
    """Base class, helper object and virtual function: each derived class has a server under its own name."""
    text = """
template<class ActionT> class Server { public:
  Server(rclcpp::Node * node, const std::string & action_name) : action_name_(action_name), node_(node) {}
  void on_configure() { server_ = rclcpp_action::create_server<ActionT>(node_, action_name_, goal, cancel, accepted); }
  std::string action_name_; rclcpp::Node * node_; };
template<class ActionT> class Navigator : public rclcpp::Node { public:
  void on_configure() { server_ = std::make_unique<Server<ActionT>>(this, getName()); server_->on_configure(); }
  virtual std::string getName() = 0;
  std::unique_ptr<Server<ActionT>> server_; };
class ToPose : public Navigator<nav2_msgs::action::NavigateToPose> { ToPose() : Navigator("a") {}
  std::string getName() override { return std::string("to_pose"); } };
class Through : public Navigator<nav2_msgs::action::NavigateThroughPoses> { Through() : Navigator("b") {}
  std::string getName() override { return std::string("through"); } };"""
    modules = workspace.package({"src/n.cpp": text}).modules()
    for node, name, action in (("a", "to_pose", "NavigateToPose"), ("b", "through", "NavigateThroughPoses")):
        found = [entry for entry in modules[f"ecm.pkg.{node}"].signature.interfaces if entry.role == "action_server"]
        assert [(entry.name, entry.type) for entry in found] == [(f"/{name}", f"nav2_msgs/action/{action}")]


def test_each_program_has_its_own_helper(workspace: Any) -> None:
    """A function of the same name in another program of the package is another function."""
    text = (
        'void make(rclcpp::Node & node) {{ node.create_publisher<std_msgs::msg::String>("{0}", 1); }}'
        ' int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::Node node("{0}"); make(node); }}'
    )
    build = "add_executable(one src/one.cpp)\nadd_executable(two src/two.cpp)\n"
    files = {"src/one.cpp": text.format("one"), "src/two.cpp": text.format("two"), "CMakeLists.txt": build}
    found = workspace.package(files).modules()
    assert {
        name: [entry.name for entry in module.signature.interfaces if entry.role == "publisher"]
        for name, module in found.items()
    } == {"ecm.pkg.one": ["/one"], "ecm.pkg.two": ["/two"]}


def test_a_default_that_is_another_parameter_keeps_its_type(workspace: Any) -> None:
    """The value of a declaration, read into a variable, is a number still."""
    text = """
class D : public rclcpp::Node { D() : Node("d") {
  int qos = declare_parameter("qos", 1);
  double rate = declare_parameter("rate", rclcpp::ParameterValue(2.5)).get<double>();
  declare_parameter("qos_image", qos); declare_parameter("rate_image", rate); } };"""
    found = {entry.name: (entry.type, entry.default) for entry in workspace.package({"src/d.cpp": text}).interfaces()}
    assert found == {
        "qos": ("integer", 1),
        "rate": ("double", 2.5),
        "qos_image": ("integer", 1),
        "rate_image": ("double", 2.5),
    }


def test_a_receiver_whose_type_a_template_parameter_decides_may_be_any(workspace: Any) -> None:
    """`typename NodeT::WeakPtr node_` is of whatever the template is filled with: its methods may be forms."""
    text = """
class Own : public rclcpp::Node {
public:
  using WeakPtr = std::weak_ptr<Own>;
  Own() : Node("demo") {}
  template<typename T> T declared(const std::string & name, const T & value) { return declare_parameter(name, value); }
};
template<class A, class NodeT = Own> class Server {
public:
  explicit Server(const typename NodeT::WeakPtr & parent) : node_(parent) {}
  void configure() { auto node = node_.lock(); rate_ = node->declared("rate", 2); }
  typename NodeT::WeakPtr node_;
  int rate_;
};
int main(int c, char ** v) {
  rclcpp::init(c, v); auto node = std::make_shared<Own>(); Server<int> server(node); server.configure();
}
"""
    files = {"src/d.cpp": text, "CMakeLists.txt": "add_executable(demo src/d.cpp)\n"}
    entry = workspace.package(files).only("parameter")
    assert (entry.name, entry.type, entry.default) == ("rate", "integer", 2)
