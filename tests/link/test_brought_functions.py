"""Functions that declare are known by whatever name a file calls them."""

from __future__ import annotations

from typing import Any

import pytest

DECLARED = """
#include <rclcpp/rclcpp.hpp>
{above}
namespace own {{
class Plugin : public nav2_core::Controller {{
 public:
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr & parent, std::string name) override {{
    auto node = parent.lock();
    {within}{called}(node, "speed", rclcpp::ParameterValue(0.5));
  }}
  {beside}
}};
}}
"""
SHORT = "declare_parameter_if_not_declared"
WAYS = [
    ("using nav2_util::declare_parameter_if_not_declared;", "", SHORT),
    ("", "using nav2_util::declare_parameter_if_not_declared; ", SHORT),
    ("namespace nu = nav2_util;", "", "nu::declare_parameter_if_not_declared"),
]


@pytest.mark.parametrize(("above", "within", "called"), WAYS)
def test_a_function_is_known_by_what_using_brings(workspace: Any, above: str, within: str, called: str) -> None:
    """A `using` of a function, in the file or in the function, and an alias of its namespace name it too."""
    text = DECLARED.format(above=above, within=within, called=called, beside="")
    entry = workspace.package({"src/a.cpp": text}).only("parameter")
    assert (entry.name, entry.type, entry.default) == ("speed", "double", 0.5)


def test_a_method_hides_what_using_brings(workspace: Any) -> None:
    """A class that has a method of the name calls that one, whatever its file brings."""
    beside = f"template<class N, class V> void {SHORT}(N node, const std::string & name, V value);"
    text = DECLARED.format(above=WAYS[0][0], within="", called=SHORT, beside=beside)
    assert workspace.package({"src/a.cpp": text}).interfaces() == []
