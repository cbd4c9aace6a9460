"""What a function does with what it gets: texts of Python stay what they are, references of C++ write through."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import os
import sys
from rclpy.node import Node
from std_msgs.msg import String
first = "first"
def renamed(given):
    given = given + "_x"
    return given
def grown(given):
    given += "_x"
    return given
def replaced(given):
    given.append("lost")
    given = ["other"]
    return given
def same(given):
    return given
def kept(given, into):
    into.append(given)
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.own = "own"
        self.names = ["i", "j"]
    def start(self):
{body}
"""
PYTHON_ROWS = [
    ("a parameter that is bound anew", "t = 'a' + self.own\nrenamed(t)\npub(t)", {"/aown": "folded"}),
    ("a parameter that grows", "t = 'a' + self.own\ngrown(t)\npub(t)", {"/aown": "folded"}),
    ("a member that a function gets", "renamed(self.own)\npub(self.own)", {"/own": "folded"}),
    ("a variable of the module", "pub(same(first))", {"/first": "folded"}),
    ("elements of a list that is bound anew", "t = ['a']\nreplaced(t)\npub('_'.join(t))", {"/{join}": "pattern"}),
    ("a list that comes back", "t = ['a']\nu = same(t)\nu.append('b')\npub('_'.join(t))", {"/{join}": "pattern"}),
    ("a list in a list", "t = ['a']\nu = []\nkept(t, u)\nu[0].append('b')\npub('_'.join(t))", {"/{join}": "pattern"}),
    ("a text in a list that changes", "t = 'a'.upper()\nu = [t]\nu.append('b')\nu[0] = 'c'\npub(t)", {"/A": "folded"}),
    ("a text that a lambda hands on", "t = 'a'.upper()\nf = lambda x: x + same(t)\npub(f(t))", {"/AA": "folded"}),
    (
        "a text that is bound anew behind a lambda",
        "t = 'a'\nf = lambda x: x + same(t)\nt = 'b'\npub(f(t))",
        {"/bb": "folded"},
    ),
    ("a key of a table", "t = {'a': 'x'}\npub(t.get('a', 'none'))", {"/x": "folded"}),
    ("no key of a table", "t = {'a': 'x'}\npub(t.get('b', self.own))", {"/own": "folded"}),
    ("a path from the root", "pub(os.path.join('a', '/b'))", {"/b": "folded"}),
    ("a path below a path from the root", "pub(os.path.join('a', '/b', 'c'))", {"/b/c": "folded"}),
    (
        "a call that is made on one side only",
        "t = ['a', 'b']\nt.pop(0) if len(t) > self.more else None\npub('_'.join(t))",
        {"/{join}": "pattern"},
    ),
    ("a path below nothing", "pub(os.path.join('', 'b'))", {"/b": "folded"}),
    ("a path below a folder", "pub(os.path.join('a/', 'b'))", {"/a/b": "folded"}),
    (
        "the order of a table",
        "t = {'a': 'x'}\nt.setdefault('c', 'z')\nt.setdefault('a', 'y')\npub('_'.join(t.values()))",
        {"/x_z": "folded"},
    ),
    (
        "a part of one of two texts",
        "pub(('a/b' if len(sys.argv) > 1 else 'c').split('/')[-1])",
        {"/b": "one_of", "/c": "one_of"},
    ),
    (
        "rounds after a return",
        "if len(sys.argv) > 1:\n    return\nfor n in self.names: pub(n)",
        {"/i": "folded", "/j": "folded"},
    ),
    (
        "rounds that may return",
        "for n in self.names:\n    pub(n)\n    if len(sys.argv) > 1:\n        return",
        {"/i": "one_of", "/j": "one_of"},
    ),
    (
        "one name in all rounds",
        "for n in self.names:\n    if len(sys.argv) > 1:\n        pub('a')",
        {"/a": "literal"},
    ),
]

CPP = """
#include <string>
static std::string other = "other";
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"), own_("own") {{ names_.push_back("i"); start(); }}
  void start() {{
    {body}
  }}
 private:
  std::string own_;
  std::vector<std::string> names_;
}};
"""
MORE = "[=, this](const std::string & more) mutable"
WRITE = "[&](const std::string & more)"
CPP_ROWS = [
    ("a reference", 'std::string t = "a"; std::string & r = t; pub(t, 10);', {"/a": "folded"}),
    ("written through", 'std::string t = "a"; auto & r = t; r = "b"; pub(t, 10);', {"/b": "folded"}),
    ("written behind it", 'std::string t = "a"; auto & r = t; t.append("b"); pub(r, 10);', {"/ab": "folded"}),
    ("of a reference", 'std::string t = "a"; auto & r = t; auto & s = r; s += "b"; pub(t, 10);', {"/ab": "folded"}),
    (
        "a name that two blocks have",
        'std::string t = "a"; { auto & r = t; r = "b"; } { std::string r = "c"; r = "d"; } pub(t, 10);',
        {"/{t}": "pattern"},
    ),
    (
        "declared in rounds that nobody counts",
        'std::string t = "a"; for (int i = 0; i < more; ++i) { pub(t, 10); auto & r = t; r += "b"; }',
        {"/a": "one_of", "/{t}b": "pattern"},
    ),
    (
        "a member in a lambda",
        f'own_ = "new"; auto f = {MORE} {{ return more + own_; }}; pub(f("a"), 10);',
        {"/anew": "folded"},
    ),
    (
        "a member that changes behind a lambda",
        f'auto f = {MORE} {{ return more + own_; }}; own_ = "new"; pub(f("a"), 10);',
        {"/anew": "folded"},
    ),
    (
        "a pointer to a reference",
        'std::string t = "a"; { auto & r = t; std::string * p = &r; *p += "b"; } pub(t, 10);',
        {"/{t}": "pattern"},
    ),
    (
        "another reference beside a pointer",
        'std::string t = "a"; auto & s = t; auto & r = t; std::string * p = &r; *p += "b"; pub(s, 10);',
        {"/{s}": "pattern"},
    ),
    (
        "a lambda that changes what it gets, by a reference",
        f'std::string t = "a"; auto & r = t; auto f = {WRITE} {{ r += more; return more; }}; pub(f(t), 10);',
        {"/{t}": "pattern"},
    ),
    ("a list", "pub(names_.back(), 10);", {"/i": "folded"}),
    ("a list in a lambda", f'auto f = {MORE} {{ return more + names_.back(); }}; pub(f("a"), 10);', {"/ai": "folded"}),
    (
        "a variable of the file in a lambda",
        f'other = "new"; auto f = {MORE} {{ return more + other; }}; pub(f("a"), 10);',
        {"/anew": "folded"},
    ),
]


def _names(workspace: Any) -> dict[str, str]:
    return {entry.name: entry.confidence for entry in workspace.interfaces() if entry.role == "publisher"}


@pytest.mark.parametrize(("row", "body", "expected"), PYTHON_ROWS, ids=[row[0] for row in PYTHON_ROWS])
def test_texts_of_python_stay_what_they_are(workspace: Any, row: str, body: str, expected: dict[str, str]) -> None:
    """Who gets a text cannot change it; who gets a list may."""
    lines = body.replace("pub(", "self.create_publisher(String, topic=").split("\n")
    source = PYTHON.format(body="\n".join(f"        {line}" for line in lines))
    start = "def main():\n    Demo().start()\n"
    assert _names(workspace.package({"pkg/demo.py": source + start})) == expected, row


@pytest.mark.parametrize(("row", "body", "expected"), CPP_ROWS, ids=[row[0] for row in CPP_ROWS])
def test_references_and_lambdas_of_cpp(workspace: Any, row: str, body: str, expected: dict[str, str]) -> None:
    """A reference is what it refers to; what a lambda reads of the object is what that holds when it is called."""
    source = CPP.format(body=body.replace("pub(", "create_publisher<std_msgs::msg::String>("))
    assert _names(workspace.package({"src/demo.cpp": source})) == expected, row


BETWEEN = """
from rclpy.node import Node
from std_msgs.msg import String
second = "a"
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
    def shown(self):
        self.create_publisher(String, second, 10)
    def start(self):
        global second
        second = "b"
        self.shown()
        second = "c"
def main():
    Demo().start()
"""


def test_a_variable_of_the_module_is_seen_between_two_values(workspace: Any) -> None:
    """What a function gives it before it calls another counts as what it leaves it with."""
    found = _names(workspace.package({"pkg/demo.py": BETWEEN}))
    assert found == {"/a": "one_of", "/b": "one_of", "/c": "one_of"}
