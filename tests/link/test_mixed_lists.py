"""Defaults of Python that are no value of one type of parameters."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """#!/usr/bin/env python
import rospy
if __name__ == "__main__":
    rospy.init_node("demo")
    rospy.get_param("~p", {default})
"""
ROWS = [
    ("[True, 5]", None, [True, 5]),
    ('["a", 1]', None, ["a", 1]),
    ("[1, 2.5]", "double_array", [1.0, 2.5]),
    ("[1, 2]", "integer_array", [1, 2]),
    ('[True, float("inf")]', None, None),
    ('float("2.5")', "double", 2.5),
    ('int("5")', "integer", 5),
]


@pytest.mark.parametrize(("default", "kind", "data"), ROWS, ids=[row[0] for row in ROWS])
def test_a_list_of_several_types_has_none(workspace: Any, default: str, kind: str | None, data: object) -> None:
    """`[True, 5]` is no list of truths, and what `float` makes of a text no text: both were told as proved."""
    files = {
        "scripts/demo.py": NODE.format(default=default),
        "CMakeLists.txt": "project(pkg)\ncatkin_install_python(PROGRAMS scripts/demo.py DESTINATION bin)\n",
    }
    found = workspace.package(files, ros=1).only("parameter")
    assert (found.type, repr(found.default)) == (kind, repr(data))
