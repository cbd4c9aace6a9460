"""What star imports bring is called as if it had been imported by its name."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """#!/usr/bin/env python
import rospy
from move_base_msgs.msg import MoveBaseAction
{imports}


class Demo(object):
    def __init__(self):
        {body}


if __name__ == "__main__":
    rospy.init_node("demo")
    Demo()
"""
GO = "'go', MoveBaseAction)"
ROWS = [
    ("a class", "from actionlib import *", f"SimpleActionClient({GO}", {"/go"}),
    ("a module that messages hand on", "from actionlib.msg import *", f"actionlib.SimpleActionClient({GO}", {"/go"}),
    ("one of several", "from actionlib import *\nfrom nav_msgs.msg import *", f"SimpleActionClient({GO}", {"/go"}),
    ("what a module of the tree imports", "from own import *", f"SimpleActionClient({GO}", {"/go"}),
    ("another library's", "from other import *", f"SimpleActionClient({GO}", set()),
    ("what is imported by its name", "from actionlib import *\nfrom other import SimpleActionClient",
     f"SimpleActionClient({GO}", set()),
    ("what the file declares", "from actionlib import *\n\ndef SimpleActionClient(*args): pass",
     f"SimpleActionClient({GO}", set()),
    ("what a variable is", "from actionlib import *", f"SimpleActionClient = print; SimpleActionClient({GO}", set()),
]  # fmt: skip


@pytest.mark.parametrize(("imports", "body", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_name_that_a_star_brings_is_what_the_rows_call_so(
    workspace: Any, imports: str, body: str, expected: set[str]
) -> None:
    """Such calls were told by nobody; what the file binds otherwise is that."""
    files = {
        "scripts/demo.py": NODE.format(imports=imports, body=body),
        "scripts/own.py": "from actionlib import SimpleActionClient\n",
        "CMakeLists.txt": "project(pkg)\ncatkin_install_python(PROGRAMS scripts/demo.py DESTINATION bin)\n",
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "action_client"} == expected


TYPES = """#!/usr/bin/env python
import rospy
{imports}

rospy.init_node("demo")
rospy.Publisher("/out", {name}, queue_size=1)
"""
BROUGHT = [
    ("by one of three that are known", "geometry_msgs nav_msgs std_msgs", "Path", "nav_msgs/msg/Path"),
    ("by the last one of an unknown and a known", "odd_msgs nav_msgs", "Path", "nav_msgs/msg/Path"),
    ("by an unknown one or one before it", "nav_msgs odd_msgs", "Path", None),
    ("by the unknown one, as no known has it", "nav_msgs odd_msgs std_msgs", "Reading", "odd_msgs/msg/Reading"),
    ("of an action", "nav_msgs std_msgs", "GetMapGoal", "nav_msgs/msg/GetMapGoal"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("packages", "name", "expected"), [row[1:] for row in BROUGHT], ids=[row[0] for row in BROUGHT]
)
def test_a_message_is_of_the_package_that_has_it(
    workspace: Any, packages: str, name: str, expected: str | None
) -> None:
    """Which of several packages that are not in the tree brings a name is known of those of the distribution."""
    imports = "\n".join(f"from {package}.msg import *" for package in packages.split())
    files = {
        "scripts/demo.py": TYPES.format(imports=imports, name=name),
        "CMakeLists.txt": "project(pkg)\ncatkin_install_python(PROGRAMS scripts/demo.py DESTINATION bin)\n",
    }
    found = workspace.package(files, ros=1).interfaces()
    assert [entry.type for entry in found if entry.role == "publisher"] == [expected]
