"""Fields of settings that a function declares without a value, and takes its defaults from."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <rclcpp/rclcpp.hpp>
double measured();
{settings}
class N : public rclcpp::Node {{
public:
  N() : Node("n") {{
    Config config;
    {change}
    declare_parameter("reach", rclcpp::ParameterValue(config.reach));
    config.reach = get_parameter("reach").as_double();
  }}
  void load(Config & config);
}};
int main(int argc, char ** argv) {{ rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()); }}
"""
PLAIN = "struct Config { double reach{0.5}; };"
MADE = "struct Config { Config(); double reach{0.5}; };"
BASE = "struct Config : Other { double reach{0.5}; };"
ROWS = [
    ("as declared", PLAIN, "", 0.5),
    ("given something", PLAIN, "config.reach = measured();", None),
    ("given a number", PLAIN, "config.reach = 2.0;", 2.0),
    ("handed to a function", PLAIN, "load(config);", None),
    ("handed by address", PLAIN, "fill(&config);", None),
    ("written through a pointer", PLAIN, "auto * p = &config; p->reach = measured();", None),
    ("a constructor", MADE, "", None),
    ("no default", "struct Config { double reach; };", "", None),
]


@pytest.mark.parametrize(("settings", "change", "default"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_variable_has_the_defaults_of_its_class_until_it_changes(
    workspace: Any, settings: str, change: str, default: float | None
) -> None:
    """That the same function gives the field what the parameter has, behind the declaration, changes nothing."""
    found = workspace.package({"src/n.cpp": SOURCE.format(settings=settings, change=change)}).only("parameter")
    assert found.default == default


def test_a_macro_for_integers_is_its_number(workspace: Any) -> None:
    """`INT64_C(512)` of cstdint."""
    change = 'declare_parameter<int64_t>("size", INT64_C(512));'
    found = workspace.package({"src/n.cpp": SOURCE.format(settings=PLAIN, change=change)}).interfaces()
    assert [one.default for one in found if one.name == "size"] == [512]


BASE_FIRST = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Base : public rclcpp::Node {{
public:
  Base() : Node("n") {{ {change} }}
protected:
  struct {{ std::string name = "vehicle"; }} param;
}};
class Derived : public Base {{
public:
  Derived() : Base() {{ create_publisher<std_msgs::msg::String>(param.name + "/state", 1); }}
}};
int main(int argc, char ** argv) {{ rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<Derived>()); }}
"""


def test_the_constructor_of_a_base_comes_first(workspace: Any) -> None:
    """A field of a base was told as its class begins it, as proved, though that constructor had changed it."""
    change = 'declare_parameter("name", ""); param.name = get_parameter("name").as_string();'
    found = workspace.package({"src/n.cpp": BASE_FIRST.format(change=change)}).interfaces()
    told = {(one.name, one.confidence) for one in found if one.role == "publisher"}
    assert told.isdisjoint({("/vehicle/state", "folded"), ("/vehicle/state", "literal")})
    left = workspace.package({"src/n.cpp": BASE_FIRST.format(change="")}).interfaces()
    assert [one.name for one in left if one.role == "publisher"] == ["/vehicle/state"]
