"""Loops over tables of C++, by references too, in the function at hand and over what an object hands out."""

from __future__ import annotations

from typing import Any

import pytest

PROGRAM = """
#include <rclcpp/rclcpp.hpp>
using Value = std::variant<int, bool>;
using Limits = std::unordered_map<std::string, Value>;
class Part {{
 public:
  explicit Part(Limits limits) : limits_(std::move(limits)) {{}}
  virtual ~Part() = default;
  Limits & all() {{ return limits_; }}

 private:
  Limits limits_;
}};
class Arm : public Part {{ public: Arm() : Part({{{{"reach", 1}}, {{"stiff", true}}}}) {{}} }};
class Leg : public Part {{ public: Leg() : Part({{{{"reach", 2}}, {{"stiff", false}}}}) {{}} }};
void set_all(int & to) {{ to = 3; }}
{helper}
int main() {{
  auto node = std::make_shared<rclcpp::Node>("n");
  {body}
}}
"""
HELPER = """
void tell(rclcpp::Node * node, Part * part, const std::string & prefix) {
  for (auto & [name, value] : part->all()) {
    const auto & whole = prefix.empty() ? name : prefix + "." + name;
    node->declare_parameter(whole, value);
  }
}
"""
TOLD = "{ node->declare_parameter(name, value); }"
EACH = f"for (auto & [name, value] : limits) {TOLD}"
OF_ARM = f"auto arm = std::make_unique<Arm>(); BEFORE for (auto & [name, value] : arm->all()) {TOLD}"
TWO = (
    'auto arm = std::make_unique<Arm>(); tell(node.get(), arm.get(), "arm");'
    'auto leg = std::make_unique<Leg>(); tell(node.get(), leg.get(), "leg");'
)
BOTH = {("reach", "integer", 1), ("stiff", "bool", True)}
BELOW = {(f"arm.{name}", kind, value) for name, kind, value in BOTH}


def _told(workspace: Any, body: str) -> list[Any]:
    workspace.package({"src/n.cpp": PROGRAM.format(body=body, helper=HELPER if "tell(" in body else "")})
    return [each for each in workspace.interfaces() if each.role == "parameter"]


@pytest.mark.parametrize(
    ("body", "rows"),
    [
        (f'std::map<std::string, Value> limits{{{{"reach", 1}}, {{"stiff", true}}}}; {EACH}', BOTH),
        (f'Limits limits{{{{"reach", 1}}, {{"stiff", true}}}}; {EACH}', BOTH),
        (f'Limits limits = {{{{"reach", 1}}, {{"stiff", true}}}}; {EACH}', BOTH),
        (f'Limits limits; limits["reach"] = 1; limits.emplace("stiff", true); {EACH}', BOTH),
        (f'Limits limits; limits["stiff"] = 5; limits["reach"] = 1; limits["stiff"] = true; {EACH}', BOTH),
        (OF_ARM.replace("BEFORE", ""), BOTH),
        ('std::unique_ptr<Part> arm = std::make_unique<Arm>(); tell(node.get(), arm.get(), "arm");', BELOW),
        ('Part * arm = new Arm(); tell(node.get(), arm, "arm");', BELOW),
        (TWO, {*BELOW, ("leg.reach", "integer", 2), ("leg.stiff", "bool", False)}),
    ],
)  # fmt: skip
def test_each_entry_is_told(workspace: Any, body: str, rows: set[tuple[str, str, Any]]) -> None:
    """A reference to a key or a value changes nothing where nobody writes to it."""
    found = _told(workspace, body)
    assert {(each.name, each.type, each.default) for each in found} == rows
    assert {each.confidence for each in found} == {"folded"}


@pytest.mark.parametrize(
    "before",
    [
        'arm->all()["more"] = 3;',
        'auto & all = arm->all(); all["more"] = 3;',
        "arm->all().clear();",
        "for (auto & [name, value] : arm->all()) { value = 7; }",
        "for (auto & [name, value] : arm->all()) { set_all(value); }",
        "for (auto & each : arm->all()) { each.second = 7; }",
        "fill(arm->all());",
    ],
)
def test_what_somebody_changes_by_a_reference_to_it_is_not_told_as_it_was_made(workspace: Any, before: str) -> None:
    """`all()` gives a reference: two limits were told as proved where there are three, or none."""
    assert {each.confidence for each in _told(workspace, OF_ARM.replace("BEFORE", before))} == {"pattern"}


def test_a_pointer_that_may_point_to_one_of_two_objects_tells_none(workspace: Any) -> None:
    body = "std::unique_ptr<Part> part; if (is_arm()) { part = std::make_unique<Arm>(); } else "
    found = _told(workspace, body + '{ part = std::make_unique<Leg>(); } tell(node.get(), part.get(), "");')
    assert {each.confidence for each in found} == {"pattern"}


NAMES = """
#include <rclcpp/rclcpp.hpp>
class Lister {
 public:
  explicit Lister(std::vector<std::string> names) : names_(names) {}
  void declare(rclcpp::Node * node) { for (const auto & name : names_) { node->declare_parameter(name, 1); } }

 private:
  std::vector<std::string> names_;
};
class Two : public Lister { public: Two() : Lister({"one", "two"}) {} };
int main() { auto node = std::make_shared<rclcpp::Node>("n"); Two two; two.declare(node.get()); }
"""


def test_a_list_that_a_derived_class_hands_its_base(workspace: Any) -> None:
    workspace.package({"src/n.cpp": NAMES})
    found = [each for each in workspace.interfaces() if each.role == "parameter"]
    assert {(each.name, each.confidence) for each in found} == {("one", "folded"), ("two", "folded")}
