"""Node handles: which namespace a name is relative to, and what an object of unknown type is."""

from __future__ import annotations

from typing import Any

import pytest

MEMBERS = """
#include <ros/ros.h>
class Filter : public outside::Nodelet {{
  virtual void onInit() {{
    outside::Nodelet::onInit();
    auto a = {receiver}->advertise<std_msgs::String>("out", 1);
  }}
}};
PLUGINLIB_EXPORT_CLASS(Filter, nodelet::Nodelet)
"""
RECEIVERS = ["pnh_", "private_nh_", "privateNodeHandle", "this->pnh_", "nh_"]


@pytest.mark.parametrize("receiver", RECEIVERS)
def test_a_handle_that_nothing_in_the_tree_makes_is_told_as_unknown(workspace: Any, receiver: str) -> None:
    """A class outside the tree makes the handle: what it is called decides nothing."""
    files = {"src/filter.cpp": MEMBERS.format(receiver=receiver)}
    found = workspace.package(files, ros=1).only("publisher")
    label = receiver.removeprefix("this->").strip("_")
    assert (found.name, found.confidence) == (f"/{{{label}}}/out", "pattern")


HELD = """
#include <ros/ros.h>
struct Shared {{ Shared() : nh_("~shared") {{}} ros::NodeHandle & handle() {{ return nh_; }} ros::NodeHandle nh_; }};
class Talker {{
 public:
  Talker({parameters}) {initialisers} {{ pub_ = {receiver}.advertise<std_msgs::String>("out", 1); }}
  ros::NodeHandle nh_, private_nh_;
  ros::NodeHandle * elsewhere_;
  Shared shared_;
  ros::Publisher pub_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "n"); {make} }}
"""
CASES = {
    "a held handle is the node's": ("", "", "nh_", "Talker t;", "/out", "literal"),
    "whatever it is called": ("", "", "private_nh_", "Talker t;", "/out", "literal"),
    "an initialiser makes it": ("", ': nh_("~")', "nh_", "Talker t;", "/n/out", "literal"),
    "below another one": ("", ': nh_("~"), private_nh_(nh_, "a")', "private_nh_", "Talker t;", "/n/a/out", "literal"),
    "below a text": ("", ': nh_(ros::NodeHandle("a"), "b")', "nh_", "Talker t;", "/a/b/out", "literal"),
    "of a namespace that is passed": ("std::string ns", ": nh_(ns)", "nh_", 'Talker t("a");', "/a/out", "literal"),
    "of a handle that is passed": (
        "ros::NodeHandle & h",
        ": nh_(h)",
        "nh_",
        'ros::NodeHandle q("~"); Talker t(q);',
        "/n/out",
        "literal",
    ),
    "of another object": ("", "", "shared_.nh_", "Talker t;", "/n/shared/out", "literal"),
    "that another object gives": ("", "", "shared_.handle()", "Talker t;", "/n/shared/out", "literal"),
    "a pointer that nobody sets": ("", "", "(*elsewhere_)", "Talker t;", "/{elsewhere}/out", "pattern"),
    "a namespace that nobody knows": (
        "",
        ": nh_(outside())",
        "nh_",
        "Talker t;",
        "/{nh}/out",
        "pattern",
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_handle_is_what_makes_it(workspace: Any, case: tuple[str, ...]) -> None:
    """Constructors, arguments, members of other objects and what functions return tell the namespace of a handle."""
    parameters, initialisers, receiver, make, name, confidence = case
    text = HELD.format(parameters=parameters, initialisers=initialisers, receiver=receiver, make=make)
    found = workspace.package({"src/m.cpp": text}, ros=1).only("publisher")
    assert (found.name, found.confidence) == (name, confidence)


def test_each_constructor_makes_a_handle_of_its_own(workspace: Any) -> None:
    """Of two constructors the one that is called tells the handle."""
    text = (
        'class A { public: A() : h_("~") { go(); } A(ros::NodeHandle & h) : h_(h) { go(); }'
        ' void go() { pub_ = h_.advertise<std_msgs::String>("out", 1); } ros::NodeHandle h_; ros::Publisher pub_; };'
        ' int main(int c, char ** v) { ros::init(c, v, "n"); A a; ros::NodeHandle low("low"); A b(low); }'
    )
    names = {entry.name for entry in workspace.package({"src/m.cpp": text}, ros=1).interfaces()}
    assert names == {"/n/out", "/low/out"}


CONTROLLER = """
class Wheel : public controller_interface::Controller<hardware_interface::EffortJointInterface> {{
 public:
  bool init(hardware_interface::EffortJointInterface * hw{parameters}) {{
    pub_ = {receiver}.advertise<std_msgs::String>("out", 1);
    return true;
  }}
  ros::Publisher pub_;
}};
PLUGINLIB_EXPORT_CLASS(Wheel, controller_interface::ControllerBase)
"""
GIVEN = [
    (", ros::NodeHandle & n", "n", "/{controller}/out", "pattern"),
    (", ros::NodeHandle & a, ros::NodeHandle & b", "a", "/out", "literal"),
    (", ros::NodeHandle & a, ros::NodeHandle & b", "b", "/{controller}/out", "pattern"),
]


@pytest.mark.parametrize(("parameters", "receiver", "name", "confidence"), GIVEN)
def test_controllers_are_given_their_handles(
    workspace: Any, parameters: str, receiver: str, name: str, confidence: str
) -> None:
    """The controller manager hands out the namespace of the robot first, then that of the controller."""
    text = CONTROLLER.format(parameters=parameters, receiver=receiver)
    found = workspace.package({"src/m.cpp": text}, ros=1).only("publisher")
    assert (found.name, found.confidence) == (name, confidence)


MADE = [
    (
        (
            "ros::Publisher pub; boost::shared_ptr<ros::NodeHandle> shared;"
            ' int main(int c, char ** v) { ros::init(c, v, "n"); shared.reset(new ros::NodeHandle("~sub"));'
            ' pub = shared->advertise<std_msgs::String>("out", 1); }'
        ),
        "/n/sub/out",
    ),
    (
        (
            "namespace a { boost::shared_ptr<ros::NodeHandle> shared; void go()"
            ' { auto p = shared->advertise<std_msgs::String>("out", 1); } }'
            ' int main(int c, char ** v) { ros::init(c, v, "n"); a::shared.reset(new ros::NodeHandle("~")); a::go(); }'
        ),
        "/n/out",
    ),
    (
        (
            'class A { public: A(const ros::NodeHandle & given = ros::NodeHandle("~")) : held_(given)'
            ' { pub_ = held_.advertise<std_msgs::String>("out", 1); } ros::NodeHandle held_; ros::Publisher pub_; };'
            ' int main(int c, char ** v) { ros::init(c, v, "n"); A a; }'
        ),
        "/n/out",
    ),
    (
        (
            'class A { public: A() { held_.reset(new ros::NodeHandle("~"));'
            ' pub_ = held_->advertise<std_msgs::String>("out", 1); }'
            " std::shared_ptr<ros::NodeHandle> held_; ros::Publisher pub_; };"
            ' int main(int c, char ** v) { ros::init(c, v, "n"); A a; }'
        ),
        "/n/out",
    ),
]


@pytest.mark.parametrize(("text", "name"), MADE, ids=["global", "in a namespace", "default argument", "reset"])
def test_handles_are_followed_to_where_they_are_made(workspace: Any, text: str, name: str) -> None:
    """Globals, default arguments and pointers that are set later have the namespace of the handle that they hold."""
    entry = workspace.package({"src/m.cpp": text}, ros=1).only("publisher")
    assert (entry.name, entry.type) == (name, "std_msgs/msg/String")


def test_below_a_handle_that_is_not_known_every_name_is_a_pattern(workspace: Any) -> None:
    """A name is as sure as the namespace that it stands in: what is told of it is not said to be read."""
    text = (
        "int main(int c, char ** v) {"
        ' ros::init(c, v, "n"); ros::NodeHandle nh(outside::space());'
        ' auto a = nh.advertise<std_msgs::String>("out", 1); }'
    )
    entry = workspace.package({"src/m.cpp": text}, ros=1).only("publisher")
    assert entry.confidence == "pattern"
    assert entry.name.endswith("/out")
    assert "{" in entry.name


UNKNOWN = [
    ('nh->advertise<std_msgs::Bool>("in", 1)', ["std_msgs/msg/Bool"]),
    ('it_->advertise<std_msgs::Bool>("in", 1)', ["std_msgs/msg/Bool"]),
    ('nh->subscribe("in", 1, &A::seen, this)', []),
    ('image_transport_->advertise("in", 1)', []),
    ('nh->param("rate", rate_, 10.0)', ["double"]),
    ('nh->param("rate", 10.0)', []),
    ("nh->param(key, rate_, 10.0)", []),
]


@pytest.mark.parametrize(("call", "kinds"), UNKNOWN, ids=[row[0] for row in UNKNOWN])
def test_an_unknown_receiver_is_not_what_it_is_called(workspace: Any, call: str, kinds: list[str]) -> None:
    """Only what the call itself says counts, as the message type in its template; the name of the object does not."""
    text = (
        "class A : public outside::Nodelet { double rate_; void seen(const std_msgs::StringConstPtr & m) {}"
        f" void onInit() {{ auto a = {call}; }} }}; PLUGINLIB_EXPORT_CLASS(A, nodelet::Nodelet)"
    )
    found = workspace.package({"src/a.cpp": text}, ros=1).interfaces()
    assert [entry.type for entry in found] == kinds


READS = [
    ('if (!nh->getParam("rate", rate_)) { rate_ = 2.0; }', ["double"]),
    ('if (space().getParam("rate", rate_)) { warn(); }', ["double"]),
    ('if (!this->template space<int>().getParam("rate", rate_)) { return; }', ["double"]),
    ('nh->getParam("rate", rate_);', []),
    ("if (!nh->getParam(key, rate_)) { return; }", []),
    ('if (!opened->getParam("rate", rate_)) { return; }', []),
    ('if (!own_->getParam("rate", rate_)) { return; }', []),
    ('if (!lib::open().getParam("rate", rate_)) { return; }', []),
]


@pytest.mark.parametrize(("read", "kinds"), READS, ids=[row[0] for row in READS])
def test_what_an_unseen_base_gives_is_a_handle_where_a_condition_reads_a_parameter(
    workspace: Any, read: str, kinds: list[str]
) -> None:
    """A condition that reads what a text names into a variable says enough of what only a base can have made."""
    text = (
        "class A : public outside::Nodelet { double rate_; lib::Device * own_;"
        f" void onInit() {{ auto opened = lib::open(); {read} }} }};"
        " PLUGINLIB_EXPORT_CLASS(A, nodelet::Nodelet)"
    )
    found = workspace.package({"src/a.cpp": text}, ros=1).interfaces()
    assert [entry.type for entry in found if entry.role == "parameter"] == kinds


NAMESPACES = [
    ("const std::string & ns", "ns", 'Pose pose("arm");', "/arm/out"),
    ("std::string ns", 'ns + "/left"', 'Pose pose("arm");', "/arm/left/out"),
    ("const std::string & ns", "ns", "Pose pose(argv[1]);", "/{item}/out"),
    ("const ros::NodeHandle & ns", "ns", 'Pose pose(ros::NodeHandle("arm"));', "/arm/out"),
]


@pytest.mark.parametrize(("given", "value", "made", "name"), NAMESPACES, ids=[row[2] for row in NAMESPACES])
def test_a_handle_stands_in_the_namespace_that_its_object_is_made_with(
    workspace: Any, given: str, value: str, made: str, name: str
) -> None:
    """A member `nh_(ns)` made of a text names what is below that namespace, whoever gives it."""
    source = f"""
#include <ros/ros.h>
class Pose {{
 public:
  explicit Pose({given}) : nh_({value}) {{ nh_.advertise<std_msgs::String>("out", 1); }}
  ros::NodeHandle nh_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  {made}
}}
"""
    assert workspace.package({"src/demo.cpp": source}, ros=1).only("publisher").name == name


PART = """
class Part {
 public:
  explicit Part(const ros::NodeHandle & h, double span = 3.0) : inner_(ros::NodeHandle(h, "part")) {
    pub_ = inner_.advertise<std_msgs::String>("out", 1);
  }
  ros::NodeHandle inner_;
  ros::Publisher pub_;
};
struct Held { std::unique_ptr<Part> part_; };
"""
DERIVED = """
#include <ros/ros.h>
{part}
class Base {held} {{
 public:
  Base(ros::NodeHandle & given) {constructor}
  virtual bool configure() {{ {configure} return true; }}
  ros::NodeHandle own_;
  ros::Publisher pub_;
}};
class Derived : public Base {{
 public:
  Derived(ros::NodeHandle & given) : Base(given) {{}}
  bool configure() override {{ return Base::configure(); }}
}};
class Other : public Base {{
 public:
  Other(ros::NodeHandle & given) : Base(given) {{}}
}};
class Host {{
 public:
  explicit Host(const ros::NodeHandle & given) : given_(given) {{ reset(); }}
  void reset() {{
    if (kind_ == "a") {{ made_ = std::make_shared<Derived>(given_); }} else {{ made_ = std::make_shared<Other>(given_); }}
    made_->configure();
  }}
  ros::NodeHandle given_;
  std::shared_ptr<Base> made_;
  std::string kind_;
}};
int main(int c, char ** v) {{ ros::init(c, v, "n"); ros::NodeHandle nh("~"); {make} }}
"""
OWN_OUT = 'pub_ = own_.advertise<std_msgs::String>("out", 1);'
BASES = {
    "in the body of a constructor": ("{ own_ = given; }", OWN_OUT, "Base b(nh); b.configure();", "/n/out"),
    "of a base that a host makes": (": own_(given) {}", OWN_OUT, "Host h(nh);", "/n/out"),
    "of both": ("{ own_ = given; }", OWN_OUT, "Host h(nh);", "/n/out"),
    "below the one of a member": ("{ own_ = given; }", "part_.reset(new Part(own_));", "Host h(nh);", "/n/part/out"),
    "of a member in a body": ("{ part_.reset(new Part(given)); }", "", "Base b(nh); b.configure();", "/n/part/out"),
}


@pytest.mark.parametrize("case", BASES.values(), ids=BASES)
def test_a_handle_is_followed_through_bases_and_members_to_who_made_it(workspace: Any, case: tuple[str, ...]) -> None:
    """What a constructor does in its body counts like its list, and who makes a derived object gives its base."""
    constructor, configure, make, name = case
    part, held = (PART, ": public Held") if "part" in name else ("", "")
    text = DERIVED.format(part=part, held=held, constructor=constructor, configure=configure, make=make)
    workspace.package({"src/n.cpp": text}, ros=1)
    program = next(module for module in workspace.modules().values() if module.ecm.kind == "node")
    assert {found.name for found in program.signature.interfaces if found.role == "publisher"} == {name}


def test_a_handle_of_an_object_that_a_method_named_with_its_class_gives(workspace: Any) -> None:
    """Two classes have a method of one name: the one that is named tells of which type its object is."""
    text = """
#include <ros/ros.h>
class Settings {
 public:
  static Settings & instance() { static Settings instance; return instance; }
  std::shared_ptr<ros::NodeHandle> handle_;
  int size_;
 private:
  Settings() { handle_ = std::make_shared<ros::NodeHandle>("inner"); size_ = 7; }
};
class Reader {
 public:
  static Reader & instance() { static Reader instance; return instance; }
  void read(const std_msgs::StringConstPtr & message) {}
 private:
  Reader() {
    sub_ = ros::Subscriber(Settings::instance().handle_->subscribe("in", Settings::instance().size_, &Reader::read, this));
  }
  ros::Subscriber sub_;
};
int main(int c, char ** v) { ros::init(c, v, "n"); Reader::instance(); ros::spin(); }
"""
    found = workspace.package({"src/n.cpp": text}, ros=1).only("subscriber")
    assert (found.name, found.qos.depth) == ("/inner/in", 7)
