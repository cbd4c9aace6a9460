"""LNT034: a script that nothing runs, beside others that something does, is left aside."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

SCRIPT = "#!/usr/bin/env python\nimport rospy\nrospy.init_node('a')\npub = rospy.Publisher('/map', String)\n"
LAUNCH = "<launch><node pkg='pkg' type='{}' name='a'/></launch>"
BUILD = "project(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package()\n{}\n"
INSTALL = "catkin_install_python(PROGRAMS scripts/{} DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}})"
ROWS = [
    ({}, "", ["warning", "warning"]),
    ({"launch/a.launch": LAUNCH.format("one.py")}, "", ["warning", "info"]),
    ({}, INSTALL.format("one.py"), ["warning", "info"]),
    ({"scripts/three.py": "import two\n"}, INSTALL.format("one.py"), ["warning", "warning"]),
    ({"launch/a.launch": LAUNCH.format("one.py")}, INSTALL.format("two.py"), ["warning", "warning"]),
]


@pytest.mark.parametrize(("files", "install", "expected"), ROWS)
def test_severity_of_scripts(files: dict[str, str], install: str, expected: list[str], workspace: Workspace) -> None:
    """Where nothing of a package is run, all of its scripts are run by hand."""
    scripts = {"scripts/one.py": SCRIPT, "scripts/two.py": SCRIPT}
    workspace.package({**scripts, **files, "CMakeLists.txt": BUILD.format(install)}, ros=1)
    found = sorted((each.evidence[0].path, each.severity) for each in lint(workspace.root) if each.rule == "LNT034")
    assert [severity for _, severity in found] == expected
