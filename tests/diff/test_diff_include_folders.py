"""Headers below an include folder that nothing installs from."""

from __future__ import annotations

import pytest
from diff_repos import package

Files = dict[str, str | None]
LIBRARY = "add_library(arm src/arm.cpp)\n"
INSTALLED = "install(DIRECTORY include/ DESTINATION include)\n"
OLD = "#pragma once\nnamespace arm { struct Box { int a; }; }\n"


@pytest.mark.parametrize(
    ("more", "is_told"),
    [
        (INSTALLED, False),
        (INSTALLED.replace("include/ ", "include/arm "), False),
        (f"{INSTALLED}install(DIRECTORY node/include/ DESTINATION include)\n", True),
        (f"{INSTALLED}install(DIRECTORY node/ DESTINATION include)\n", True),
        (f"{INSTALLED}install(DIRECTORY ${{ALL_HEADERS}} DESTINATION include)\n", True),
        (f"{INSTALLED}catkin_package(INCLUDE_DIRS include node/include)\n", True),
        (f"{INSTALLED}find_package(x)\nx_install_all(node)\n", True),
        ("", True),
    ],
)
def test_an_include_folder_of_a_program(told, more: str, is_told: bool) -> None:  # type: ignore[no-untyped-def]
    """Nobody else finds what lies there while rules name the folder beside it, and only that."""
    files: Files = {
        "arm/package.xml": package("arm"),
        "arm/CMakeLists.txt": f"cmake_minimum_required(VERSION 3.8)\nproject(arm)\n{LIBRARY}{more}",
        "arm/src/arm.cpp": "int a() { return 1; }\n",
        "arm/include/arm/box.hpp": "#pragma once\nnamespace arm { struct Lid { int a; }; }\n",
        "arm/node/include/arm/node.hpp": OLD,
    }
    found = told(files, {"arm/node/include/arm/node.hpp": OLD.replace("int a", "int b")})
    assert bool(found) is is_told
