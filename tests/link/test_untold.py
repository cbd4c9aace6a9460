"""What nothing in a tree tells is not sought: the conditions that ask for it, and their neighbours that are told."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_parsers.source.expr import Expr, Op
from ecm_parsers.source.flow import Branch, steps

from ecm_extract.infer.interpreter import Interpreter
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.link.running.assumed import Assumed
from ecm_extract.link.running.env import Env
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

CPP = """
#include <rclcpp/rclcpp.hpp>
class Part {{
 public:
  explicit Part(const std::string & name) : name_(name) {{}}
  const std::string & name() const {{ return name_; }}
  std::string name_;
}};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"), part_("fixed") {{ {made} }}
  {methods}
  void on(const sensor_msgs::msg::Image & message) {{ {body} if ({test}) {{ use(); }} }}
  std::map<std::string, int> found_;
  std::string text_;
  bool flag_;
  Part part_;
}};
int main() {{ Demo demo; {calls} }}
"""
PYTHON = """
import json
from rclpy.node import Node
from lib import device
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.rows = []
        {made}
    {methods}
    def on(self, message):
        {body}
        if {test}:
            use()
"""
BOTH = "bool is_there(const sensor_msgs::msg::Image & m) { if (m.width > 3) { return true; } return false; }"

CPP_ROWS = [
    ("a field of a message", {"test": "message.width > 3"}, True),
    ("a literal", {"body": "int n = 3;", "test": "n > 2"}, False),
    ("a field that the function gives", {"body": "auto m = message; m.width = 4;", "test": "m.width > 3"}, False),
    ("a function that returns both", {"methods": BOTH, "test": "is_there(message)"}, True),
    ("one that returns one", {"methods": "bool is_on() { return true; }", "test": "is_on()"}, False),
    (
        "one whose test is told",
        {
            "methods": "bool is_on() { if (flag_) { return true; } return false; }",
            "made": "flag_ = true;",
            "test": "is_on()",
        },
        False,
    ),
    (
        "one that tries",
        {"methods": "bool t() { try { lib::call(); return true; } catch (...) { } return false; }", "test": "!t()"},
        True,
    ),
    (
        "an untold key of a table",
        {"made": "found_[lib::name(this)] = 1;", "test": "found_.find(message.data) == found_.end()"},
        True,
    ),
    ("whether a table that is filled is empty", {"body": "found_[message.data] = 1;", "test": "found_.empty()"}, False),
    ("an element of it", {"body": "found_[message.data] = 1;", "test": "found_.at(key()) == 1"}, True),
    ("a member that is given what is untold", {"body": "text_ = message.data;", "test": "text_ == key()"}, True),
    (
        "one that is told elsewhere",
        {"body": "text_ = message.data;", "made": 'text_ = "a";', "test": 'text_ == "a"'},
        False,
    ),
    ("what an object was made with", {"test": 'part_.name() == "fixed"'}, False),
    ("a parameter", {"body": 'auto on = get_parameter("on").as_bool();', "test": "on"}, False),
    ("one that is read into a variable", {"body": 'bool on; get_parameter("on", on);', "test": "on"}, False),
    ("a field of a library's object", {"methods": "void f(const lib::Set & s) { if (s.limit == 3) { use(); } }"}, True),
    (
        "one that is called like a parameter",
        {
            "made": 'declare_parameter("limit", 3);',
            "methods": "void f(const lib::Set & s) { if (s.limit == 3) { use(); } }",
        },
        False,
    ),
    ("what is first", {"test": "message.width > 3 && true"}, True),
    ("what is behind something told", {"test": "false && message.width > 3"}, False),
    (
        "an argument that all calls leave open",
        {"methods": "bool is(int n) { return n > 3; }", "test": "is(message.width)"},
        True,
    ),
    (
        "an argument that one call tells",
        {"methods": "bool is(int n) { return n > 3; }", "calls": "demo.is(4);", "test": "is(message.width)"},
        False,
    ),
    ("an argument with a default", {"methods": "bool is(int n = 4) { return n > 3; }", "test": "is()"}, False),
    (
        "functions that call each other",
        {"methods": "bool a(int n) { return n ? b(n) : a(n); } bool b(int n) { return a(n); }", "test": "a(1)"},
        True,
    ),
]
PYTHON_ROWS = [
    ("a field of a message", {"test": "message.width > 3"}, True),
    ("what a library makes of it", {"test": "json.loads(message.data)"}, True),
    ("what a library gives", {"test": "device()"}, False),
    ("an element of an untold list", {"body": "rows = message.rows", "test": "rows[0] == 1"}, True),
    ("whether a list that is filled holds", {"body": "self.rows.append(message.data)", "test": "self.rows"}, False),
    ("what is in it", {"body": "self.rows.append(message.data)", "test": "self.rows[0] == 'a'"}, True),
    ("a list with something told in it", {"body": "self.rows.append('a')", "test": "self.rows[0] == 'a'"}, False),
    ("a round of a loop", {"body": "for row in message.rows: pass", "test": "row == 1"}, True),
    ("a round over something told", {"body": "for row in [1, 2]: pass", "test": "row == 1"}, False),
    ("parts of a pair", {"body": "left, right = message.pair", "test": "right"}, True),
    ("a text that grows", {"body": "n = 1\n        n += message.width", "test": "n > 1"}, False),
]


def _linker(workspace: Any, path: str, source: str) -> Linker:
    workspace.package({path: source}, name="pkg")
    linker = Linker(Reader(open_tree(workspace.root), False, (), None).read(1, None), form_table(()))
    linker.declare()
    return linker


def _function(linker: Linker, name: str) -> Func:
    return next(func for func in linker.program.functions[name] if func.fact.body)


def _is_untold(linker: Linker) -> bool:
    func = _function(linker, "f" if "f" in linker.program.functions else "on")
    return linker.folder.untold.has(_tests(func)[-1], func, len(func.fact.body) - 1)


def _tests(func: Func) -> list[Expr]:
    return [step.test for step in steps(func.fact.flow) if isinstance(step, Branch)]


def _filled(template: str, row: dict[str, str], nothing: str) -> str:
    empty = dict.fromkeys(("made", "methods", "body", "calls"), "") | {"test": "true"}
    return template.format(**{**empty, "body": nothing, "made": nothing, **row})


@pytest.mark.parametrize(("row", "expected"), [each[1:] for each in CPP_ROWS], ids=[each[0] for each in CPP_ROWS])
def test_conditions_of_cpp(workspace: Any, row: dict[str, str], expected: bool) -> None:
    """A condition is untold where all that it depends on comes from outside of the tree."""
    assert _is_untold(_linker(workspace, "src/n.cpp", _filled(CPP, row, ""))) is expected


@pytest.mark.parametrize(("row", "expected"), [each[1:] for each in PYTHON_ROWS], ids=[each[0] for each in PYTHON_ROWS])
def test_conditions_of_python(workspace: Any, row: dict[str, str], expected: bool) -> None:
    """So it is in Python."""
    assert _is_untold(_linker(workspace, "pkg/n.py", _filled(PYTHON, row, "pass"))) is expected


def test_what_is_untold_is_not_sought(workspace: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """No function is run to decide a condition that nothing decides; one that is told is decided as before."""
    methods = f"{BOTH} bool is_on() {{ return true; }}"
    linker = _linker(
        workspace, "src/n.cpp", _filled(CPP, {"methods": methods, "test": "is_there(message) || is_on()"}, "")
    )
    func = _function(linker, "on")
    both = _tests(func)[-1]
    assert isinstance(both, Op)
    run: list[str] = []
    result = Interpreter.result
    monkeypatch.setattr(Interpreter, "result", lambda self: run.append(self.frame.env.func.fact.name) or result(self))
    place = Env(func, 0, this=func.cls)
    assert linker.folder.flow.truth(both.operands[0], place) is None
    assert run == []
    assert linker.folder.flow.truth(both.operands[1], place) is True
    assert "is_on" in run


@pytest.mark.parametrize(
    ("needs", "refuted", "expected"),
    [
        ({"a": "b", "b": "a"}, "", {"a", "b"}),
        ({"a": "b", "b": "c", "c": "a"}, "c", set()),
        ({"a": "bc", "b": "a", "c": "", "d": "a"}, "c", set()),
        ({"a": "b", "b": "a", "c": "ad", "d": ""}, "d", {"a", "b"}),
    ],
)
@pytest.mark.parametrize("order", ["abcd", "dcba", "badc"])
def test_questions_that_depend_on_each_other(
    needs: dict[str, str], refuted: str, expected: set[str], order: str
) -> None:
    """What is asked in a circle holds unless something refutes it, in whatever order it is asked."""
    assumed = Assumed[str](lambda asked: asked != refuted and all(assumed.of(each) for each in needs[asked]))
    found = {asked for asked in order if asked in needs and assumed.of(asked)}
    assert found == expected | {each for each in needs if not needs[each] and each != refuted}


def test_what_was_assumed_before_a_fault_is_not_kept() -> None:
    """A question that cannot be answered leaves no other one answered by what was only assumed."""
    faulty = {"b"}

    def holds(asked: str) -> bool:
        if asked in faulty:
            raise ValueError(asked)
        return asked == "c" or assumed.of({"a": "b", "b": "d", "d": "c"}[asked])

    assumed = Assumed[str](holds)
    with pytest.raises(ValueError, match="b"):
        assumed.of("a")
    assert assumed.of("c")
    faulty.clear()
    assert assumed.of("a")

    refuted = Assumed[str](lambda asked: asked != "b" and (asked != "a" or refuted.of("b")))
    assert not refuted.of("a")
    assert refuted.of("c")
