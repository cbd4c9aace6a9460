"""Consumers whose files are kept for a distribution, and C++ that takes a result twice."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write

from ecm_extract.cli.run import run
from ecm_extract.requires.kept import kept_for

YAML = "arm:\n  ros__parameters:\n    {name}: fine\n"
CLIENT = """#pragma once
namespace lib {{
class Client {{
public:
  {returns} send(Request request);
  {returns} poll(Request request);
}};
}}
"""
USER = """#include <lib/client.hpp>
void once(lib::Client * client, lib::Request request) {
  auto answer = client->send(request);
  answer.get();
}
void twice(lib::Client * client, lib::Request request) {
  auto answer = client->send(request);
  if (answer.get()) {
    use(answer.get()->state);
  }
}
"""


def findings(capsys: pytest.CaptureFixture[str], repo: Path, user: Path) -> list[dict[str, Any]]:
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json"])
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["findings"]
    return found


@pytest.mark.parametrize(
    ("path", "distribution"),
    [
        ("a/param/humble/arm.yaml", "humble"),
        ("a/param/Humble/arm.yaml", "humble"),
        ("a/param/arm.yaml", ""),
        ("a/param/iron/arm.yaml", "iron"),
        ("a/param/left/arm.yaml", ""),
        ("a/param/humble/leg.yaml", ""),
        ("humble", ""),
    ],
)
def test_a_file_is_kept_for_a_distribution_when_there_is_one_beside_it(path: str, distribution: str) -> None:
    """Only where another file of the name is there for the others."""
    assert kept_for(path, {"a/param/arm.yaml", path}) == distribution


@pytest.mark.parametrize(("current", "severity"), [("tool", "error"), ("gripper", "info")])
def test_a_file_kept_for_an_older_distribution_is_no_break(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], current: str, severity: str
) -> None:
    """The file that the launch picks today decides; the kept one is told beside it."""
    make = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION x)\n"
    for tag, name in (("1.0.0", "tool"), ("2.0.0", "gripper")):
        files = {"package.xml": package("arm", tag), "CMakeLists.txt": make}
        release(tmp_path / "arm", {**files, "src/arm.cpp": node(f'declare_parameter("{name}", "x");')}, tag)
    user = tmp_path / "user"
    write(user, {"package.xml": package("user"), "param/humble/arm.yaml": YAML.format(name="tool")})
    write(user, {"param/arm.yaml": YAML.format(name=current)})
    (found,) = findings(capsys, tmp_path / "arm", user)
    assert (found["rule"], found["severity"]) == ("VER001", severity)
    assert ("kept for humble" in found["message"]) is (severity == "info")
    assert found["evidence"][0]["path"] == ("param/arm.yaml" if severity == "error" else "param/humble/arm.yaml")


@pytest.mark.parametrize(
    ("before", "after", "lines"),
    [
        ("std::shared_future<Response>", "std::future<Response>", [9]),
        ("SharedFuture", "FutureAndRequestId", [9]),
        ("SharedFuture", "SharedFutureAndRequestId", []),
        ("std::future<Response>", "std::shared_future<Response>", []),
    ],
)
def test_a_result_that_is_no_longer_shared_cannot_be_taken_twice(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], before: str, after: str, lines: list[int]
) -> None:
    """Who takes it once builds and runs unchanged, and is left alone."""
    install = "project(lib)\ninstall(DIRECTORY include/ DESTINATION include)\n"
    for tag, returns in (("1.0.0", before), ("2.0.0", after)):
        files = {"package.xml": package("lib", tag), "CMakeLists.txt": install}
        release(tmp_path / "lib", {**files, "include/lib/client.hpp": CLIENT.format(returns=returns)}, tag)
    write(tmp_path / "user", {"package.xml": package("user"), "src/user.cpp": USER})
    found = findings(capsys, tmp_path / "lib", tmp_path / "user")
    assert [entry["evidence"][0]["line"] for entry in found] == lines
    assert all(entry["severity"] == "warning" for entry in found)


LISTENER = """import rclpy
from rclpy.node import Node
from lib_msgs.msg import Outer, Other
class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.create_subscription(Outer, 'outer', print, 10)
        self.create_subscription(Other, 'other', print, 10)
def main():
    rclpy.spin(Listener())
"""


@pytest.mark.parametrize(
    ("inner", "outer", "told"),
    [
        ("float64 x\nfloat64 y\n", "Inner[] parts\n", ["message lib_msgs/msg/Outer"]),
        ("float64 x\n", "Inner[] parts\nbool last\n", ["message field last of lib_msgs/msg/Outer"]),
        ("float64 x\n", "Inner[] parts\n", []),
        ("float64 x\n# a remark\n", "Inner[] parts\n", []),
    ],
    ids=["nested", "own", "same", "remark"],
)
def test_endpoints_of_a_type_with_another_layout_must_be_built_anew(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], inner: str, outer: str, told: list[str]
) -> None:
    """Of the two subscriptions the one is told, with the type that carries the change; a new build is all it takes."""
    for tag, one, two in (("1.0.0", "float64 x\n", "Inner[] parts\n"), ("2.0.0", inner, outer)):
        files = {"package.xml": package("lib_msgs", tag), "msg/Inner.msg": one, "msg/Outer.msg": two}
        release(tmp_path / "lib_msgs", {**files, "msg/Other.msg": "bool on\n"}, tag)
    setup = "from setuptools import setup\nsetup(entry_points={'console_scripts': ['listen = user.listen:main']})\n"
    write(tmp_path / "user", {"package.xml": package("user"), "setup.py": setup, "user/listen.py": LISTENER})
    found = findings(capsys, tmp_path / "lib_msgs", tmp_path / "user")
    assert [entry["message"].split(" in lib_msgs")[0] for entry in found] == told
    assert all((entry["severity"], entry["evidence"][0]["line"]) == ("info", 7) for entry in found)
    assert all("built anew" in entry["message"] for entry in found)


PLANNER = '''"""Plans."""


def limits(joint):
    """Limits of a joint."""
    return {limits}


class Group:
    """A group of joints."""

    def plan(self, goal):
        """A way to a goal."""
        if goal is None:
            return {empty}
        return {found}

    def both(self):
        """Not known."""
        return self.plan(None)

    def stop(self):
        """What is left."""
        rest = Plan()
        return {rest}
'''
READER = """from lib.planner import Group, limits


def old():
    least, greatest = limits("elbow")
    found, path = Group().plan(least)
    rest = Group().stop()
    rest.execute()
    return found, path, greatest


def new():
    least, greatest, velocity = limits("elbow")
    found, path, seconds = Group().plan(least)
    both = Group().both()
    left = Group().stop()
    left[0].execute()
    return found, path, greatest, velocity, seconds, both
"""


def test_python_that_unpacks_what_is_another_number_of_values_now(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Functions by import and methods by name, one object that became several; who follows already is quiet."""
    repo, user = tmp_path / "lib", tmp_path / "user"
    setup = {"setup.py": "from setuptools import setup\nsetup(name='lib', packages=['lib'])\n", "lib/__init__.py": ""}
    before = PLANNER.format(limits="0, 1", empty="False, None", found="True, [goal]", rest="rest")
    after = PLANNER.format(limits="0, 1, 2", empty="False, None, 0", found="True, [goal], 1", rest="rest, True")
    for tag, text in (("1.0.0", before), ("2.0.0", after)):
        release(repo, {"package.xml": package("lib", tag), **setup, "lib/planner.py": text}, tag)
    write(user, {"package.xml": package("user"), "scripts/reader.py": READER})
    found = {(entry["evidence"][0]["line"], entry["certainty"]) for entry in findings(capsys, repo, user)}
    assert found == {(5, "proved"), (6, "likely"), (7, "likely")}
