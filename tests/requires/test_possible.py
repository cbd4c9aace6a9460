"""What a package may have beside what it provides, so that nobody is told that it is missing."""

from __future__ import annotations

from pathlib import Path

import pytest
from ecm_checker.hub.package import Package

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

CMAKE = "cmake_minimum_required(VERSION 3.8)\nproject(arm)\n{}ament_package()\n"
SETUP = (
    "from setuptools import setup\n"
    "setup(name='arm', packages=['arm'], entry_points={{'console_scripts': ['drive = arm.a:main']}}{})\n"
)
MANIFEST = (
    "<package format='3'><name>arm</name><version>1.0.0</version>"
    "<buildtool_depend>ament_cmake</buildtool_depend></package>"
)


def stored(folder: Path, files: dict[str, str]) -> Package:
    for path, text in {"package.xml": MANIFEST, **files}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return package_of(extract(open_tree(folder), Options(jobs=1, hub=True)).packages[0])


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("add_executable(drive a.cpp)\n", {"drive"}),
        ("add_executable(drive a.cpp)\nset_target_properties(drive PROPERTIES OUTPUT_NAME go)\n", {"drive", "go"}),
        ("install(PROGRAMS scripts/a.py DESTINATION lib/arm RENAME drive)\n", {"drive", "a.py"}),
        ("add_custom_command(OUTPUT bin/drive COMMAND make)\n", {"drive"}),
        ("their_program(drive)\n", {"drive"}),
        ("", set()),
    ],
)
def test_programs_that_a_build_may_make(tmp_path: Path, body: str, names: set[str]) -> None:
    """Also those that it does not install, and words given to commands that are not known."""
    found = stored(tmp_path, {"CMakeLists.txt": CMAKE.format(body), "a.cpp": "int main() {}\n"})
    assert set(found.possible.get("executable", ())) == names


@pytest.mark.parametrize(
    ("files", "kind"),
    [
        ({}, "executable"),
        ({"CMakeLists.txt": CMAKE.format("add_executable(")}, "executable"),
        ({"CMakeLists.txt": CMAKE.format("add_executable(${WHO} a.cpp)\n")}, "executable"),
        (
            {
                "CMakeLists.txt": CMAKE.format("make_all()\n"),
                "a.cmake": "macro(make_all)\n  add_executable(x a.cpp)\nendmacro()\n",
            },
            "executable",
        ),
        ({"CMakeLists.txt": CMAKE.format("")}, "message"),
    ],
)
def test_kinds_of_which_anything_may_be(tmp_path: Path, files: dict[str, str], kind: str) -> None:
    """A build that is not understood, a command of the tree that makes programs, interfaces that may be generated."""
    assert kind in stored(tmp_path, files).open


def test_a_build_that_is_understood_tells_all(tmp_path: Path) -> None:
    """Then a program that is asked for and not there is missing."""
    files = {"CMakeLists.txt": CMAKE.format("rosidl_generate_interfaces(arm msg/A.msg)\n"), "msg/A.msg": "int32 a\n"}
    assert stored(tmp_path, files).open == ()


@pytest.mark.parametrize(
    ("files", "runs"),
    [
        ({"CMakeLists.txt": CMAKE.format("")}, True),
        ({"setup.py": SETUP.format("")}, False),
        ({"setup.py": SETUP.format(", scripts=['*.py']")}, True),
    ],
)
def test_files_that_may_be_started(tmp_path: Path, files: dict[str, str], runs: bool) -> None:
    """Of a Python package of ROS 2 only what setup.py names can be started."""
    assert stored(tmp_path, files).runs_files is runs


def test_interfaces_that_are_listed_only(tmp_path: Path) -> None:
    """A build may make a definition that is not in the tree."""
    files = {
        "CMakeLists.txt": CMAKE.format("rosidl_generate_interfaces(arm msg/A.msg msg/Made.msg)\n"),
        "msg/A.msg": "int32 a\n",
    }
    assert stored(tmp_path, files).possible["message"] == ("arm/msg/Made",)


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("install(FILES config/a.yaml DESTINATION share/${PROJECT_NAME})\n", {"a.yaml"}),
        ("install(FILES config/a.yaml DESTINATION share/${PROJECT_NAME} RENAME b.yaml)\n", {"b.yaml"}),
        ("install(DIRECTORY config/ DESTINATION share/${PROJECT_NAME}/param)\n", {"param/a.yaml"}),
        ("install(DIRECTORY config DESTINATION share/${PROJECT_NAME})\n", set()),
        ("install(FILES config/a.yaml DESTINATION lib)\n", set()),
    ],
)
def test_files_that_install_rules_put_elsewhere(tmp_path: Path, body: str, names: set[str]) -> None:
    """Below the share folder lies what lies in the folder of the package, and what is put there."""
    found = stored(tmp_path, {"CMakeLists.txt": CMAKE.format(body), "config/a.yaml": ""})
    assert set(found.possible.get("file", ())) == names


def test_what_something_else_fills_may_hold_any_file(tmp_path: Path) -> None:
    """A submodule that was not fetched is no folder without files."""
    listed = '[submodule "maps"]\n\tpath = maps\n\turl = https://example.org/maps\n'
    found = stored(tmp_path, {"CMakeLists.txt": CMAKE.format(""), ".gitmodules": listed})
    assert found.possible["file"] == ("maps/",)


@pytest.mark.parametrize(
    ("body", "makes", "tells"),
    [
        ("install(FILES a.yaml DESTINATION share/arm)\n", False, True),
        ("configure_file(a.yaml.in a.yaml)\n", True, True),
        ("install(FILES ${SOMETHING} DESTINATION share/arm)\n", True, False),
    ],
)
def test_what_a_build_tells_of_files(tmp_path: Path, body: str, makes: bool, tells: bool) -> None:
    """Where it makes files, or installs what only CMake knows, none is known to be missing."""
    found = stored(tmp_path, {"CMakeLists.txt": CMAKE.format(body)})
    assert (found.makes_files, found.tells_installed) == (makes, tells)


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("add_library(a a.cpp)\ninstall(TARGETS a DESTINATION lib)\n", {"a"}),
        ("add_library(a a.cpp)\ninstall(FILES a.h DESTINATION include)\n", set()),
        ("add_library(a a.cpp)\ninstall(FILES ${X} DESTINATION include)\n", {"a"}),
    ],
)
def test_libraries_that_others_may_find(tmp_path: Path, body: str, names: set[str]) -> None:
    """Those that are installed; where not all rules are known, all that are built."""
    found = stored(tmp_path, {"CMakeLists.txt": CMAKE.format(body), "a.cpp": "int a() { return 0; }\n"})
    assert set(found.possible.get("library", ())) == names


def test_sources_that_no_target_has(tmp_path: Path) -> None:
    body = "add_library(a a.cpp)\n"
    files = {
        "CMakeLists.txt": CMAKE.format(body),
        "a.cpp": "int a() { return 0; }\n",
        "b.cpp": "int b() { return 0; }\n",
    }
    assert stored(tmp_path, files).unbuilt == ("b.cpp",)
