"""Generated parameters belong to what makes their server or listener, however it is written."""

from __future__ import annotations

from typing import Any

import pytest

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("gain", double_t, 0, "Gain.", 0.5, 0.0, 1.0)
exit(gen.generate("pkg", "demo", "Demo"))
"""
PYTHON = """#!/usr/bin/env python
import rospy
{imports}

def main():
    rospy.init_node('demo')
    server = {made}

if __name__ == '__main__':
    main()
"""
CLASS = """
class Demo : public nodelet::Nodelet {{
  {types}
  boost::shared_ptr<{member}> server_;
}};
"""
MADE = [
    ("from dynamic_reconfigure.server import Server\nfrom pkg.cfg import DemoConfig", "Server(DemoConfig, on_set)"),
    (
        "import dynamic_reconfigure.server\nfrom pkg.cfg import DemoConfig as C",
        "dynamic_reconfigure.server.Server(C, on_set)",
    ),
    ("from dynamic_reconfigure.server import Server as S\nimport pkg.cfg.DemoConfig as C", "S(C, on_set)"),
]
NOT_MADE = [
    ("from other.server import Server\nfrom pkg.cfg import DemoConfig", "Server(DemoConfig, on_set)"),
    ("from dynamic_reconfigure.server import Server\nfrom pkg.cfg import OtherConfig", "Server(OtherConfig, on_set)"),
    (
        "from dynamic_reconfigure.server import Server\nfrom pkg.cfg import DemoConfig",
        "Server(DemoConfig, on_set, 'below')",
    ),
]
PLACED = [
    ("ros::NodeHandle()", "/gain"),
    ('ros::NodeHandle("~")', "/demo/gain"),
    ('ros::NodeHandle("/arm/driver")', "/arm/driver/gain"),
    ('ros::NodeHandle("~/limits")', "/demo/limits/gain"),
]
MAIN = """#include <ros/ros.h>
#include <dynamic_reconfigure/server.h>
#include <pkg/DemoConfig.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  dynamic_reconfigure::Server<pkg::DemoConfig> server({handle});
  ros::spin();
}}
"""
MEMBERS = [
    ("", "dynamic_reconfigure::Server<pkg::DemoConfig>"),
    ("typedef dynamic_reconfigure::Server<pkg::DemoConfig> Settings;", "Settings"),
    ("using Config = pkg::DemoConfig; typedef dynamic_reconfigure::Server<Config> Settings;", "Settings"),
]


def _parameters(workspace: Any, files: dict[str, str], ros: int) -> list[tuple[str, object]]:
    found = workspace.package(files, ros=ros).interfaces()
    return [(entry.raw_name, entry.default) for entry in found if entry.role == "parameter"]


def _catkin(path: str, text: str) -> dict[str, str]:
    cmake = "project(pkg)\ngenerate_dynamic_reconfigure_options(cfg/Demo.cfg)\n"
    return {"cfg/Demo.cfg": CFG, "CMakeLists.txt": cmake, path: text}


@pytest.mark.parametrize(("imports", "made"), MADE, ids=[row[1] for row in MADE])
def test_a_server_of_python(workspace: Any, imports: str, made: str) -> None:
    """The first argument is the generated module or class, as it was imported."""
    files = _catkin("scripts/demo.py", PYTHON.format(imports=imports, made=made))
    assert _parameters(workspace, files, 1) == [("~gain", 0.5)]


@pytest.mark.parametrize(("handle", "name"), PLACED, ids=[row[0] for row in PLACED])
def test_parameters_stand_beside_the_service_of_their_server(workspace: Any, handle: str, name: str) -> None:
    """A server sets the parameters of the handle that it is made with (dynamic_reconfigure/server.h)."""
    files = _catkin("src/demo.cpp", MAIN.format(handle=handle))
    files["CMakeLists.txt"] += "add_executable(demo src/demo.cpp)\n"
    found = workspace.package(files, ros=1).interfaces()
    assert [entry.name for entry in found if entry.role == "parameter"] == [name]


def test_two_servers_of_one_file_give_parameters_twice(workspace: Any) -> None:
    """Which of two handles is meant is not told: each name is one of two."""
    two = MAIN.format(handle='ros::NodeHandle("~/a")').replace(
        "  ros::spin", '  dynamic_reconfigure::Server<pkg::DemoConfig> other(ros::NodeHandle("~/b"));\n  ros::spin'
    )
    files = _catkin("src/demo.cpp", two)
    files["CMakeLists.txt"] += "add_executable(demo src/demo.cpp)\n"
    found = [entry for entry in workspace.package(files, ros=1).interfaces() if entry.role == "parameter"]
    assert [entry.name for entry in found] == ["/demo/a/gain", "/demo/b/gain"]
    assert {entry.confidence for entry in found} == {"one_of"}


DECLARED = [
    'dynamic_reconfigure::Server<pkg::DemoConfig> server_ {mutex_, ros::NodeHandle("limits")};',
    'dynamic_reconfigure::\n    Server<pkg::DemoConfig>\n    server_ {mutex_, ros::NodeHandle("limits")};',
    """dynamic_reconfigure::Server<pkg::DemoConfig> server_ {ros::NodeHandle("limits")};
  dynamic_reconfigure::Server<pkg::DemoConfig>::CallbackType called_;""",
]


@pytest.mark.parametrize("declared", DECLARED)
def test_a_member_is_made_as_it_is_declared(workspace: Any, declared: str) -> None:
    """A mutex may stand in front of the handle, a type on several lines; what a server calls a type is no server."""
    member = f"class Demo {{ public: Demo() {{}} boost::recursive_mutex mutex_; {declared} }};\nint main"
    text = MAIN.format(handle="").replace("  dynamic_reconfigure::Server<pkg::DemoConfig> server();", "  Demo demo;")
    files = _catkin("src/demo.cpp", text.replace("int main", member))
    files["CMakeLists.txt"] += "add_executable(demo src/demo.cpp)\n"
    found = [entry for entry in workspace.package(files, ros=1).interfaces() if entry.role == "parameter"]
    assert [(entry.name, entry.confidence) for entry in found] == [("/limits/gain", "literal")]


INITIALISED = [
    ('Demo() : server_(ros::NodeHandle("~/limits")) {}', {"/demo/limits/gain"}),
    ("Demo() {}", {"/demo/gain"}),
    ('Demo() : server_(mutex_, ros::NodeHandle("limits")) {} boost::recursive_mutex mutex_;', {"/limits/gain"}),
    ("Demo() {} dynamic_reconfigure::Server<pkg::DemoConfig>::CallbackType called_;", {"/demo/gain"}),
    ('Demo() : server_(ros::NodeHandle("~/a")) {} Demo(int x) {}', {"/demo/a/gain", "/demo/gain"}),
]


@pytest.mark.parametrize(("makers", "names"), INITIALISED, ids=[row[0] for row in INITIALISED])
def test_a_member_that_every_constructor_initialises_is_made_once(workspace: Any, makers: str, names: set[str]) -> None:
    """The declaration of a member makes it only where an initialiser list does not (C++ class.base.init)."""
    text = MAIN.format(handle="").replace("  dynamic_reconfigure::Server<pkg::DemoConfig> server();", "  Demo demo;")
    member = f"class Demo {{ public: {makers} dynamic_reconfigure::Server<pkg::DemoConfig> server_; }};\nint main"
    files = _catkin("src/demo.cpp", text.replace("int main", member))
    files["CMakeLists.txt"] += "add_executable(demo src/demo.cpp)\n"
    found = [entry for entry in workspace.package(files, ros=1).interfaces() if entry.role == "parameter"]
    assert {entry.name for entry in found} == names


NO_SERVER = [
    'dynamic_reconfigure::Client<pkg::DemoConfig> client("/other");',
    'auto client = new dynamic_reconfigure::Client<pkg::DemoConfig>("/other");',
    "pkg::DemoConfig config = pkg::DemoConfig::__getDefault__();",
]


@pytest.mark.parametrize("body", NO_SERVER)
def test_who_asks_for_a_configuration_does_not_offer_it(workspace: Any, body: str) -> None:
    """A client of another node, or a record of the settings, is no server of them (dynamic_reconfigure/client.h)."""
    text = MAIN.format(handle="").replace("dynamic_reconfigure::Server<pkg::DemoConfig> server();", body)
    assert _parameters(workspace, _catkin("src/demo.cpp", text), 1) == []


@pytest.mark.parametrize(("imports", "made"), NOT_MADE, ids=[row[0] + row[1] for row in NOT_MADE])
def test_another_server_offers_other_parameters(workspace: Any, imports: str, made: str) -> None:
    """Another class, another file, or another namespace than that of the node."""
    files = _catkin("scripts/demo.py", PYTHON.format(imports=imports, made=made))
    assert _parameters(workspace, files, 1) == []


@pytest.mark.parametrize(("types", "member"), MEMBERS, ids=[row[0] + row[1] for row in MEMBERS])
def test_a_server_behind_aliases(workspace: Any, types: str, member: str) -> None:
    """Aliases in the class stand for the server and for its configuration."""
    files = _catkin("src/demo.cpp", CLASS.format(types=types, member=member))
    assert _parameters(workspace, files, 1) == [("~gain", 0.5)]


def test_a_listener_that_setup_py_generates(workspace: Any) -> None:
    """generate_parameter_module of setup.py names the file, its listener the node."""
    setup = """
from generate_parameter_library_py.setup_helper import generate_parameter_module
from setuptools import setup
where = "pkg/demo.yaml"
generate_parameter_module("demo_parameters", where)
setup(name="pkg", packages=["pkg"], entry_points={"console_scripts": ["demo = pkg.node:main"]})
"""
    node = """
import rclpy
from rclpy.node import Node
from pkg.demo_parameters import demo

class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.listener = demo.ParamListener(self)

def main():
    rclpy.spin(Demo())
"""
    yaml = "demo:\n  gains:\n    p:\n      type: double\n      default_value: 2.0\n"
    files = {"setup.py": setup, "pkg/node.py": node, "pkg/__init__.py": "", "pkg/demo.yaml": yaml}
    assert _parameters(workspace, files, 2) == [("gains.p", 2.0)]


TWO_SERVERS = """#include <ros/ros.h>
class Planner {
 public:
  Planner() {
    ros::NodeHandle own("~own"), other("~other");
    own_.reset(new dynamic_reconfigure::Server<pkg::DemoConfig>(own));
    other_.reset(new dynamic_reconfigure::Server<elsewhere::OtherConfig>(other));
  }
  boost::shared_ptr<dynamic_reconfigure::Server<pkg::DemoConfig>> own_;
  boost::shared_ptr<dynamic_reconfigure::Server<elsewhere::OtherConfig>> other_;
};
int main(int c, char ** v) { ros::init(c, v, "demo"); Planner planner; ros::spin(); }
"""


def test_each_of_two_servers_of_a_class_has_its_own_configuration(workspace: Any) -> None:
    """Beside the server of another package's configuration stands nothing of this one's."""
    found = workspace.package(_catkin("src/demo.cpp", TWO_SERVERS), ros=1).interfaces()
    assert {entry.raw_name for entry in found if entry.role == "parameter"} == {"~own/gain"}


CALLBACK = """
#include <dynamic_reconfigure/server.h>
#include <pkg/DemoConfig.h>
class Planner {
 public:
  Planner() {
    ros::NodeHandle own("~own");
    server_ = std::make_shared<Settings>(own);
  }
  using Settings = dynamic_reconfigure::Server<pkg::DemoConfig>;
  using OnSet = dynamic_reconfigure::Server<pkg::DemoConfig>::CallbackType;
  std::shared_ptr<Settings> server_;
  OnSet on_set_;
};
int main(int c, char ** v) { ros::init(c, v, "demo"); Planner planner; ros::spin(); }
"""


def test_what_a_server_calls_a_type_is_no_server(workspace: Any) -> None:
    """A member whose type is an alias of the callback's type makes no second server below the node itself."""
    found = workspace.package(_catkin("src/demo.cpp", CALLBACK), ros=1).interfaces()
    assert {entry.raw_name for entry in found if entry.role == "parameter"} == {"~own/gain"}
    assert {entry.raw_name for entry in found if entry.role == "service_server"} == {"~own/set_parameters"}


NAMED = """
#include <ros/ros.h>
#include <dynamic_reconfigure/server.h>
#include <pkg/DemoConfig.h>
class Part {{
 public:
  explicit Part(const std::string & name) : name_(name), server_({given}) {{}}
  std::string name_;
  dynamic_reconfigure::Server<pkg::DemoConfig> server_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  Part part("arm");
  ros::spin();
}}
"""


@pytest.mark.parametrize("given", ["name_", '"arm"', "ros::NodeHandle(name_)"])
def test_a_server_that_is_given_a_name_is_below_it(workspace: Any, given: str) -> None:
    """Its parameter takes handles only, so that one is made of a text: the parameters are no private ones."""
    files = {
        "cfg/Demo.cfg": CFG,
        "src/demo.cpp": NAMED.format(given=given),
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n"
        "generate_dynamic_reconfigure_options(cfg/Demo.cfg)\n",
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "parameter"} == {"/arm/gain"}
    assert "/arm/set_parameters" in {entry.name for entry in found}
