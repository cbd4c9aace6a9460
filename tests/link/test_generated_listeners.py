"""Listeners of generate_parameter_library: who makes one declares, below the prefix that its constructor is given."""

from __future__ import annotations

from typing import Any

import pytest

FILES = {
    "CMakeLists.txt": "project(pkg)\ngenerate_parameter_library(demo_parameters src/demo.yaml)\n",
    "src/demo.yaml": "demo:\n  queue:\n    type: int\n    default_value: 7\n",
}
NODE = """
#include "demo_parameters.hpp"
{above}
class Demo : public rclcpp::Node {{ public:
  explicit Demo(const std::string & side) : Node("demo") {{ {made} }}
  std::shared_ptr<demo::ParamListener> listener_, other_;
  rclcpp::Logger logger_;
}};
"""
MAKE = "listener_ = std::make_shared<demo::ParamListener>"
ROWS = [
    ("none", f"{MAKE}(get_node_parameters_interface());", {("queue", "literal")}),
    ("a text", f'{MAKE}(get_node_parameters_interface(), "arm");', {("arm.queue", "folded")}),
    ("with its point", f'{MAKE}(get_node_parameters_interface(), "arm.");', {("arm.queue", "folded")}),
    ("an empty one", f'{MAKE}(get_node_parameters_interface(), "");', {("queue", "literal")}),
    ("a variable", f'const std::string p = "arm"; {MAKE}(shared_from_this(), p);', {("arm.queue", "folded")}),
    ("what a caller gives", f"{MAKE}(shared_from_this(), side);", {("{side}.queue", "pattern")}),
    ("a logger", f"{MAKE}(get_node_parameters_interface(), get_logger());", {("queue", "literal")}),
    (
        "a logger of this object",
        f"{MAKE}(get_node_parameters_interface(), this->get_logger());",
        {("queue", "literal")},
    ),
    ("a logger of a node", f"{MAKE}(get_node_parameters_interface(), other->get_logger());", {("queue", "literal")}),
    ("a logger of its own", f"{MAKE}(get_node_parameters_interface(), logger_);", {("queue", "literal")}),
    ("behind a logger", f'{MAKE}(get_node_parameters_interface(), get_logger(), "arm");', {("arm.queue", "folded")}),
    (
        "two",
        f'{MAKE}(shared_from_this(), "arm"); other_ = std::make_shared<demo::ParamListener>(shared_from_this(), "leg");',
        {("arm.queue", "folded"), ("leg.queue", "folded")},
    ),
    ("of an alias", 'auto made = std::make_shared<Short>(shared_from_this(), "arm");', {("arm.queue", "folded")}),
]


@pytest.mark.parametrize(("made", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_parameters_are_below_the_prefix_of_their_listener(
    workspace: Any, made: str, expected: set[tuple[str, str]]
) -> None:
    """They were told without it, and as if that were known."""
    text = NODE.format(above="using Short = demo::ParamListener;", made=made)
    found = workspace.package({**FILES, "src/demo.cpp": text}).interfaces()
    assert {(entry.name, entry.confidence) for entry in found if entry.role == "parameter"} == expected


PYTHON = """
from rclpy.node import Node
from pkg.demo_parameters import demo
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.listener = demo.ParamListener(self{given})
"""


@pytest.mark.parametrize(("given", "name"), [("", "queue"), (", 'arm'", "arm.queue"), (", prefix='arm.'", "arm.queue")])
def test_listeners_of_python_have_prefixes(workspace: Any, given: str, name: str) -> None:
    """The module that is generated for Python takes it as its second argument."""
    setup = {"setup.py": "from setuptools import setup\nsetup(name='pkg', packages=['pkg'])\n", "pkg/__init__.py": ""}
    made = workspace.package({**FILES, **setup, "pkg/demo.py": PYTHON.format(given=given)})
    assert made.only("parameter").name == name


DEPENDS = '<package format="3"><name>user</name><version>1.0.0</version>{depend}<export><build_type>ament_cmake</build_type></export></package>'


@pytest.mark.parametrize(("depend", "names"), [("<depend>pkg</depend>", ["queue"]), ("", [])])
def test_who_makes_a_listener_of_another_package_declares_its_parameters(
    workspace: Any, depend: str, names: list[str]
) -> None:
    """A namespace of a package that it does not depend on may be one of somewhere else."""
    workspace.package(FILES)
    text = NODE.format(above="", made=f"{MAKE}(shared_from_this());")
    made = workspace.package({"package.xml": DEPENDS.format(depend=depend), "src/user.cpp": text}, name="user")
    found = [
        entry for name, module in made.modules().items() if ".user." in name for entry in module.signature.interfaces
    ]
    assert [entry.name for entry in found if entry.role == "parameter"] == names


def test_who_only_mentions_a_listener_of_another_package_was_given_it(workspace: Any) -> None:
    """It has no parameters of its own by that."""
    workspace.package(FILES)
    text = NODE.format(above="", made="")
    made = workspace.package(
        {"package.xml": DEPENDS.format(depend="<depend>pkg</depend>"), "src/user.cpp": text}, name="user"
    )
    assert not [entry for entry in made.interfaces() if entry.role == "parameter"]


CONTROLLER = """
#include "demo_parameters.hpp"
class Held : public {base} {{ public:
  Held() : {base}({given}) {{}}
  void begin() {{ listener_ = std::make_shared<demo::ParamListener>(get_node()); }}
  std::shared_ptr<demo::ParamListener> listener_;
}};
PLUGINLIB_EXPORT_CLASS(Held, {base})
"""


@pytest.mark.parametrize(
    ("base", "given", "default"),
    [("controller_interface::ControllerInterface", "", None), ("rclcpp::Node", '"held"', 9)],
)
def test_what_a_base_has_declared_has_its_default(workspace: Any, base: str, given: str, default: int | None) -> None:
    """A listener declares only what nobody did: controllers have the rate of their manager before."""
    files = {**FILES, "src/demo.yaml": "demo:\n  update_rate:\n    type: int\n    default_value: 9\n"}
    made = workspace.package({**files, "src/held.cpp": CONTROLLER.format(base=base, given=given)})
    assert made.only("parameter").default == default
