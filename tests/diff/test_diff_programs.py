"""What programs are made of is nobody else's."""

from __future__ import annotations

import pytest

HEADER = "#pragma once\nnamespace arm {\nclass Arm { public: void move(); };\n}\n"
SOURCE = '#include "arm/arm.hpp"\nvoid arm::Arm::move() {}\nint main() {}\n'
USING = '#include "arm/arm.hpp"\nusing arm::Arm;\nvoid Arm::move() {}\nint main() {}\n'
INSTALLS = "install(DIRECTORY include/ DESTINATION include)\n"


@pytest.mark.parametrize(
    ("build", "source", "is_public"),
    [
        ("add_executable(arm src/arm.cpp)\n", SOURCE, False),
        ("add_executable(arm src/arm.cpp)\nadd_library(armlib src/arm.cpp)\n", SOURCE, True),
        ("add_executable(arm src/arm.cpp)\nadd_library(other src/other.cpp)\n", SOURCE, False),
        ("add_executable(arm src/arm.cpp)\nadd_library(other ${SOURCES})\n", SOURCE, True),
        ("add_executable(arm src/arm.cpp)\n", "int main() {}\n", True),
        ("add_executable(arm src/arm.cpp)\nament_export_include_directories(include)\n", "int main() {}\n", True),
        ("add_executable(arm src/arm.cpp)\nadd_library(other src/other.cpp)\n", "int main() {}\n", True),
        ("add_executable(arm src/arm.cpp)\n", USING, False),
    ],
)
def test_headers_whose_code_only_a_program_has(told, build: str, source: str, is_public: bool) -> None:  # type: ignore[no-untyped-def]
    """Nobody can link it; what stands in the header whole can be used where others are told of the header."""
    make = f"project(arm)\n{build}install(TARGETS arm DESTINATION lib/arm)\n{INSTALLS}"
    old = {"arm/CMakeLists.txt": make, "arm/include/arm/arm.hpp": HEADER, "arm/src/arm.cpp": source}
    new = {"arm/include/arm/arm.hpp": HEADER.replace("move", "go"), "arm/src/arm.cpp": source.replace("move", "go")}
    assert any(entry[0] == "method" for entry in told(old, new)) is is_public


@pytest.mark.parametrize(("installs", "is_public"), [(INSTALLS, True), ("", False)])
def test_headers_that_nobody_is_told_of(told, installs: str, is_public: bool) -> None:  # type: ignore[no-untyped-def]
    """Nobody finds the headers of a package that is there to be started, unless it installs them."""
    make = f"project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n{installs}"
    old = {"arm/CMakeLists.txt": make, "arm/include/arm/arm.hpp": HEADER, "arm/src/arm.cpp": "int main() {}\n"}
    found = told(old, {"arm/include/arm/arm.hpp": HEADER.replace("move", "go")})
    assert any(entry[0] == "method" for entry in found) is is_public


FIND = "project(arm)\nfind_package(ament_cmake)\nadd_library(arm src/arm.cpp)\nament_package()\n"
LIBRARY = "install(TARGETS arm DESTINATION lib/arm)\n"


@pytest.mark.parametrize(
    ("rule", "is_public"),
    [
        ("install(FILES ${FOREIGN_DIR}/libforeign.so DESTINATION lib)\n", False),
        ("install(FILES ${FOREIGN_FILES} DESTINATION ${FOREIGN_DIR})\n", True),
        ("install(DIRECTORY ${FOREIGN_FOLDERS} DESTINATION .)\n", True),
        ("install(FILES ${FOREIGN_FILES} DESTINATION include)\n", True),
    ],
)
def test_headers_beside_what_only_cmake_knows(told, rule: str, is_public: bool) -> None:  # type: ignore[no-untyped-def]
    """What is put into a folder where no header is found installs none, whatever it is."""
    old = {"arm/CMakeLists.txt": FIND + LIBRARY + rule, "arm/include/arm/arm.hpp": HEADER, "arm/src/arm.cpp": SOURCE}
    found = told(old, {"arm/include/arm/arm.hpp": HEADER.replace("move", "go")})
    assert any(entry[0] == "method" for entry in found) is is_public


SETUP = "from setuptools import setup\nsetup(name='arm', packages=['arm'], entry_points={entry})\n"
ENTRY = "{'console_scripts': ['arm = arm.driver:main']}"
DRIVER = "class Driver:\n    def move(self):\n        pass\ndef main():\n    Driver().move()\n"


@pytest.mark.parametrize(
    ("entry", "init", "is_public"),
    [("{}", "", True), (ENTRY, "", False), (ENTRY, "from .driver import Driver\n", True)],
)
def test_modules_that_a_console_script_starts(told, entry: str, init: str, is_public: bool) -> None:  # type: ignore[no-untyped-def]
    """A script's class is its own, unless another module offers it."""
    old = {"arm/setup.py": SETUP.replace("{entry}", entry), "arm/arm/__init__.py": init, "arm/arm/driver.py": DRIVER}
    found = told(old, {"arm/arm/driver.py": DRIVER.replace("move", "stop_all")})
    assert any(entry[0] == "method" for entry in found) is is_public


@pytest.mark.parametrize(
    ("init", "expected"),
    [
        ("", {("executable", "removed", "drive", None)}),
        (
            "from .driver import Driver\n",
            {
                ("executable", "removed", "drive", None),
                ("class", "removed", "arm.driver.Driver", None),
                ("function", "removed", "arm.driver.main", None),
            },
        ),
    ],
)
def test_modules_that_a_rule_installs_as_programs(told, init: str, expected: set[object]) -> None:  # type: ignore[no-untyped-def]
    """A module that is a program by its rule is that under the name it gets, unless another module offers it."""
    make = "project(arm)\nament_python_install_package(arm)\n"
    rule = "install(PROGRAMS arm/driver.py DESTINATION lib/arm RENAME drive)\n"
    old = {"arm/CMakeLists.txt": make + rule, "arm/arm/__init__.py": init, "arm/arm/driver.py": DRIVER}
    found = told(old, {"arm/CMakeLists.txt": make, "arm/arm/driver.py": "import os\n"})
    assert {entry for entry in found if entry[1] != "added"} == expected


@pytest.mark.parametrize(
    ("told_of", "is_public"),
    [("catkin_package(INCLUDE_DIRS include)\n", True), ("catkin_package(CATKIN_DEPENDS roscpp)\n", False), ("", True)],
)
def test_headers_that_catkin_is_not_told_of(told, told_of: str, is_public: bool) -> None:  # type: ignore[no-untyped-def]
    """A package that installs nothing is found where it lies, with the folders that it states."""
    make = f"project(arm)\n{told_of}add_library(armlib src/arm.cpp)\n"
    source = SOURCE.replace("int main() {}\n", "")
    old = {"arm/CMakeLists.txt": make, "arm/include/arm/arm.hpp": HEADER, "arm/src/arm.cpp": source}
    new = {"arm/include/arm/arm.hpp": HEADER.replace("move", "go"), "arm/src/arm.cpp": source.replace("move", "go")}
    assert any(entry[0] == "method" for entry in told(old, new)) is is_public


@pytest.mark.parametrize("given", [True, False])
def test_a_library_that_a_command_of_another_package_is_given(told, given: bool) -> None:  # type: ignore[no-untyped-def]
    """In a package of plain CMake it may be what installs the library."""
    installs = "install(TARGETS arm DESTINATION lib)\n"
    make = "find_package(tools)\nproject(arm)\nadd_library(arm src/arm.cpp)\n"
    handed = "configure_package(NAMESPACE arm TARGETS arm)\n" if given else ""
    old = {"arm/CMakeLists.txt": make + installs, "arm/src/arm.cpp": "int arm() { return 1; }\n"}
    gone = ("library", "removed", "arm", None) in told(old, {"arm/CMakeLists.txt": make + handed})
    assert gone is not given


@pytest.mark.parametrize(("kind", "is_told"), [("OBJECT", False), ("SHARED", True), ("", True)])
def test_objects_that_a_build_keeps_are_no_library(told, kind: str, is_told: bool) -> None:  # type: ignore[no-untyped-def]
    """Nobody finds a file of them, though they stand in an install rule for what links them."""
    make = f"project(arm)\nadd_library(arm {kind} src/arm.cpp)\ninstall(TARGETS arm EXPORT arms DESTINATION lib)\n"
    old = {"arm/CMakeLists.txt": make, "arm/src/arm.cpp": "int arm() { return 1; }\n"}
    found = told(old, {"arm/CMakeLists.txt": "project(arm)\n"})
    assert (("library", "removed", "arm", None) in found) is is_told


COPIED = "from setuptools import setup\nfrom glob import glob\nsetup(name='arm', packages=[], data_files=[{files}])\n"
SCRIPT = "#!/bin/sh\necho up\n"
MAKE = "project(arm)\nfind_package(catkin)\ncatkin_package()\ninstall(PROGRAMS scripts/up DESTINATION lib/arm)\n"


@pytest.mark.parametrize(
    ("files", "script", "is_there"),
    [
        ("('lib/arm', ['scripts/up'])", SCRIPT, True),
        ("('lib/arm/scripts', glob('scripts/*'))", SCRIPT, True),
        ("('lib/arm', ['scripts/up'])", SCRIPT.removeprefix("#!"), False),
        ("('share/arm', ['scripts/up'])", SCRIPT, False),
        ("('lib/armor', ['scripts/up'])", SCRIPT, False),
    ],
)
def test_programs_among_data_files(told, files: str, script: str, is_there: bool) -> None:  # type: ignore[no-untyped-def]
    """What setup.py copies to where programs lie, and may be run, is a program of the package."""
    old = {"arm/CMakeLists.txt": MAKE, "arm/scripts/up": SCRIPT}
    found = told(
        old, {"arm/CMakeLists.txt": None, "arm/setup.py": COPIED.format(files=files), "arm/scripts/up": script}
    )
    assert any(entry[0] == "executable" for entry in found) is not is_there
