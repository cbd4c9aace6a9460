"""Files that a strict reader refuses (LNT061)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

XACRO = '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="r"><xacro:property name="a" value="1"/></robot>'
ROWS = [
    ("launch/a.launch", '<launch><arg name="a" doc="b & c"/></launch>', True),
    ("launch/a.launch", '<launch><arg name="a" doc="b &amp; c"/></launch>', False),
    ("launch/a.launch", "<launch><group></launch>", True),
    ("launch/a.launch", "", False),
    ("templates/a.launch", "<launch><group></launch>", False),
    ("launch/a.launch", "<launch>{{ nodes }}<group></launch>", False),
    ("urdf/a.xacro", XACRO, False),
    ("urdf/a.xacro", '<robot name="r"><xacro:property name="a" value="1"/></robot>', True),
    ("CMakeLists.txt", "project(pkg)\n", False),
    ("CMakeLists.txt", "project(pkg))\n", True),
    ("CMakeLists.txt", "project(pkg\n", True),
    ("CMakeLists.txt", "project(pkg)\nendif()\n", True),
]


@pytest.mark.parametrize(("path", "text", "expected"), ROWS)
def test_well_formed(workspace: Workspace, path: str, text: str, expected: bool) -> None:
    """Templates become what they should be later."""
    found = [finding.rule for finding in lint(workspace.package({path: text}, ros=1).root)]
    assert ("LNT061" in found) is expected
