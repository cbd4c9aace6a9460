"""Functions outside of the tree that get a node and a name are a gap; all that is known is none."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.tree import open_tree

CMAKE = "project(pkg)\nadd_executable(demo src/demo.cpp)\n"
MAIN = """
#include <ros/ros.h>
#include <outside/helpers.h>
{head}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  double rate = 0;
  {call}
}}
"""
CALLS = {
    "a function outside": ("", 'outside::readParameter(nh, "rate", rate);', ["outside::readParameter"]),
    "a pointer": ("", 'outside::readParameter(&nh, "rate", rate);', ["outside::readParameter"]),
    "called twice": ("", 'outside::read(nh, "a", rate); outside::read(nh, "b", rate);', ["outside::read"]),
    "a function of the tree": ("void ask(ros::NodeHandle & nh, const char * name) {}", 'ask(nh, "rate");', []),
    "no node": ("", 'outside::readParameter("rate", rate);', []),
    "no name": ("", "outside::readParameter(nh, rate);", []),
    "a client library": ("", 'ros::NodeHandle inner(nh, "inner"); nh.param("rate", rate, 1.0);', []),
    "a macro that prints": ("", 'ROS_INFO("%p of %f", &nh, rate);', []),
}


@pytest.mark.parametrize(("head", "call", "expected"), CALLS.values(), ids=CALLS)
def test_who_gets_a_node_and_a_name_is_told(workspace: Any, head: str, call: str, expected: list[str]) -> None:
    """Each function once for a file, as something that is outside."""
    workspace.package({"CMakeLists.txt": CMAKE, "src/demo.cpp": MAIN.format(head=head, call=call)}, ros=1)
    found = extract(open_tree(workspace.root), Options(jobs=1))
    told = [entry for entry in found.diagnostics if entry.code == "handle-given-outside"]
    assert [entry.message.partition(" ")[0] for entry in told] == expected
    assert [entry.reason for entry in found.unread] == ["outside"] * len(expected)


PYTHON = """
import logging
import outside
from outside.parts import Widget
from rclpy.node import Node
from std_msgs.msg import String
from . import own
class Demo(Node):
    def __init__(self, kind):
        super().__init__("demo")
        {call}
    def setup_a(self, name):
        pass
def main():
    node = Node("demo")
    {other}
    Demo("client")
"""
PYTHON_CALLS = {
    "a class outside": ('Widget(self, "status")', "", ["outside.parts.Widget"]),
    "a name that is put together": ('outside.add(node=self, name=f"x_{kind}")', "", ["outside.add"]),
    "a node that is no class": ("", 'outside.add(node, "status")', ["outside.add"]),
    "a function of the tree": ('own.add(self, "status")', "", []),
    "no node": ('Widget(kind, "status")', "", []),
    "no name": ("Widget(self)", "", []),
    "the library of Python": ('logging.info("%s", self)', "", []),
    "a method that declares, by its name in parts": ('getattr(self, "create_" + "client")(String, "x")', "", []),
    "a method that may declare": ('getattr(self, f"create_{kind}")(String, "x")', "", ["getattr"]),
    "code in a text": ("exec(\"self.create_client(String, 'x')\")", "", ["exec"]),
    "code that is put together": ("exec(kind)", "", ["exec"]),
    "code that declares nothing": ("exec('count = 1')", "", []),
    "a method that does not": ('getattr(self, f"setup_{kind}")("x")', "", []),
}


CODES = {"handle-given-outside", "method-by-computed-name", "code-from-text"}


@pytest.mark.parametrize(("call", "other", "expected"), PYTHON_CALLS.values(), ids=PYTHON_CALLS)
def test_what_nobody_sees_of_python_is_told(workspace: Any, call: str, other: str, expected: list[str]) -> None:
    """Who hands a node of Python outside with a name, or asks it for a method by a made-up name, leaves a gap."""
    text = PYTHON.format(call=call or "pass", other=other or "pass")
    workspace.package({"pkg/__init__.py": "", "pkg/own.py": "def add(node, name):\n    pass\n", "pkg/demo.py": text})
    found = extract(open_tree(workspace.root), Options(jobs=1))
    told = [entry for entry in found.diagnostics if entry.code in CODES]
    assert [entry.message.partition(" ")[0] for entry in told] == expected
