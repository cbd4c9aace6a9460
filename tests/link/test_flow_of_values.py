"""Values along the flow of a body: what a name is when the call runs (rows F1 to F18, R7, A1 and A2 of the forms)."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <string>
namespace demo {{
enum class Kind {{ FIRST, SECOND }};
struct Row {{ std::string name; int count; }};
inline std::string label(Kind kind) {{ switch (kind) {{ case Kind::FIRST: return "first"; default: return "other"; }} }}
inline std::string chosen(int number) {{ if (number == 1) {{ return "one"; }} else if (number == 2) {{ return "two"; }} return "many"; }}
inline std::string pick(bool yes) {{ return yes ? "yes" : "no"; }}
inline std::string spelled(int number) {{ return "number" + std::to_string(number); }}
inline std::string spelled(const std::string & text) {{ return "text" + text; }}
inline void fill(std::string & out) {{ out += "/filled"; }}
class Demo : public rclcpp::Node {{
 public:
  explicit Demo(bool flag) : Node("demo") {{
    table_["key"] = "from_table";
    {body}
  }}
  std::map<std::string, std::string> table_;
}};
}}
"""
PUB = "create_publisher<std_msgs::msg::String>"
CPP_ROWS = [
    ("F1", f'std::string t = "/ns/out"; t.append(std::to_string(3)); {PUB}(t, 10);', {"/ns/out3": "folded"}),
    ("F2 insert", f'std::string t = "out"; t.insert(0, "a/"); {PUB}(t, 10);', {"/a/out": "folded"}),
    ("F2 replace", f'std::string t = "out"; t.replace(0, 1, "sh"); {PUB}(t, 10);', {"/shut": "folded"}),
    ("F2 not modelled", f'std::string t = "out"; std::sort(t.begin(), t.end()); {PUB}(t, 10);', {"/{{t}}": "pattern"}),
    ("F2 by reference", f'std::string t = "a"; fill(t); {PUB}(t, 10);', {"/a/filled": "folded"}),
    (
        "F3",
        f'std::string t = "plain"; if (flag) {{ t = "one"; }} if (other()) {{ {PUB}(t, 10); }}',
        {"/plain": "one_of", "/one": "one_of"},
    ),
    ("F4", f'std::string t = "a"; if (flag) {{ t = "b"; return; }} {PUB}(t, 10);', {"/a": "folded"}),
    ("F5", f"{PUB}(pick(true), 10);", {"/yes": "folded"}),
    ("F6 switch", f"{PUB}(label(Kind::SECOND), 10);", {"/other": "folded"}),
    ("F6 chain", f"{PUB}(chosen(2), 10);", {"/two": "folded"}),
    (
        "F7",
        f'std::vector<Row> rows{{{{"a", 1}}, {{"b", 2}}}}; for (const auto & row : rows) {{ {PUB}(row.name, 10); }}',
        {"/a": "folded", "/b": "folded"},
    ),
    (
        "F8",
        f'for (auto kind : {{Kind::FIRST, Kind::SECOND}}) {{ if (kind == Kind::FIRST) {{ {PUB}("a", 10); }} else {{ {PUB}("b", 10); }} }}',
        {"/a": "literal", "/b": "literal"},
    ),
    ("F9", f'{PUB}(table_["key"], 10);', {"/from_table": "folded"}),
    (
        "F1 unknown rounds",
        f'int i = 0; std::string n; while (more()) {{ n = "arm" + std::to_string(i); i++; }} {PUB}(n, 10);',
        {"/arm{{i}}": "pattern", "/arm0": "one_of"},
    ),
    ("scope of a block", f'std::string t = "a"; {{ std::string t = "b"; }} {PUB}(t, 10);', {"/a": "folded"}),
    ("another name", f'std::string t = "a"; auto & r = t; r += "b"; {PUB}(t, 10);', {"/ab": "folded"}),
    ("overloads", f'{PUB}(spelled(std::string("x")), 10);', {"/textx": "folded"}),
    (
        "counted",
        f'for (int i = 0; i < 2; ++i) {{ {PUB}("arm" + std::to_string(i), 10); }}',
        {"/arm0": "folded", "/arm1": "folded"},
    ),
    ("widths", f'char n[9]; snprintf(n, sizeof(n), "arm%02d", 7); {PUB}(n, 10);', {"/arm07": "folded"}),
    (
        "F18",
        f'std::string t = "new";\n#ifdef OLD\nt = "old";\n#endif\n{PUB}(t, 10);',
        {"/new": "one_of", "/old": "one_of"},
    ),
]


def _names(workspace: Any) -> dict[str, str]:
    return {entry.name: entry.confidence for entry in workspace.interfaces() if entry.role == "publisher"}


@pytest.mark.parametrize(("row", "body", "expected"), CPP_ROWS, ids=[row[0] for row in CPP_ROWS])
def test_cpp_names_are_what_they_are_when_the_call_runs(
    workspace: Any, row: str, body: str, expected: dict[str, str]
) -> None:
    """A name is told as one only where exactly one is possible; what is not modelled is unknown, never stale."""
    names = _names(workspace.package({"src/demo.cpp": CPP.format(body=body)}))
    assert names == {name.replace("{{", "{").replace("}}", "}"): sure for name, sure in expected.items()}, row


PYTHON = """
import os
import sys
from rclpy.node import Node
from std_msgs.msg import String
FIRST, SECOND = 1, 2
def chosen(kind):
    if kind == FIRST:
        return "first"
    elif kind == SECOND:
        return "second"
    return "other"
def pick(yes):
    return "yes" if yes else "no"
def fill(names):
    names.append("filled")
class Demo(Node):
    def __init__(self, flag):
        super().__init__("demo")
        self.table = {{"key": "from_table"}}
{body}
"""
PYTHON_ROWS = [
    ("F2 list", 't = ["a"]; t.append("b"); pub("_".join(t))', {"/a_b": "folded"}),
    ("F2 dict", 't = {{}}; t["x"] = "y"; pub(t["x"])', {"/y": "folded"}),
    ("F2 text", 't = "Scan"; pub(t.lower().replace("s", "x"))', {"/xcan": "folded"}),
    ("F2 by call", 't = ["a"]; fill(t); pub(t[1])', {"/filled": "folded"}),
    ("F2 not modelled", "t = ['a']; shuffle(t); pub(t[0])", {"/{item}": "pattern"}),
    ("alias", 't = ["a"]; u = t; u.append("b"); pub(t[-1])', {"/b": "folded"}),
    ("F3", 't = "plain"\nif flag: t = "one"\npub(t)', {"/plain": "one_of", "/one": "one_of"}),
    ("F4", 't = "a"\nif flag:\n    t = "b"\n    return\npub(t)', {"/a": "folded"}),
    ("F5", "pub(pick(True))", {"/yes": "folded"}),
    ("F6", "pub(chosen(SECOND))", {"/second": "folded"}),
    ("F7 rows", 'for n, c in [("a", 1), ("b", 2)]: pub(n)', {"/a": "folded", "/b": "folded"}),
    ("F7 range", 'for i in range(2): pub(f"arm{i}")', {"/arm0": "folded", "/arm1": "folded"}),
    ("F7 zip", 'for a, b in zip(["x", "y"], ["1", "2"]): pub(a + b)', {"/x1": "folded", "/y2": "folded"}),
    ("F7 comprehension", 'for n in [x + "_d" for x in ["a", "b"]]: pub(n)', {"/a_d": "folded", "/b_d": "folded"}),
    ("F8", 'for k in (1, 2):\n    if k == 1: pub("a")\n    else: pub("b")', {"/a": "literal", "/b": "literal"}),
    ("F9", 'pub(self.table["key"])', {"/from_table": "folded"}),
    ("F16", "pub(hex(255))", {"/0xff": "folded"}),
    ("F17 join", 'pub(os.path.join("a", "b"))', {"/a/b": "folded"}),
    ("F17 width", 'pub(f"arm{7:02d}")', {"/arm07": "folded"}),
    ("swap", 'a, b = "x", "y"\na, b = b, a\npub(a)', {"/y": "folded"}),
    ("closure", 'sep = "/"\nf = lambda x: x + sep + "leaf"\npub(f("a"))', {"/a/leaf": "folded"}),
    ("numbers", "n = 1 + 2\npub('arm' + str(n * 2))", {"/arm6": "folded"}),
    ("broken off", 'for n in ["a", "b"]:\n    if flag: break\n    pub(n)', {"/a": "one_of", "/b": "one_of"}),
    ("handler", 't = "a"\ntry:\n    t = f(t)["x"]\nexcept KeyError:\n    t = "b"\npub(t)', None),
]


@pytest.mark.parametrize(("row", "body", "expected"), PYTHON_ROWS, ids=[row[0] for row in PYTHON_ROWS])
def test_python_names_are_what_they_are_when_the_call_runs(
    workspace: Any, row: str, body: str, expected: dict[str, str] | None
) -> None:
    """A name is told as one only where exactly one is possible; what is not modelled is unknown, never stale."""
    lines = body.replace("{{}}", "{}").replace("; ", "\n") if ":" not in body else body
    indented = "\n".join(
        f"        {line}" for line in lines.replace("pub(", "self.create_publisher(String, ").split("\n")
    )
    for_calls = indented.replace("self.create_publisher(String, ", "self.create_publisher(String, topic=")
    names = _names(workspace.package({"pkg/demo.py": PYTHON.format(body=for_calls.replace("{{}}", "{}"))}))
    if expected is None:
        assert "folded" not in names.values()
    else:
        assert names == expected, row


def test_locals_belong_to_their_function(workspace: Any) -> None:
    """R7: two functions of one file may call their variables the same."""
    text = """
class D : public rclcpp::Node { D() : Node("d") { first(); second(); }
  void first() { std::string topic_name = "one"; create_publisher<std_msgs::msg::String>(topic_name, 1); }
  void second() { std::string topic_name = "two"; create_publisher<std_msgs::msg::Bool>(topic_name, 1); } };"""
    workspace.package({"src/d.cpp": text})
    found = {entry.type: entry.name for entry in workspace.interfaces()}
    assert found == {"std_msgs/msg/String": "/one", "std_msgs/msg/Bool": "/two"}


def test_a_member_is_what_the_constructor_made_of_it(workspace: Any) -> None:
    """A list that the constructor fills is known element by element; what another method may add is not."""
    text = """
from rclpy.node import Node
from std_msgs.msg import String
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.names = ["a"]
        self.names.append("b")
    def start(self):
        for name in self.names:
            self.create_publisher(String, name, 1)
"""
    assert _names(workspace.package({"pkg/demo.py": text})) == {"/a": "folded", "/b": "folded"}


GIVEN_AWAY = [
    'std::vector<Outside> all{{"device", device, "x"}, {"other", 1}};',
    'std::vector<Outside> all = {{"device", device}};',
]


@pytest.mark.parametrize("body", GIVEN_AWAY)
@pytest.mark.parametrize("declared", ["std::string device;", "std::string device{};"])
def test_an_empty_text_that_braces_give_away_is_not_told_as_empty(workspace: Any, declared: str, body: str) -> None:
    """Who is made from a variable without a value may write it by reference, in braces within braces too."""
    source = f"""
#include <rclcpp/rclcpp.hpp>
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{
    {declared}
    {body}
    create_publisher<std_msgs::msg::String>("/" + device + "/image", 1);
  }}
}};
"""
    assert workspace.package({"src/demo.cpp": source}).only("publisher").name == "/{device}/image"
