"""What is a conversion between frames by its types or its library, and what is a use of its result (LNT028)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

SAME = "tf::Vector3 turned(const tf::Vector3 &value);"
TEMPLATE = (
    "struct UAS { template<class T> static T enu_ned(const T &in); template<class T> static T body(const T &in); };"
)
BUFFER = "struct Listener { tf2_ros::Buffer buffer; void send(const tf::Vector3 &given); };"

ROWS = [
    (SAME, "auto other = turned(given);", True),
    (SAME, "tf::Vector3 other = turned(given);", True),
    ("using namespace tf; Vector3 turned(const Vector3 &value);", "auto other = turned(given);", True),
    (SAME, "auto other = turned(given); // other\n", True),
    (SAME, 'auto other = turned(given); say("other");', True),
    (SAME, "auto other = turned(given); say(other);", False),
    (SAME, "auto &other = turned(given);", False),
    (TEMPLATE, "auto other = UAS::enu_ned(UAS::body(given));", True),
    (TEMPLATE, "int count = 1; auto other = UAS::enu_ned(count);", False),
    ("", "auto other = turned(given);", False),
    ("", "auto other = transform_frame_ned_enu(given);", False),
    ("", "auto other = mavros::ftf::transform_frame_ned_enu(given);", True),
    ("namespace ftf = mavros::ftf;", "auto other = ftf::transform_frame_ned_enu(given);", True),
    (BUFFER, 'Listener a; auto other = a.buffer.transform(given, "map");', True),
    ("std::string turned(const std::string &value);", 'auto other = turned("a");', False),
    ("tf::Vector3 &turned(tf::Vector3 &value);", "auto other = turned(given);", False),
    ("tf::Vector3 turned(tf::Vector3 value, State &state);", "auto other = turned(given, state);", False),
    ("tf::Vector3 sum(const tf::Vector3 &a, const tf::Vector3 &b);", "auto other = sum(given, given);", False),
]


@pytest.mark.parametrize(("declared", "body", "expected"), ROWS)
def test_conversions(workspace: Workspace, declared: str, body: str, expected: bool) -> None:
    """What a function takes and gives tells, or the library that it is of; what it is called does not."""
    sent = f"void send(const tf::Vector3 &given) {{ {body} }}\n"
    files = {"a.cpp": f"{declared}\n{sent}", "CMakeLists.txt": "add_executable(a a.cpp)\n"}
    found = [finding.rule for finding in lint(workspace.package(files).root)]
    assert ("LNT028" in found) is expected
