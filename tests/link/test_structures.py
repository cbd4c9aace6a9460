"""Names that come from fields of plain structures: from what the object is made, else they are not told."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <ros/ros.h>
struct Row {{ std::string label; std::string path = ""; }};
ros::NodeHandle * base;
std::map<std::string, Row> rows{{{{"left", {{"Left", "left_arm"}}}}, {{"right", {{"Right", "right_arm"}}}}}};
void limit(const Row & row) {{ base->param(row.path + "/max", 7); }}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  base = new ros::NodeHandle("/arms");
  {body}
}}
"""
BODIES = [
    ('Row row{"Left", "left_arm"}; limit(row);', ["/arms/left_arm/max"]),
    ('Row row{"Left"}; limit(row);', ["/max"]),
    ("Row row; limit(row);", ["/max"]),
    ("Row row = outside(); limit(row);", ["/arms/{row}/max"]),
    ("for (const auto & pair : rows) { limit(pair.second); }", ["/arms/left_arm/max", "/arms/right_arm/max"]),
    (
        'for (const auto & pair : rows) { base->param(pair.first + "/max", 7); }',
        ["/arms/left/max", "/arms/right/max", "/arms/{row}/max"],
    ),
    ("std::function<void(const Row &)> call = &limit;", ["/arms/{row}/max"]),
    ("for (const Row & row : outside()) { limit(row); }", ["/arms/{row}/max"]),
]


@pytest.mark.parametrize(("body", "names"), BODIES, ids=[row[0][:50] for row in BODIES])
def test_a_field_is_what_its_object_was_made_with(workspace: Any, body: str, names: list[str]) -> None:
    """The default that a structure declares is told of an object that is surely as declared, and of no other."""
    found = workspace.package({"src/demo.cpp": SOURCE.format(body=body)}, 1).interfaces()
    assert sorted({entry.name for entry in found if entry.role == "parameter"}) == names
