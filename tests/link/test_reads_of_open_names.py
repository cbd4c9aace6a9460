"""A parameter whose name is open and that a helper first asks for and then declares is one parameter."""

from __future__ import annotations

from typing import Any

HELPER = """
#include <rclcpp/rclcpp.hpp>
template <typename T, typename N>
T read(N node, const std::string & name, const T & value) {
  if (node->has_parameter(name)) { return node->get_parameter(name).template get_value<T>(); }
  return node->template declare_parameter<T>(name, value);
}
class Part : public rclcpp::Node {
public:
  explicit Part(const std::string & name)
  : Node("part", rclcpp::NodeOptions().allow_undeclared_parameters(true)) {
    rate_ = read<double>(this, name + ".rate", 2.0);
    size_ = read<int>(this, name + ".size", 3);
  }
  double rate_;
  int size_;
};
int main(int argc, char ** argv) { rclcpp::spin(std::make_shared<Part>(argv[1])); }
"""


def test_what_is_asked_and_declared_at_one_place_is_told_once(workspace: Any) -> None:
    """Each was told twice: as it is declared, and without a type."""
    found = workspace.package({"src/part.cpp": HELPER}).interfaces()
    told = [(each.type, each.default) for each in found if each.role == "parameter" and "{" in each.name]
    assert sorted(told) == [("double", 2.0), ("integer", 3)]
