"""Helpers that hand an object what they read, or else what they were given."""

from __future__ import annotations

from typing import Any

import pytest

HELPER = """
#include <ros/ros.h>
template <typename T> struct Live {{ void set(const T & value); void reset(const T & value); T kept; }};
template <typename T>
bool live(const ros::NodeHandle & nh, const std::string & name, Live<T> & value, const T & otherwise, const T & other) {{
  T raw;
  if (!nh.getParam(name, raw)) {{ {denied} }}
  {read}
  return true;
}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh("~");
  Live<double> rate;
  live(nh, "rate", rate, 0.5, 0.7);
}}
"""
ROWS = [
    ("value.set(otherwise); return false;", "value.set(raw);", 0.5),
    ("value = Live<T>(otherwise); return false;", "value = Live<T>(raw);", 0.5),
    ("value.set(otherwise); value.set(other); return false;", "value.set(raw);", None),
    ("value.reset(otherwise); return false;", "value.set(raw);", None),
    ("value.set(otherwise); throw Unset();", "value.set(raw);", None),
    ("log.set(otherwise); return false;", "log.set(raw);", None),
    ("value.set(T()); return false;", "value.set(raw);", None),
]


@pytest.mark.parametrize(("denied", "read", "default"), ROWS, ids=[row[0] for row in ROWS])
def test_what_a_helper_hands_on_instead_is_the_default(workspace: Any, denied: str, read: str, default: object) -> None:
    """The same is done with an argument where nothing was read, to what the caller gets back; of two it is none."""
    text = HELPER.format(denied=denied, read=read)
    assert workspace.package({"src/demo.cpp": text}, ros=1).only("parameter").default == default
