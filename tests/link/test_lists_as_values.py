"""Lists that are wrapped as the value of a parameter before a helper declares it."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
template <typename NodeT>
void once(NodeT node, const std::string & name, const rclcpp::ParameterValue & value) {{
  if (!node->has_parameter(name)) node->declare_parameter(name, value);
}}
class Demo : public rclcpp::Node {{
  Demo() : Node("demo") {{ {body} }}
}};
"""
VALUE = 'once(this, "names", rclcpp::ParameterValue({given}));'
ROWS = [
    ("an empty one", VALUE.format(given="std::vector<std::string>{}"), []),
    ("one in braces", VALUE.format(given='std::vector<std::string>{"a", "b"}'), ["a", "b"]),
    ("a variable", "std::vector<std::string> held; " + VALUE.format(given="held"), []),
    ("what is moved", 'std::vector<std::string> held{"a"}; ' + VALUE.format(given="std::move(held)"), ["a"]),
    ("what is filled", "std::vector<std::string> held; fill(held); " + VALUE.format(given="held"), None),
    ("what a parameter gave", 'auto held = get_parameter("x").as_string_array(); ' + VALUE.format(given="held"), None),
]


@pytest.mark.parametrize(("body", "default"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_list_in_a_value_is_its_default(workspace: Any, body: str, default: list[str] | None) -> None:
    """Of lists that are wrapped nothing was told."""
    entry = workspace.package({"src/demo.cpp": NODE.format(body=body)}).only("parameter")
    assert (entry.name, entry.default) == ("names", default)
