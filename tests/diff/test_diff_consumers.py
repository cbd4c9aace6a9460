"""Consumers of Python and of headers whose end is announced."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write

from ecm_extract.cli.run import run

SETUP = "from setuptools import setup\nsetup(name='lib', packages=['lib', 'lib.actions'])\n"
NODE = "class Node:\n    def __init__(self, *, {name}, package=None, **kwargs):\n        pass\n"
HEIR = """from .node import Node
class LifecycleNode(Node):
    def __init__(self, *, namespace, **kwargs):
        pass
"""
LAUNCH = """from lib.actions import LifecycleNode, Node
import lib

def generate_launch_description():
    return [
        Node(
            package='arm',
            node_executable='arm'),
        Node(package='arm', executable='arm'),
        LifecycleNode(namespace='', node_executable='arm'),
        lib.actions.Node(node_executable='arm'),
        Other(node_executable='arm'),
    ]
"""


def findings(capsys: pytest.CaptureFixture[str], repo: Path, user: Path) -> list[dict[str, Any]]:
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json", "--no-cache"])
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["findings"]
    return found


def lines(found: list[dict[str, Any]], path: str) -> list[int]:
    return sorted(each["line"] for entry in found for each in entry["evidence"] if each["path"] == path)


@pytest.mark.parametrize("place", ["launch/arm.launch.py", "scripts/start.py"])
def test_an_argument_that_a_class_no_longer_takes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], place: str
) -> None:
    """Told on its own line: also of a class that hands it on, and by the module that offers the class."""
    repo, user = tmp_path / "lib", tmp_path / "user"
    same = {"setup.py": SETUP, "lib/__init__.py": "", "lib/actions/__init__.py": "from .node import Node\n"}
    for tag, name in (("1.0.0", "node_executable"), ("2.0.0", "executable")):
        files = {"package.xml": package("lib", tag), **same, "lib/actions/heir.py": HEIR}
        release(repo, {**files, "lib/actions/node.py": NODE.format(name=name)}, tag)
    write(user, {"package.xml": package("user"), place: LAUNCH})
    assert lines(findings(capsys, repo, user), place) == [8, 10, 11]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#include <lib/old.h>\n", [1]),
        ("#include <lib/old.hpp>\n", []),
        ("#if __has_include(<lib/old.hpp>)\n#include <lib/old.hpp>\n#else\n#include <lib/old.h>\n#endif\n", []),
    ],
)
@pytest.mark.parametrize("severity", ["info", "error"])
def test_includes_of_what_goes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, expected: list[int], severity: str
) -> None:
    """A header that is going is told as information, one that is gone as an error; who asks for both is ready."""
    repo, user = tmp_path / "lib", tmp_path / "user"
    old = {"include/lib/old.h": "#pragma once\n", "include/lib/old.hpp": "#pragma once\n"}
    end = None if severity == "error" else '#pragma once\n#warning "deprecated, use lib/old.hpp"\n'
    release(repo, {"package.xml": package("lib"), **old}, "1.0.0")
    release(repo, {"package.xml": package("lib", "2.0.0"), "include/lib/old.h": end}, "2.0.0")
    write(user, {"package.xml": package("user"), "src/a.cpp": text})
    found = findings(capsys, repo, user)
    assert lines(found, "src/a.cpp") == expected
    assert {entry["severity"] for entry in found} == ({severity} if expected else set())


BOX = "#pragma once\nnamespace lib {{\nclass {name} {{ public: int size; }};\n{rest}\n}}\n"
CPP = """#include <lib/box.hpp>
// lib::OldBox in a comment
lib::OldBox box;
std::string text = "lib::OldBox";
void use() {
  lib::lock(text);
  lib::lock();
  lib::OldBoxes boxes;
}
"""


def test_names_with_their_namespace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A class that is gone where it is named, a function given more than it takes; no comments, no texts."""
    repo, user = tmp_path / "lib", tmp_path / "user"
    rest = "class OldBoxes {}; int lock(const std::string & why);"
    after = "class OldBoxes {}; int lock();"
    for tag, text in (("1.0.0", BOX.format(name="OldBox", rest=rest)), ("2.0.0", BOX.format(name="Crate", rest=after))):
        release(repo, {"package.xml": package("lib", tag), "include/lib/box.hpp": text}, tag)
    write(user, {"package.xml": package("user"), "src/a.cpp": CPP})
    assert lines(findings(capsys, repo, user), "src/a.cpp") == [3, 6]


def test_a_parameter_that_is_read_is_still_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A node that declares what it is given reads parameters without declaring them."""
    repo, user = tmp_path / "arm", tmp_path / "user"
    make = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION x)\n"
    for tag, lines_of in (
        ("1.0.0", ['declare_parameter("rate", 1);', 'declare_parameter("gain", 1);']),
        ("2.0.0", ['get_parameter("rate", rate_);']),
    ):
        release(repo, {"package.xml": package("arm", tag), "CMakeLists.txt": make, "src/arm.cpp": node(*lines_of)}, tag)
    text = "arm:\n  ros__parameters:\n    rate: 2\n    gain: 3\n"
    write(user, {"package.xml": package("user"), "param/arm.yaml": text})
    assert lines(findings(capsys, repo, user), "param/arm.yaml") == [4]


HANDLE = """#include <ros/ros.h>
class Part {{ public: void init(ros::NodeHandle & nh, const std::string & name) {{
  ros::NodeHandle own(nh, name); {line} }} }};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "arm"); ros::NodeHandle nh; Part part; part.init(nh, argv[1]); }}
"""
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")


@pytest.mark.parametrize(("path", "forgotten"), [("config/new.yaml", False), ("config/arm.yaml", True)])
def test_a_file_that_came_with_a_release_forgets_no_computed_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], path: str, forgotten: bool
) -> None:
    """Who wrote it meant what is there now; one that was there before may have been forgotten."""
    repo = tmp_path / "arm"
    make = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION x)\n"
    launch = f'<launch><rosparam command="load" file="$(find arm)/{path}"/></launch>\n'
    files = {"package.xml": ROS1, "CMakeLists.txt": make, "launch/a.launch": launch}
    values, code = {path: "part:\n  rate: 2\n"}, HANDLE.format(line='own.param("rate", r_, 1);')
    release(repo, {**files, "src/arm.cpp": code, **(values if forgotten else {})}, "1.0.0")
    release(repo, {"src/arm.cpp": HANDLE.format(line=""), **values}, "2.0.0")
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--format", "json", "--no-cache"])
    found = json.loads(capsys.readouterr().out)
    changes = [(each["change"], each["old"]) for each in found["changes"] if each["kind"] == "parameter"]
    assert changes == [("removed", "/<*>/rate")]
    assert bool(lines(found["findings"], path)) is forgotten


@pytest.mark.parametrize(("word", "expected"), [("", [3]), ("virtual ", [])])
def test_who_overrides_what_is_no_longer_virtual(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], word: str, expected: list[int]
) -> None:
    """Told on the line of the overriding method; a form of other parameters that stays so breaks nobody."""
    repo, user = tmp_path / "lib", tmp_path / "user"
    for tag, before in (("1.0.0", "virtual "), ("2.0.0", word)):
        base = f"class Base {{ public: {before}void start(int id); virtual void start(bool b); {before}void stop(); }};"
        header = f"#pragma once\nnamespace lib {{\n{base}\n}}\n"
        release(repo, {"package.xml": package("lib", tag), "include/lib/base.hpp": header}, tag)
    heir = (
        "#include <lib/base.hpp>\nclass Heir : public lib::Base {\n"
        "  void start(int id) override;\n  void start(bool b) override;\n};\n"
    )
    write(user, {"package.xml": package("user"), "src/a.cpp": heir})
    assert lines(findings(capsys, repo, user), "src/a.cpp") == expected
