"""Methods of objects that a function is given: what they tell is what the makers of these objects said."""

from __future__ import annotations

from typing import Any

import pytest

DEMO = """
#include <rclcpp/rclcpp.hpp>
class Base {{
 public:
  explicit Base(const std::string & name) : name_(name) {{}}
  std::string name() const {{ return name_; }}
 {access}:
  std::string name_;
}};
template <typename T>
class Part : public Base {{
 public:
  Part(const std::string & name, T value) : Base(name) {{}}
  {more}
}};
void other(std::shared_ptr<Part<int>> & part) {{ part = std::make_shared<Part<int>>("z", 1); }}
class Keeper {{
 public:
  explicit Keeper(rclcpp::Node * node, const std::string & name) : node_(node) {{}}
  template <typename T>
  void keep(const std::string & name, T value) {{
    auto part = std::make_shared<Part<T>>(name, value);
    {before}
    keep(part);
    {after}
  }}
 private:
  void keep(std::shared_ptr<Base> part) {{
    {inside}
    node_->declare_parameter(part->name(), 1);
  }}
  rclcpp::Node * node_;
}};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"), keeper_(this, "wrong") {{ keeper_.keep<int>("a", 1); keeper_.keep<bool>("b", true); }}
  Keeper keeper_;
}};
"""
PLAIN = {"access": "protected", "more": "", "before": "", "after": "", "inside": ""}
TOLD = [{}, {"access": "private"}, {"after": "part = nullptr;"}]
UNTOLD = [
    {"before": "outside(part);"},
    {"before": "other(part);"},
    {"before": "if (node_) { part = outside(); }"},
    {"inside": "if (node_) { part = outside(); }"},
    {"access": "public"},
    {"more": 'std::string name() const override { return "x" + name_; }'},
    {"more": "void rename(const std::string & to) { name_ = to; }"},
]


def _declared(workspace: Any, changed: dict[str, str]) -> list[Any]:
    found = workspace.package({"src/demo.cpp": DEMO.format(**PLAIN | changed)}).interfaces()
    return [entry for entry in found if entry.role == "parameter"]


@pytest.mark.parametrize("changed", TOLD, ids=str)
def test_each_caller_of_a_function_that_is_given_objects_has_names_of_its_own(
    workspace: Any, changed: dict[str, str]
) -> None:
    """They are not those of the object whose method runs, though its constructor calls something by the same name."""
    told = {(entry.name, entry.confidence) for entry in _declared(workspace, changed)}
    assert told == {("a", "folded"), ("b", "folded")}


@pytest.mark.parametrize("changed", UNTOLD, ids=str)
def test_what_may_be_another_object_or_another_name_by_then_is_not_proved(
    workspace: Any, changed: dict[str, str]
) -> None:
    """The variable was handed on or may hold another object, the member is open to all, or a method changes it."""
    found = _declared(workspace, changed)
    assert found
    assert {entry.confidence for entry in found} <= {"pattern", "one_of"}


def test_a_method_that_another_one_overrides_tells_nothing(workspace: Any) -> None:
    """Which of them runs depends on the object: the one of the base would be a name that no run makes."""
    found = _declared(workspace, {"more": 'std::string name() const override { return "x" + name_; }'})
    assert not {"a", "b"} & {entry.name for entry in found}
