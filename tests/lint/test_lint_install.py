"""What install rules leave out, misplace, or name in vain (LNT043, LNT057 to LNT060)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

HEAD = {
    1: "project(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package()\n",
    2: "project(pkg)\nfind_package(ament_cmake REQUIRED)\nament_package()\n",
}
LIB, BIN = "LIBRARY DESTINATION lib", "RUNTIME DESTINATION lib/pkg"
INCLUDE = "${CATKIN_PACKAGE_INCLUDE_DESTINATION}"
PROGRAMS = "${CATKIN_PACKAGE_BIN_DESTINATION}"
LAUNCH_FILE = """from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription([])
"""
BUILT = "add_executable(run a.cpp)\n"
CHAIN = """add_library(core SHARED a.cpp)
add_library(part a.cpp)
target_link_libraries(part PUBLIC core)
target_link_libraries(run part)
"""
MACHINE = """execute_process(COMMAND uname -m OUTPUT_VARIABLE machine)
if(${{machine}} MATCHES "arm")
set(where {})
else()
set(where {})
endif()
"""
CHOSEN = "install(FILES include/${where}/core.h DESTINATION share)\n"
ROWS = [
    (1, f"{BUILT}add_library(core a.cpp)\ntarget_link_libraries(run core)\ninstall(TARGETS run {BIN})", ["LNT057"]),
    (1, f"{BUILT}add_library(core STATIC a.cpp)\ntarget_link_libraries(run core)\ninstall(TARGETS run {BIN})", []),
    (1, f"{BUILT}add_library(core a.cpp)\ninstall(TARGETS run {BIN})", []),
    (1, f"{BUILT}add_library(core a.cpp)\ntarget_link_libraries(run core)\ninstall(TARGETS run core {BIN})", []),
    (2, f"{BUILT}add_library(core a.cpp)\ntarget_link_libraries(run core)\ninstall(TARGETS run {BIN})", []),
    (2, f"{BUILT}{CHAIN}install(TARGETS run {BIN})", ["LNT057"]),
    (1, f"install(DIRECTORY include/ DESTINATION {INCLUDE})", ["LNT058"]),
    (1, f"install(DIRECTORY include DESTINATION {INCLUDE})", ["LNT058"]),
    (1, f"install(DIRECTORY include/pkg DESTINATION {INCLUDE})", ["LNT058"]),
    (1, f"install(DIRECTORY include/pkg/ DESTINATION {INCLUDE})", []),
    (1, f"install(DIRECTORY include/${{PROJECT_NAME}}/ DESTINATION {INCLUDE})", []),
    (1, f"install(FILES include/pkg/core.h DESTINATION {INCLUDE})", []),
    (1, "install(DIRECTORY include/ DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})", []),
    (2, "install(DIRECTORY include/ DESTINATION include/${PROJECT_NAME})", []),
    (2, "install(DIRECTORY include/ DESTINATION include)", []),
    (2, "install(DIRECTORY include DESTINATION include/../)", []),
    (1, "install(DIRECTORY include DESTINATION .)", []),
    (1, f"install(DIRECTORY include DESTINATION {INCLUDE}/..)", ["LNT058"]),
    (1, "install(DIRECTORY config DESTINATION share)", ["LNT059"]),
    (1, "install(DIRECTORY config DESTINATION share OPTIONAL)", []),
    (1, "if(EXISTS config)\ninstall(DIRECTORY config DESTINATION share)\nendif()", []),
    (1, "configure_file(a.in config)\ninstall(FILES config DESTINATION share)", []),
    (1, "foreach(dir include)\ninstall(DIRECTORY ${dir}/pkg/ DESTINATION include/pkg)\nendforeach()", []),
    (1, "foreach(config include)\ninstall(DIRECTORY ${dir}/ DESTINATION share/${dir})\nendforeach(dir)", ["LNT059"]),
    (1, MACHINE.format("pkg", "arm") + CHOSEN, []),
    (1, MACHINE.format("x64", "arm") + CHOSEN, ["LNT059"]),
    (1, f"foreach(where pkg arm)\n{CHOSEN}endforeach()", ["LNT059"]),
    (1, "install(FILES a.cpp DESTINATION ${CATKIN_PACAKGE_SHARE_DESTINATION})", ["LNT059"]),
    (1, "install(FILES a.cpp DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})", []),
    (1, "include_directories(include ${caktin_INCLUDE_DIRS})", ["LNT059"]),
    (1, "set(caktin_INCLUDE_DIRS .)\ninclude_directories(include ${caktin_INCLUDE_DIRS})", []),
    (1, "include_directories(include ${catkin_INCLUDE_DIRS})", []),
    (1, "add_subdirectory(part)\ncatkin_package(INCLUDE_DIRS include)", []),
    (1, f"install(DIRECTORY scripts/ DESTINATION {PROGRAMS})", ["LNT060"]),
    (1, f"install(DIRECTORY scripts/ DESTINATION {PROGRAMS} USE_SOURCE_PERMISSIONS)", []),
    (1, f"install(FILES scripts/talk.py DESTINATION {PROGRAMS})", ["LNT060"]),
    (1, f"install(PROGRAMS scripts/talk.py DESTINATION {PROGRAMS})", []),
    (1, f"catkin_install_python(PROGRAMS scripts/talk.py DESTINATION {PROGRAMS})", []),
    (1, "install(DIRECTORY scripts/ DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/scripts)", []),
    (2, "install(FILES scripts/talk.py DESTINATION lib/${PROJECT_NAME})", ["LNT060"]),
]


@pytest.mark.parametrize(("ros", "text", "expected"), ROWS)
def test_install_rules(workspace: Workspace, ros: int, text: str, expected: list[str]) -> None:
    """A rule is judged by where its files come to lie, and by who needs them there."""
    files = {
        "CMakeLists.txt": HEAD[ros] + text + "\n",
        "a.cpp": "int main() {}\n",
        "include/pkg/core.h": "#pragma once\n",
        "scripts/talk.py": "#!/usr/bin/env python3\n",
    }
    found = [finding.rule for finding in lint(workspace.package(files, ros=ros).root)]
    assert [rule for rule in found if "LNT057" <= rule <= "LNT060"] == expected


OPEN = "execute_process(COMMAND where OUTPUT_VARIABLE PLACE)\n"
OPEN_ROWS = [
    ("install(PROGRAMS ${PLACE}/run DESTINATION lib/pkg)", True),
    ("install(TARGETS ${PLACE} DESTINATION lib/pkg)", True),
    ("install(DIRECTORY maps/${PLACE} DESTINATION share/pkg)", True),
    ("install(DIRECTORY ${PLACE}/maps DESTINATION share/pkg)", True),
    ("install(FILES ${PLACE}.yaml DESTINATION share/pkg)", True),
    ("install(DIRECTORY ${PLACE} DESTINATION include)", True),
    ("install(DIRECTORY ${PLACE} DESTINATION share/pkg)", False),
    ("install(DIRECTORY ${PLACE} DESTINATION ${PLACE})", False),
    ("install(DIRECTORY ${PLACE}/launch DESTINATION share/pkg)", False),
    ("install(DIRECTORY lau${PLACE} DESTINATION share/pkg)", False),
    ("install(FILES launch/${PLACE}.launch.py DESTINATION share/pkg)", False),
]


@pytest.mark.parametrize(("rule", "told"), OPEN_ROWS)
def test_a_rule_with_a_name_that_only_cmake_knows(workspace: Workspace, rule: str, told: bool) -> None:
    """LNT043: it leaves open what it may install, and nothing else."""
    files = {"CMakeLists.txt": f"{HEAD[2]}{OPEN}{rule}\n", "launch/a.launch.py": LAUNCH_FILE}
    found = [finding.rule for finding in lint(workspace.package(files, ros=2).root)]
    assert ("LNT043" in found) is told


@pytest.mark.parametrize(
    ("source", "told"), [("src/run.cpp", True), ("test/run.cpp", False), ("src/run_test.cpp", False)]
)
def test_programs_that_are_test_code(workspace: Workspace, source: str, told: bool) -> None:
    """LNT043: what is built of test code alone stays beside the sources, also where a launch file starts it."""
    files = {
        "CMakeLists.txt": f"{HEAD[2]}add_executable(run {source})\ninstall(DIRECTORY launch DESTINATION share/pkg)\n",
        source: "int main() {}\n",
        "launch/a.launch.xml": '<launch><node pkg="pkg" exec="run"/></launch>\n',
    }
    found = [finding.rule for finding in lint(workspace.package(files, ros=2).root)]
    assert ("LNT043" in found) is told


OLD = '<launch><node pkg="pkg" type="run" name="run" output="screen"/></launch>\n'


@pytest.mark.parametrize(
    ("path", "text", "told"),
    [
        ("launch/a.launch.py", LAUNCH_FILE, True),
        ("launch/a_test.launch.py", LAUNCH_FILE, False),
        ("launch/test_a.launch.py", LAUNCH_FILE, False),
        ("launch/a.launch", OLD, False),
    ],
)
def test_launch_files_that_nobody_misses(workspace: Workspace, path: str, text: str, told: bool) -> None:
    """LNT043: those for a trial beside the sources, and those of ROS 1 in a package of ROS 2."""
    files = {"CMakeLists.txt": f"{HEAD[2]}install(DIRECTORY maps DESTINATION share/pkg)\n", path: text}
    found = [finding.rule for finding in lint(workspace.package(files, ros=2).root)]
    assert ("LNT043" in found) is told


@pytest.mark.parametrize(("ros", "told"), [(1, True), (2, False)])
def test_files_that_launch_files_of_ros_1_name(workspace: Workspace, ros: int, told: bool) -> None:
    """LNT043: in a package of ROS 2 nothing loads them."""
    start = '<node pkg="rviz" type="rviz" name="rviz" output="screen" args="-d $(find pkg)/rviz/a.rviz"/>'
    share = {1: "${CATKIN_PACKAGE_SHARE_DESTINATION}", 2: "share/pkg"}[ros]
    files = {
        "CMakeLists.txt": f"{HEAD[ros]}install(DIRECTORY launch DESTINATION {share})\n",
        "launch/a.launch": f"<launch>{start}</launch>\n",
        "rviz/a.rviz": "Panels: []\n",
    }
    found = [finding.rule for finding in lint(workspace.package(files, ros=ros).root)]
    assert ("LNT043" in found) is told


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"])
def test_a_folder_of_a_package_with_a_marker(workspace: Workspace, marker: str) -> None:
    """LNT059: a marker hides packages from the build tool, and no files from the install rules around it."""
    text = HEAD[2] + "install(PROGRAMS scripts/talk.py scripts/gone.py DESTINATION lib/${PROJECT_NAME})\n"
    files = {"CMakeLists.txt": text, f"scripts/{marker}": "", "scripts/talk.py": "#!/usr/bin/env python3\n"}
    found = [finding for finding in lint(workspace.package(files, ros=2).root) if finding.rule == "LNT059"]
    assert [finding.message.split(":")[0] for finding in found] == ["pkg installs scripts/gone.py, which is not there"]


def test_a_header_that_another_package_includes(workspace: Workspace) -> None:
    """Nobody misses a header that stays private."""
    installs = HEAD[1] + "install(FILES a.txt DESTINATION share/pkg)\n"
    build = {"CMakeLists.txt": installs, "include/pkg/core.h": "#pragma once\n", "a.cpp": "int a;\n"}
    workspace.package(build, ros=1)
    assert "LNT058" not in [finding.rule for finding in lint(workspace.root)]
    workspace.package({"b.cpp": "#include <pkg/core.h>\n", "CMakeLists.txt": "project(user)\n"}, ros=1, name="user")
    assert "LNT058" in [finding.rule for finding in lint(workspace.root)]


@pytest.mark.parametrize(
    ("named", "installed", "expected"),
    [
        ("$(find pkg)/maps/home.yaml", "launch", True),
        ("$(find pkg)/maps/home.yaml", "launch maps", False),
        ("$(find pkg)/maps/other.yaml", "launch", False),
        ("$(find other)/maps/home.yaml", "launch", False),
        ("package://pkg/maps/home.yaml", "launch", True),
    ],
)
def test_a_file_that_a_launch_file_names(workspace: Workspace, named: str, installed: str, expected: bool) -> None:
    """A launch that is installed looks for its files beside it."""
    files = {
        "CMakeLists.txt": HEAD[1] + f"install(DIRECTORY {installed} DESTINATION share/pkg)\n",
        "launch/a.launch": f'<launch><param name="map" value="{named}"/></launch>',
        "maps/home.yaml": "a: 1\n",
    }
    found = [finding.rule for finding in lint(workspace.package(files, ros=1).root)]
    assert ("LNT043" in found) is expected


def test_an_exported_folder_is_there(workspace: Workspace) -> None:
    """catkin_package refuses a folder of headers that the package does not have."""
    workspace.package({"CMakeLists.txt": "project(pkg)\ncatkin_package(INCLUDE_DIRS include)\n"}, ros=1)
    assert "LNT059" in [finding.rule for finding in lint(workspace.root)]


@pytest.mark.parametrize(
    ("installed", "expected"), [("", True), ("install(FILES plugins.xml DESTINATION share/pkg)\n", False)]
)
def test_an_exported_plugin_description(workspace: Workspace, installed: str, expected: bool) -> None:
    """A loader reads the description where package.xml says that it is installed."""
    files = {
        "CMakeLists.txt": HEAD[1] + "catkin_python_setup()\nadd_library(pkg a.cpp)\n" + installed,
        "plugins.xml": '<library path="libpkg"><class type="pkg::A" base_class_type="core::B"/></library>',
        "setup.py": "from distutils.core import setup\nsetup(packages=['pkg'])\n",
    }
    workspace.package(files, ros=1)
    manifest = workspace.root / "pkg" / "package.xml"
    export = '<export><core plugin="${prefix}/plugins.xml"/></export></package>'
    manifest.write_text(manifest.read_text("utf-8").replace("</package>", export), "utf-8")
    assert ("LNT043" in [finding.rule for finding in lint(workspace.root)]) is expected
