"""Variables of Python modules that functions set: who calls the functions decides what they hold."""

from __future__ import annotations

from typing import Any

import pytest

LIBRARY = """
_space = "/base"

def get_space():
    global _space
    return _space

def set_space(space):
    {setter}

def topic(*parts):
    return "/".join((get_space(),) + parts)
"""
SCRIPT = """#!/usr/bin/env python
import argparse
import rospy
import pkg.names
from std_msgs.msg import String

def main():
    rospy.init_node("demo")
    parser = argparse.ArgumentParser()
    parser.add_argument("--space", default="/base")
    parser.add_argument("--any")
    args = parser.parse_args()
    {call}
    rospy.Subscriber(pkg.names.topic("gps", "fix"), String, print)

main()
"""
SETS = "global _space; _space = space"
CASES = [
    ("", "pass", {("/base/gps/fix", "folded")}),
    (SETS, "pass", {("/base/gps/fix", "default")}),
    (SETS, "pkg.names.set_space(args.space)", {("/base/gps/fix", "default")}),
    (SETS, 'pkg.names.set_space("/base")', {("/base/gps/fix", "folded")}),
    (SETS, 'pkg.names.set_space("/other")', {("/base/gps/fix", "one_of"), ("/other/gps/fix", "one_of")}),
    (SETS, "pkg.names.set_space(input())", {("/base/gps/fix", "one_of"), ("/{input}/gps/fix", "pattern")}),
    ("global _space; _space = space.data", "pass", {("/base/gps/fix", "default")}),
    ("global _space; _space = input()", "pass", {("/base/gps/fix", "one_of"), ("/{input}/gps/fix", "pattern")}),
    ("global _space; _space += '/more'", "pass", {("/base/gps/fix", "one_of"), ("/{space}/more/gps/fix", "pattern")}),
]


@pytest.mark.parametrize(("setter", "call", "told"), CASES, ids=[f"{row[0]} {row[1]}" for row in CASES])
def test_what_functions_give_a_variable_is_told_beside_what_its_module_gives_it(
    workspace: Any, setter: str, call: str, told: set[tuple[str, str]]
) -> None:
    """`global x` in a function that assigns it: its calls say what, and nobody's call leaves the module's value."""
    files = {
        "setup.py": "from distutils.core import setup\nsetup(packages=['pkg'], package_dir={'': 'src'})\n",
        "CMakeLists.txt": "project(pkg)\ncatkin_python_setup()\ncatkin_install_python(PROGRAMS scripts/demo)\n",
        "src/pkg/__init__.py": "",
        "src/pkg/names.py": LIBRARY.format(setter=setter or "pass"),
        "scripts/demo": SCRIPT.format(call=call),
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {(entry.name, entry.confidence) for entry in found if entry.role == "subscriber"} == told


WAITING = """#!/usr/bin/env python
import rospy
from pkg import names
from std_srvs.srv import Empty

def main():
    rospy.init_node("demo")
    rospy.wait_for_service(names.service)
    outside(names.service)
    rospy.ServiceProxy(names.service, Empty)()

main()
"""


def test_a_text_of_a_module_is_what_it_is_whoever_got_it(workspace: Any) -> None:
    """`names.x` is given to a function from elsewhere, which can change neither the text nor the module's name."""
    files = {
        "setup.py": "from distutils.core import setup\nsetup(packages=['pkg'], package_dir={'': 'src'})\n",
        "CMakeLists.txt": "project(pkg)\ncatkin_python_setup()\ncatkin_install_python(PROGRAMS scripts/demo)\n",
        "src/pkg/__init__.py": "",
        "src/pkg/names.py": 'service = "/data/service"\n',
        "scripts/demo": WAITING,
    }
    assert workspace.package(files, ros=1).only("service_client").name == "/data/service"
