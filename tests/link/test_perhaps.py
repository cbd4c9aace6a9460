"""Lists and tables to which branches that nobody decides add something: what every run has, some have, and none."""

from __future__ import annotations

from typing import Any

import pytest

SETTINGS = """
#include <rclcpp/rclcpp.hpp>
struct Device {{ bool gain(int & to); bool tilt(int & to); bool rate(double * to); }};
class Settings {{
 public:
  Settings(std::shared_ptr<rclcpp::Node> & node) {{
    node_ = node;
    list();
    whole();
    broken();
    declare();
  }}

 private:
  typedef bool (Device::*Broken)(double *);
  typedef std::map<std::string, Broken> AllBroken;
  void list() {{
    names_.push_back("gain");
    {listed}
    names_.push_back("rate");
  }}
  void whole() {{
    whole_["gain"] = &Device::gain;
    {stored}
  }}
  void broken() {{ broken_["rate"] = &Device::rate; }}
  void declare() {{
    int number = 0;
    double fraction = 0;
    for (const std::string & name : names_) {{
      if (whole_.{asked}) {{
        (device_.*(whole_[name]))(number);
        node_->declare_parameter(name, number);
      }} else if (broken_.find(name) != broken_.end()) {{
        (device_.*(broken_[name]))(&fraction);
        node_->declare_parameter(name, fraction);
      }}
    }}
  }}
  Device device_;
  std::shared_ptr<rclcpp::Node> node_;
  std::vector<std::string> names_;
  std::map<std::string, bool (Device::*)(int &)> whole_;
  AllBroken broken_;
}};
int main() {{ auto node = std::make_shared<rclcpp::Node>("n"); Settings all(node); rclcpp::spin(node); }}
"""
BUILT = "\n#ifdef HAS_TILT\n{}\n#endif\n"
FOUND = "find(name) != whole_.end()"


def _parameters(workspace: Any, text: str) -> list[Any]:
    return [each for each in workspace.package({"src/n.cpp": text}).interfaces() if each.role == "parameter"]


@pytest.mark.parametrize("asked", [FOUND, "count(name) > 0", "contains(name)"])
def test_what_builds_add_is_searched_for_in_what_others_add(workspace: Any, asked: str) -> None:
    """Which of the two declares a name is proved for those that each build has, and for those that none has."""
    listed, stored = BUILT.format('names_.push_back("tilt");'), BUILT.format('whole_["tilt"] = &Device::tilt;')
    found = _parameters(workspace, SETTINGS.format(listed=listed, stored=stored, asked=asked))
    assert {(each.name, each.type, each.confidence) for each in found} == {
        ("gain", "integer", "folded"),
        ("rate", "double", "folded"),
        ("tilt", "integer", "one_of"),
    }


def test_an_element_that_some_builds_have_is_declared_under_their_condition(workspace: Any) -> None:
    listed = BUILT.format('names_.push_back("tilt");')
    text = SETTINGS.format(listed=listed, stored='whole_["tilt"] = &Device::tilt;', asked=FOUND)
    found = {each.name: each for each in _parameters(workspace, text)}
    assert [(each.tests, each.name) for each in found["tilt"].when] == [("macro", "HAS_TILT")]
    assert not found["gain"].when
    assert not found["rate"].when


@pytest.mark.parametrize(
    "listed",
    ["if (more()) { read(names_); }", "if (more()) { names_ = read(); }", "if (more()) { names_.clear(); }"],
)
def test_a_list_that_a_branch_does_something_else_to_stays_open(workspace: Any, listed: str) -> None:
    found = _parameters(workspace, SETTINGS.format(listed=listed, stored="", asked=FOUND))
    assert found
    assert not any(each.confidence == "folded" for each in found)
