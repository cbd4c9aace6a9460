"""Sources that a build makes are told: what they declare is in no contract."""

from __future__ import annotations

from typing import Any

import pytest

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.tree import open_tree
from ecm_extract.tree.unread import is_gap

_HEAD = "find_package(rclcpp REQUIRED)\nfind_package(makers REQUIRED)\n"
_MADE = "make_code(YAML params.yaml OUT made.cpp)\n"


def _unread(workspace: Any, cmake: str) -> list[tuple[str, str]]:
    workspace.package({"src/a.cpp": "int main() {}", "src/b.cxx": "", "CMakeLists.txt": _HEAD + cmake}, name="p")
    found = extract(open_tree(workspace.root), Options(jobs=1))
    return [(entry.path.rpartition("p/")[2], entry.reason) for entry in found.unread]


@pytest.mark.parametrize(
    ("cmake", "path"),
    [
        (_MADE + "add_executable(a src/a.cpp made.cpp)\n", "made.cpp"),
        ("add_executable(a src/a.cpp ${CMAKE_CURRENT_BINARY_DIR}/made.cpp)\n", "${CMAKE_BINARY_DIR}/made.cpp"),
        ("add_library(l SHARED gone/l.cc)\n", "gone/l.cc"),
        ("add_executable(a src/a.cpp)\ntarget_sources(a PRIVATE made.cpp)\n", "made.cpp"),
    ],
)
def test_a_source_that_is_not_in_the_tree_is_a_gap(workspace: Any, cmake: str, path: str) -> None:
    """A generator of another package writes code that nobody here can read."""
    assert _unread(workspace, cmake) == [(path, "generated")]


@pytest.mark.parametrize(
    "cmake",
    [
        "add_executable(a src/a.cpp src/b)\n",
        "file(GLOB own src/*.cpp)\nadd_executable(a ${own})\n",
        "add_executable(a src/a.cpp ${SOMEWHERE}/x.cpp /usr/src/x.cpp ../../x.cpp include/a.h)\n",
        "if(BUILD_TESTING)\nadd_executable(t test/t.cpp)\nendif()\nament_add_gtest(u test/u.cpp)\n",
        "option(MORE OFF)\nif(MORE)\nadd_executable(m more.cpp)\nendif()\n",
        "option(MORE OFF)\nif(MORE)\nset(extra more.cpp)\nendif()\nadd_executable(a src/a.cpp ${extra})\n",
    ],
)
def test_what_lies_elsewhere_or_only_some_builds_have_is_none(workspace: Any, cmake: str) -> None:
    """Sources without a suffix, of unknown folders, of tests and of options say nothing about the contract."""
    assert _unread(workspace, cmake) == []


def test_one_that_the_project_leaves_out_is_told_and_no_gap(workspace: Any) -> None:
    """What it declares stands in the overlay, so the answer is whole."""
    files = {"src/a.cpp": "int main() {}", "CMakeLists.txt": _HEAD + _MADE + "add_executable(a src/a.cpp made.cpp)\n"}
    workspace.package(files, name="p")
    (workspace.root / "ecm.toml").write_text('[extract]\nexclude = ["made.cpp"]\n')
    found = extract(open_tree(workspace.root), Options(jobs=1))
    assert [entry.reason for entry in found.unread if entry.path.endswith("p/made.cpp")] == ["excluded"]
    assert not any(map(is_gap, found.unread))
