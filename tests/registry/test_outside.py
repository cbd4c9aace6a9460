"""What is outside of a tree becomes known by a registry: for lint, and for check."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from sample import manifest, packages, published, write

from ecm_extract.cli.run import run
from ecm_extract.registry.store import Registry

_CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${{PROJECT_NAME}} {files})
ament_package()
"""
_NODE = """import rclpy
from rclpy.node import Node
from arm_msgs.msg import {message}


class Arm(Node):
    def __init__(self):
        super().__init__("arm")
        self.publisher = self.create_publisher({message}, "grip", 10)


def main():
    rclpy.init()
    rclpy.spin(Arm())
"""
_SETUP = """from setuptools import setup
setup(name="arm", packages=["arm"], entry_points={"console_scripts": ["arm = arm.main:main"]})
"""


def messages(version: str, *names: str) -> dict[str, str]:
    """An interface package."""
    files = {f"arm_msgs/msg/{name}.msg": "float64 force\n" for name in names}
    cmake = _CMAKE.format(name="arm_msgs", files=" ".join(f'"msg/{name}.msg"' for name in names))
    return {"arm_msgs/package.xml": manifest("arm_msgs", version), "arm_msgs/CMakeLists.txt": cmake, **files}


def arm(message: str) -> dict[str, str]:
    """A package that needs a message of it."""
    return {
        "arm/package.xml": manifest("arm", "1.0.0", {"rclpy": "", "arm_msgs": ""}),
        "arm/setup.py": _SETUP,
        "arm/arm/__init__.py": "",
        "arm/arm/main.py": _NODE.format(message=message),
    }


@pytest.fixture
def url(tmp_path: Path, made_file: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A registry with two releases of the messages; the newest lost one."""
    monkeypatch.delenv("ECM_REGISTRY", raising=False)
    found = str(shutil.copy(made_file, tmp_path / "registry.sqlite"))
    with Registry(found) as registry:
        published(registry, packages(tmp_path / "a", messages("1.0.0", "Grip", "Slip")))
        published(registry, packages(tmp_path / "b", messages("2.0.0", "Grip")))
    return found


def _findings(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[str]]:
    capsys.readouterr()
    status = run([*words, "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    return status, [each["message"] for each in found if each["rule"] == "SIG014"]


@pytest.mark.parametrize("command", [("lint",), ("check", "--no-cache")])
@pytest.mark.parametrize("named", ["option", "environment"])
def test_what_was_unknown_is_missing(
    tmp_path: Path,
    url: str,
    command: tuple[str, ...],
    named: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Without a registry nothing is said of it; with one the line that needs it is told, and status 1."""
    tree = str(write(tmp_path / "ws", arm("Slip")))
    assert _findings(capsys, *command, tree) == (0, [])
    if named == "environment":
        monkeypatch.setenv("ECM_REGISTRY", url)
    status, found = _findings(capsys, *command, tree, *(["--registry", url] if named == "option" else []))
    assert status == 1
    assert len(found) == 1
    assert "arm/arm/main.py" in found[0]
    assert "Slip" in found[0]


@pytest.mark.parametrize("command", [("lint",), ("check", "--no-cache")])
def test_what_was_unknown_is_met(
    tmp_path: Path, url: str, command: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    """And what nobody has stored stays unknown, which is said."""
    tree = str(write(tmp_path / "ws", arm("Grip")))
    assert _findings(capsys, *command, tree, "--registry", url) == (0, [])
    run([*command, tree, "--registry", url])
    told = capsys.readouterr().err
    assert "known from the registry: 1 packages (the newest release of each package)" in told
    assert "not in the registry, so nothing is known of them: rclpy" in told


def test_a_robot_has_the_release_that_it_runs(tmp_path: Path, url: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The old release provides what the newest does not."""
    tree = str(write(tmp_path / "ws", arm("Slip")))
    assert run(["registry", "record", "robot_7", "arm_msgs@1.0.0", "--registry", url]) == 0
    assert _findings(capsys, "lint", tree, "--registry", url, "--environment", "robot_7") == (0, [])


def test_lines_are_those_of_the_tree(tmp_path: Path, url: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A finding never points at a file of somebody else's tree as if it were here."""
    tree = str(write(tmp_path / "ws", arm("Slip")))
    run(["lint", tree, "--registry", url, "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    paths = {at["path"] for each in found if each["rule"] == "SIG014" for at in each["evidence"]}
    assert paths
    assert all((Path(tree) / path).is_file() for path in paths)


def test_a_rule_that_cannot_ask_is_no_all_clear(tmp_path: Path, url: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Asked for alone and without a registry it would find nothing; a registry that is not there is told."""
    tree = str(write(tmp_path / "ws", arm("Slip")))
    assert run(["lint", tree, "--select", "SIG014"]) == 2
    assert run(["lint", tree, "--select", "SIG014", "--registry", url]) == 1
    assert run(["lint", tree, "--registry", str(tmp_path / "none.sqlite")]) == 2
    assert "there is no registry" in capsys.readouterr().err
    assert run(["check", "compose", tree, "--registry", url]) == 2
