"""LNT036: what libraries have deprecated is told where it is used, and not where somebody speaks of it."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

from ecm_extract.lint.deprecations import deprecations

CPP, PYTHON, LAUNCH, BUILD = "src/a.cpp", "scripts/a.py", "launch/a.launch", "CMakeLists.txt"
MAIN = "int main() {{ {} }}\n"
SCRIPT = "#!/usr/bin/env python3\n{}\n"
PROJECT = "cmake_minimum_required(VERSION 3.5)\nproject(pkg)\nfind_package(ament_cmake REQUIRED)\n{}\nament_package()\n"

USES = [
    (1, LAUNCH, '<launch><param name="d" command="$(find xacro)/xacro.py a.xacro"/></launch>'),
    (1, LAUNCH, '<launch><group><node pkg="xacro" type="xacro.py" name="a"/></group></launch>'),
    (1, LAUNCH, '<launch><node type="state_publisher" name="a" pkg="robot_state_publisher"/></launch>'),
    (1, CPP, "PLUGINLIB_DECLARE_CLASS(a, b, c::D, e::F)\n"),
    (1, CPP, "PLUGINLIB_REGISTER_CLASS(a, b::C, d::E)\n"),
    (1, CPP, MAIN.format("std::string a = (*message->__connection_header)[name];")),
    (1, CPP, MAIN.format("auto a = boost::shared_dynamic_cast<A>(b);")),
    (1, CPP, MAIN.format("auto a = boost::shared_static_cast<A>(b);")),
    (1, CPP, MAIN.format('auto a = sdf->GetElement("a")->GetValueString();')),
    (1, CPP, '#include "moveit/move_group_interface/move_group.h"\n'),
    (2, CPP, "#  include <pluginlib/class_loader.h>\n"),
    (2, CPP, "#include <tf2_eigen/tf2_eigen.h>\n"),
    (2, PYTHON, SCRIPT.format("Node(package='a', node_executable='b')")),
    (2, BUILD, PROJECT.format("ROSIDL_TARGET_INTERFACES(a ${PROJECT_NAME} b)")),
    (2, BUILD, PROJECT.format("if(A) # why\n  ament_export_interfaces(a)\nendif()")),
]
SAID = [
    (1, LAUNCH, '<launch><!-- <node pkg="xacro" type="xacro.py" name="a"/> --><arg name="xacro.py"/></launch>'),
    (1, CPP, MAIN.format('say("boost::shared_static_cast<A>");  // boost::shared_dynamic_cast')),
    (1, CPP, MAIN.format('say(".GetValueString()");')),
    (1, CPP, '/*\n#include "moveit/move_group_interface/move_group.h"\n*/\n'),
    (2, CPP, 'auto a = R"(\n#include <tf2_eigen/tf2_eigen.h>\n)";\n'),
    (2, CPP, "#if 0\n#include <tf2_eigen/tf2_eigen.h>\n#endif\n"),
    (2, PYTHON, SCRIPT.format("node_executable = 'a'\nprint('node_executable=')")),
    (2, BUILD, PROJECT.format("#[[\nament_export_interfaces(a)\n]]")),
]


def told(workspace: Workspace, ros: int, path: str, text: str) -> int:
    build = {} if path == BUILD else {BUILD: PROJECT.format("add_executable(a src/a.cpp)")}
    workspace.package({**build, path: text}, ros=ros)
    return sum(finding.rule == "LNT036" for finding in lint(workspace.root))


@pytest.mark.parametrize(("ros", "path", "text"), USES)
def test_a_use_is_told(workspace: Workspace, ros: int, path: str, text: str) -> None:
    assert told(workspace, ros, path, text) == 1


@pytest.mark.parametrize(("sources", "severity"), [("src/a.cpp", "warning"), ("src/b.cpp", "info")])
def test_a_use_that_no_target_builds_is_an_info(workspace: Workspace, sources: str, severity: str) -> None:
    """Nothing stops there: what is compiled has no such use."""
    use = MAIN.format("auto a = boost::shared_static_cast<A>(b);")
    build = {BUILD: PROJECT.format(f"add_executable(a {sources})")}
    workspace.package({**build, CPP: use, "src/b.cpp": MAIN.format("")}, ros=1)
    assert [each.severity for each in lint(workspace.root) if each.rule == "LNT036"] == [severity]


@pytest.mark.parametrize(("ros", "path", "text"), SAID)
def test_what_is_only_said_is_no_use(workspace: Workspace, ros: int, path: str, text: str) -> None:
    """Comments, texts, and code that no build compiles."""
    assert told(workspace, ros, path, text) == 0


def test_every_row_of_the_table_is_tried() -> None:
    """A name that no fact of these files has is a row that can never be told."""
    texts = "".join(text for _, _, text in USES).lower()
    assert [row.old for row in deprecations().use if not any(_last(name) in texts for name in row.names)] == []


def _last(name: str) -> str:
    return name.rpartition("/")[2].lower()
