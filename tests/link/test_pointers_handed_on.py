"""Pointers of C++ that a function hands on to another one, which gives what they lead to something else."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <ros/ros.h>
#include <std_msgs/String.h>
std::string measured();
void outside(std::string * text);
{inner}
void read(std::string * text) {{ {call} }}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  std::string name = "own";
  read(&name);
  ros::Publisher pub = nh.advertise<std_msgs::String>(name, 1);
  ros::spin();
}}
"""
GIVES = "void fill(std::string * text) { *text = %s; }"
ROWS = [
    ("a text", GIVES % '"set"', "fill(text);", {"/set"}),
    ("what is not known", GIVES % "measured()", "fill(text);", {"/{}"}),
    (
        "a test of what it says",
        "bool fill(std::string * text) { *text = measured(); return true; }",
        "if (!fill(text)) { return; }",
        {"/{}"},
    ),
    ("a template", "template <typename T> void fill(T * to) { *to = measured(); }", "fill(text);", {"/{}"}),
    ("a chain", GIVES % "measured()" + " void more(std::string * text) { fill(text); }", "more(text);", {"/{}"}),
    ("a circle", "void fill(std::string * text) { fill(text); *text = measured(); }", "fill(text);", {"/{}"}),
    ("another place", "void fill(std::string * text) { text = text + 1; }", "fill(text);", {"/own"}),
    ("reading", "bool fill(std::string * text) { return text->empty(); }", "fill(text);", {"/own"}),
    ("a constant", "bool fill(const std::string * text) { return text->empty(); }", "fill(text);", {"/own"}),
]


def _names(workspace: Any, text: str) -> set[str]:
    found = workspace.package({"src/n.cpp": text}, ros=1).interfaces()
    names = [each.name for each in found if each.role == "publisher"]
    return {f"{name.partition('{')[0]}{{}}" if "{" in name else name for name in names}


@pytest.mark.parametrize(("inner", "call", "told"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_a_pointer_leads_to_is_what_the_last_function_gives_it(
    workspace: Any, inner: str, call: str, told: set[str]
) -> None:
    """A function that only moves its own pointer changes nothing."""
    assert _names(workspace, SOURCE.format(inner=inner, call=call)) == told


OVERLOADS = """
template <typename T> bool fill(const std::string & from, T *) { return false; }
inline bool fill(const std::string & from, bool * to) { *to = true; return true; }
inline bool fill(const std::string & from, std::string * to) { *to = from; return true; }
template <typename T> void load(T * to) { fill(measured(), to); }
"""


@pytest.mark.parametrize("call", ["load(text);", "fill(measured(), text);"])
def test_of_overloads_that_fit_alike_any_may_be_meant(workspace: Any, call: str) -> None:
    """One that leaves alone what it gets does not say that the others do."""
    assert "/{}" in _names(workspace, SOURCE.format(inner=OVERLOADS, call=call))
