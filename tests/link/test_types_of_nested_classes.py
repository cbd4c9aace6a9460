"""Types of fields whose classes stand within the class that has them: others see these by their whole names."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
#include <ros/ros.h>
struct Limits {{ std::string low; }};
struct Drive {{
  struct Limits {{ double low; }};
  struct Wheel {{ Limits limits; }};
  Limits limits;
  struct {{ int count; }} unnamed;
  Wheel wheel;
  std::vector<Limits> several;
}};
struct Truck : Drive {{}};
struct Other {{ Limits limits; }};
class Demo {{
public:
  Demo() {{ ros::param::get("/a", {read}); }}
private:
  Drive drive_;
  Truck truck_;
  Other other_;
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "demo"); Demo demo; }}
"""
ROWS = [
    ("a class within", "drive_.limits.low", "double"),
    ("one without a name", "drive_.unnamed.count", "integer"),
    ("one within one", "drive_.wheel.limits.low", "double"),
    ("an element", "drive_.several[0].low", "double"),
    ("one of a base", "truck_.limits.low", "double"),
    ("one of the same name outside", "other_.limits.low", "string"),
]


@pytest.mark.parametrize(("read", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_fields_of_nested_classes_have_their_types(workspace: Any, read: str, expected: str) -> None:
    """The class was sought where the field is read, and not found there, or another one was."""
    found = workspace.package({"src/demo.cpp": CODE.format(read=read)}, ros=1).interfaces()
    assert [row.type for row in found if row.role == "parameter"] == [expected]
