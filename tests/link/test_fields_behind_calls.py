"""Fields of objects of C++ behind functions that the objects were handed to."""

from __future__ import annotations

from typing import Any

import pytest

MAIN = """
#include <rclcpp/rclcpp.hpp>
struct Cloud {{ std::string topic; int count; }};
struct Info {{ Cloud cloud; }};
{taker}
int main(int argc, char ** argv) {{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("demo");
  Info info;
  info.cloud.topic = "a";
  {body}
  auto publisher = node->create_publisher<std_msgs::msg::String>(info.cloud.topic, 1);
  rclcpp::spin(node);
}}
"""
SETS = 'void fill(Cloud & cloud) { cloud.topic = "b"; }'
POINTED = 'void fill(Cloud * cloud) { cloud->topic = "b"; }'
PERHAPS = 'void fill(Cloud & cloud) { if (cloud.count) { cloud.topic = "b"; } }'
WHOLE = 'void fill(Info & given) { given.cloud.topic = "b"; }'
COUNTS = "void fill(Info & given) { given.cloud.count = 1; }"
TAKERS = [
    (SETS, "fill(info.cloud);", ["/b"]),
    (POINTED, "fill(&info.cloud);", ["/b"]),
    (PERHAPS, "fill(info.cloud);", ["/a", "/b"]),
    (WHOLE, "fill(info);", ["/b"]),
    (COUNTS, "fill(info);", ["/a"]),
]
UNTOLD = [
    ("", "other::fill(info.cloud);"),
    ("", "other::fill(&info);"),
    ("void fill(Info & given) { given = other::load(); }", "fill(info);"),
    ("void fill(Info & given) { other::load(given.cloud); }", "fill(info);"),
]


def _published(workspace: Any, taker: str, body: str) -> list[Any]:
    found = workspace.package({"src/demo.cpp": MAIN.format(taker=taker, body=body)}).interfaces()
    return [entry for entry in found if entry.role == "publisher"]


@pytest.mark.parametrize(("taker", "body", "names"), TAKERS, ids=[row[0][:50] for row in TAKERS])
def test_a_field_is_what_a_function_leaves_it_with(workspace: Any, taker: str, body: str, names: list[str]) -> None:
    found = _published(workspace, taker, body)
    assert sorted(entry.name for entry in found) == names
    assert {entry.confidence for entry in found} == {"folded" if len(names) == 1 else "one_of"}


@pytest.mark.parametrize(("taker", "body"), UNTOLD, ids=[str(at) for at in range(len(UNTOLD))])
def test_a_field_that_others_may_have_changed_is_not_told_as_sure(workspace: Any, taker: str, body: str) -> None:
    assert {entry.confidence for entry in _published(workspace, taker, body)} <= {"pattern", "one_of"}


DECLARED = """
#include <rclcpp/rclcpp.hpp>
struct Cloud {{ std::string topic{default}; int count; }};
void fill(Cloud & cloud) {{ {body} }}
int main(int argc, char ** argv) {{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("demo");
  Cloud cloud;
  fill(cloud);
  auto publisher = node->create_publisher<std_msgs::msg::String>(cloud.topic, 1);
  rclcpp::spin(node);
}}
"""
LEFT = [
    (' = "a"', 'if (cloud.count) { cloud.topic = "b"; }', ["/a", "/b"]),
    (' = "a"', 'cloud.topic = "b";', ["/b"]),
    (' = "a"', 'if (cloud.count) { cloud.topic = "b"; } else { cloud.topic = "c"; }', ["/b", "/c"]),
    (' = ""', 'if (cloud.count) { cloud.topic = "b"; }', ["/b"]),
]


@pytest.mark.parametrize(("default", "body", "names"), LEFT, ids=[row[1][:50] + row[0] for row in LEFT])
def test_a_field_keeps_what_its_class_declares_where_nobody_surely_sets_it(
    workspace: Any, default: str, body: str, names: list[str]
) -> None:
    found = workspace.package({"src/demo.cpp": DECLARED.format(default=default, body=body)}).interfaces()
    assert sorted(entry.name for entry in found if entry.role == "publisher") == names
