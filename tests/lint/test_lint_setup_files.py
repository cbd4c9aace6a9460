"""LNT059: what the setup.py of a package names of the package itself."""

from __future__ import annotations

from typing import Any

import pytest
from lint_fixtures import lint

MANIFEST = (
    "<package format='3'><name>pkg</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license><exec_depend>rclpy</exec_depend>"
    "<export><build_type>{kind}</build_type></export></package>"
)
SETUP = "from glob import glob\nfrom setuptools import find_packages, setup\nsetup(name='pkg', {rows})\n"
FILES = {"pkg/__init__.py": "", "pkg/node.py": "def main(): pass\n", "pkg/parts/__init__.py": "", "config/a.yaml": ""}
ROWS = [
    ("packages=['pkg', 'pkg.parts']", 0),
    ("packages=['pkg', 'gone']", 1),
    ("packages=['pkg', 'pkg.gone']", 1),
    ("packages=find_packages(), py_modules=['pkg.node']", 0),
    ("packages=['other'], package_dir={'other': 'pkg'}", 0),
    ("packages=['other'], package_dir={'': 'pkg'}", 1),
    ("data_files=[('share/pkg', ['config/a.yaml'])]", 0),
    ("data_files=[('share/pkg', ['config/b.yaml'])]", 1),
    ("data_files=[('share/pkg', ['./config/a.yaml', 'config/*.yml']), ('share', glob('launch/*.py'))]", 0),
    ("data_files=[('share/pkg', ['/etc/b.yaml', '../b.yaml', somewhere + '/b.yaml'])]", 0),
    ("packages=['pkg'], entry_points={'console_scripts': ['node = pkg.node:main']}", 0),
    ("packages=['pkg'], entry_points={'console_scripts': ['node = pkg.parts:main']}", 0),
    ("packages=['pkg'], entry_points={'console_scripts': ['node = pkg.gone:main']}", 1),
    ("packages=find_packages(), entry_points={'console_scripts': ['node = pkg.gone:main']}", 1),
    ("packages=['pkg'], entry_points={'console_scripts': ['node = elsewhere.gone:main']}", 0),
    ("packages=['pkg'], entry_points={'other.group': ['node = pkg.gone:main']}", 0),
]


@pytest.mark.parametrize(("rows", "expected"), ROWS)
def test_what_setup_names(rows: str, expected: int, workspace: Any) -> None:
    """Files, packages and modules of programs; what only a run tells, and what is of others, is left alone."""
    files = {**FILES, "package.xml": MANIFEST.format(kind="ament_python"), "setup.py": SETUP.format(rows=rows)}
    assert [each.rule for each in lint(workspace.package(files).root)].count("LNT059") == expected


def test_where_a_package_is_written(workspace: Any) -> None:
    """A package that is not there is told where the list names it, be it by a variable."""
    setup = "from setuptools import setup\nname = 'gone'\nsetup(name=name, packages=[\n  'pkg',\n  name,\n])\n"
    files = {**FILES, "package.xml": MANIFEST.format(kind="ament_python"), "setup.py": setup}
    found = [each.evidence[0].line for each in lint(workspace.package(files).root) if each.rule == "LNT059"]
    assert found == [5]


def test_a_package_that_cmake_builds_is_not_set_up(workspace: Any) -> None:
    """What setup.py says there is read for a part, or never."""
    rows = "packages=['gone'], data_files=[('share/pkg', ['config/b.yaml'])]"
    files = {**FILES, "package.xml": MANIFEST.format(kind="ament_cmake"), "setup.py": SETUP.format(rows=rows)}
    assert "LNT059" not in [each.rule for each in lint(workspace.package(files).root)]
