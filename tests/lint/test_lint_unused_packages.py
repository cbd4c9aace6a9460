"""What is a use of a package that package.xml asks for to build, and what a tool of the build is (LNT035)."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from lint_fixtures import lint
from workspaces import MANIFESTS, Workspace

Files = Mapping[str, str]
CORE = {"include/shapes/box.hpp": "class Box {};\n"}
MACRO = CORE | {"cmake/core_common-extras.cmake": "function(core_library name)\nendfunction()\n"}
PLAIN = {"a.cpp": "int a;\n"}

ROWS: list[tuple[Files, Files, bool]] = [
    (CORE, PLAIN, True),
    (CORE, {"a.cpp": "int a; // core_common\n/* core_common */\n"}, True),
    (CORE, {"a.cpp": "core_common::Box a;\n"}, False),
    (CORE, {"a.cpp": 'auto a = path("package://core_common/a.stl");\n'}, False),
    (CORE, {"a.cpp": "#include <shapes/box.hpp>\n"}, False),
    (CORE, {"a.cpp": "// #include <shapes/box.hpp>\n"}, True),
    (CORE, PLAIN | {"test/b.cpp": "#include <shapes/box.hpp>\n"}, False),
    (CORE, {"a.py": '"""Not core_common."""\n# core_common\n'}, True),
    (CORE, {"a.py": "import core_common.shapes\n"}, False),
    (CORE, PLAIN | {"config/a.yaml": "plugin: core_common/Box\n"}, False),
    (CORE, PLAIN | {"launch/a.launch": "<launch><!-- core_common --></launch>\n"}, True),
    (CORE, {"msg/A.msg": "core_common/B b\n"}, False),
    (CORE, {"msg/A.msg": "# as core_common has it\nint32 b\n"}, True),
    (MACRO, PLAIN, True),
    (MACRO, PLAIN | {"CMakeLists.txt": "find_package(core_common)\ncore_library(a)\n"}, False),
]


@pytest.mark.parametrize(("core", "user", "expected"), ROWS)
def test_uses(workspace: Workspace, core: Files, user: Files, expected: bool) -> None:
    """A comment uses nothing, a command that a package defines for CMake is a use of it, and no name is a tool's."""
    assert unused(workspace, "core_common", core, user) is expected


def test_what_only_names_others_is_used_by_those(workspace: Workspace) -> None:
    """A package without a file that can be used brings others; one that brings none is unused."""
    assert unused(workspace, "core_common", {}, PLAIN)
    asked = MANIFESTS[1].format(name="core_common").replace("</package>", "<depend>eigen</depend></package>")
    assert not unused(workspace, "core_common", {"package.xml": asked}, PLAIN)


@pytest.mark.parametrize(
    ("name", "file", "expected"), [("std_msgs", "action/A.action", False), ("std_msgs", "msg/A.msg", True)]
)
def test_what_is_generated_uses_packages(workspace: Workspace, name: str, file: str, expected: bool) -> None:
    """What is generated of an action in ROS 1 includes headers of std_msgs."""
    assert unused(workspace, name, None, {file: "int32 a\n---\n---\n" if "action" in file else "int32 a\n"}) is expected


def unused(workspace: Workspace, name: str, files: Files | None, user: Files) -> bool:
    """Whether a package that depends on another one is told to use nothing of it; None leaves that one out."""
    if files is not None:
        workspace.package({"CMakeLists.txt": f"project({name})\n", **files}, ros=1, name=name)
    manifest = MANIFESTS[1].format(name="pkg").replace("</package>", f"<depend>{name}</depend></package>")
    workspace.package({"CMakeLists.txt": "project(pkg)\n", **user, "package.xml": manifest}, ros=1)
    return any(each.rule == "LNT035" and each.subjects == ("pkg",) for each in lint(workspace.root))
