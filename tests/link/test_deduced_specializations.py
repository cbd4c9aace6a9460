"""Of a function template and its specializations a call means the one for the types of its arguments."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
#include <ros/ros.h>
#include <geometry_msgs/Pose.h>
#include <Eigen/Core>
struct Limits {{ double low; std::string unit; uint32_t count; other::Thing thing; Eigen::Vector3d axis; }};
struct Drive {{ Limits limits; }};
struct Frame {{ double yaw; }};
using Pose2 = Frame;
using Seconds = float;
template <typename T> bool read(ros::NodeHandle & nh, const std::string & key, T & value) {{
  return nh.getParam(key, value);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, uint32_t & value) {{
  int whole = value;
  return read(nh, key, whole);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, geometry_msgs::Point & value) {{
  return read(nh, key + "/x", value.x) && read(nh, key + "/y", value.y);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, geometry_msgs::Pose & value) {{
  return read(nh, key + "/position", value.position);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, Limits & value) {{
  return read(nh, key + "/low", value.low) && read(nh, key + "/unit", value.unit);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, Eigen::Matrix<double, 3, 1> & value) {{
  return read(nh, key + "/0", value(0)) && read(nh, key + "/1", value.y());
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, Pose2 & value) {{
  return read(nh, key + "/yaw", value.yaw);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, Seconds & value) {{
  float seconds = value;
  return nh.getParam(key + "/seconds", seconds);
}}
template <> inline bool read(ros::NodeHandle & nh, const std::string & key, Eigen::Quaterniond & value) {{
  return read(nh, key + "/w", value.w());
}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  {call}
}}
"""
POINT = {"a/x": "double", "a/y": "double"}
ROWS = [
    ("a number", 'double a; read(nh, "a", a);', {"a": "double"}),
    ("a text", 'std::string a; read(nh, "a", a);', {"a": "string"}),
    ("a number that has one", 'uint32_t a; read(nh, "a", a);', {"a": "integer"}),
    ("another name of it", 'unsigned int a; read(nh, "a", a);', {"a": "integer"}),
    ("a message", 'geometry_msgs::Point a; read(nh, "a", a);', POINT),
    ("a part of one", 'geometry_msgs::Pose a; read(nh, "a", a.position);', POINT),
    ("one within", 'geometry_msgs::Pose a; read(nh, "a", a);', {"a/position/x": "double", "a/position/y": "double"}),
    ("a struct", 'Limits a; read(nh, "a", a);', {"a/low": "double", "a/unit": "string"}),
    ("a field", 'Drive d; read(nh, "a", d.limits);', {"a/low": "double", "a/unit": "string"}),
    ("a field of a field", 'Drive d; read(nh, "a", d.limits.unit);', {"a": "string"}),
    ("a field that has one", 'Limits d; read(nh, "a", d.count);', {"a": "integer"}),
    ("a vector", 'Eigen::Vector3d a; read(nh, "a", a);', {"a/0": "double", "a/1": "double"}),
    ("a vector in a field", 'Limits d; read(nh, "a", d.axis);', {"a/0": "double", "a/1": "double"}),
    ("a struct whose other name has one", 'Frame a; read(nh, "a", a);', {"a/yaw": "double"}),
    ("a number whose other name has one", 'float a; read(nh, "a", a);', {"a/seconds": "double"}),
    ("a quaternion by its arguments", 'Eigen::Quaternion<double> a; read(nh, "a", a);', {"a/w": "double"}),
    ("a type that is named", 'Limits a; read<Limits>(nh, "a", a);', {"a/low": "double", "a/unit": "string"}),
]


@pytest.mark.parametrize(("call", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_call_means_the_specialization_for_its_arguments(workspace: Any, call: str, expected: dict[str, str]) -> None:
    """Calls with fields meant all of them, which were told one within the other."""
    found = workspace.package({"src/demo.cpp": CODE.format(call=call)}, ros=1).interfaces()
    assert {row.name.strip("/"): row.type for row in found if row.role == "parameter"} == expected


def test_of_a_type_that_nobody_knows_all_are_told(workspace: Any) -> None:
    """Another library's type may be another name of one that has a specialization."""
    call = 'Limits d; read(nh, "a", d.thing);'
    found = workspace.package({"src/demo.cpp": CODE.format(call=call)}, ros=1).interfaces()
    assert {"a", "a/x", "a/low"} <= {row.name.strip("/") for row in found if row.role == "parameter"}
