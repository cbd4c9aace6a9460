"""Bodies of templates stand in files of their own, which a header includes at its end."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.source_suffixes import INCLUDED

HEADER = """
template <class T> class Wrap {
 public:
  Wrap(rclcpp::Node * node, const std::string & name);
  void open();
  rclcpp::Node * node_;
  std::string name_;
};
#include "pkg/impl/wrap%s"
"""
BODIES = """
template <class T> Wrap<T>::Wrap(rclcpp::Node * node, const std::string & name) : node_(node), name_(name) {}
template <class T> void Wrap<T>::open() { node_->create_publisher<T>(name_ + "/x", 10); }
"""
NODE = """
#include "pkg/wrap.hpp"
class Demo : public rclcpp::Node {
 public:
  Demo() : Node("demo") { Wrap<std_msgs::msg::String> wrap(this, "w"); wrap.open(); }
};
int main() { Demo demo; }
"""


@pytest.mark.parametrize("suffix", sorted(INCLUDED))
def test_bodies_of_templates_are_read(workspace: Any, suffix: str) -> None:
    """Whatever of the known suffixes such a file has."""
    workspace.package(
        {
            "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
            "include/pkg/wrap.hpp": HEADER % suffix,
            f"include/pkg/impl/wrap{suffix}": BODIES,
            "src/demo.cpp": NODE,
        },
        ros=2,
    )
    told = [entry for module in workspace.modules().values() for entry in module.signature.interfaces]
    assert [(entry.name, entry.type) for entry in told if entry.role == "publisher"] == [
        ("/w/x", "std_msgs/msg/String")
    ]
