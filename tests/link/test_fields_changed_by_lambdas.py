"""What a method makes of the fields of its members by lambdas that it calls is not told as it was before."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
#include <rclcpp/rclcpp.hpp>
struct Topic {{
  std::string name = "base";
  explicit Topic(std::string given) : name(given) {{}}
  std::string full() const {{ return "p/" + name; }}
}};
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{
    kept_.name = "before";
    tune("after");
    auto a = create_publisher<std_msgs::msg::String>({name}, 10);
  }}
  void put(const std::string & text) {{ kept_.name = text; }}
  void tune(const std::string & text) {{ {body} }}
  Topic kept_{{"made"}};
}};
int main(int argc, char ** argv) {{ rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Demo>()); }}
"""
BODIES = {
    "by a method": "auto inner = [&]() { put(text); }; inner();",
    "by itself": "auto inner = [&]() { kept_.name = text; }; inner();",
    "by a copy": "auto inner = [this, text]() { kept_.name = text; }; inner();",
    "in a block": "{ auto inner = [this, text]() { kept_.name = text; }; inner(); }",
}


@pytest.mark.parametrize("name", ["kept_.full()", "kept_.name"])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_field_that_a_lambda_changes_is_not_told_as_it_was(workspace: Any, body: str, name: str) -> None:
    """It was told as proved, as it was before the method was called."""
    found = workspace.package({"src/demo.cpp": CODE.format(body=body, name=name)}).only("publisher")
    told = (found.name.rpartition("/")[2], found.confidence)
    assert told in {("after", "folded"), ("{name}", "pattern")}


def test_a_method_that_changes_it_itself_is_followed(workspace: Any) -> None:
    """The twin: no lambda stands between."""
    found = workspace.package({"src/demo.cpp": CODE.format(body="put(text);", name="kept_.full()")}).only("publisher")
    assert (found.name, found.confidence) == ("/p/after", "folded")
