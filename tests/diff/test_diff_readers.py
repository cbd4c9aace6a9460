"""Who breaks by a release, line by line: consumers, remaps, launch files, and the package itself."""

from __future__ import annotations

from pathlib import Path

import pytest
from diff_repos import package, release, write
from released_arm import CONSUMER, FIXED, document


def test_consumers_break_on_their_own_lines(repo: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each broken use is VER001 at the consumer's line, with the new name in the resolution."""
    write(tmp_path / "ws", dict(CONSUMER))
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws")
    places = {(f["evidence"][0]["path"], f["evidence"][0]["line"]) for f in found["findings"]}
    assert places == {
        ("user/config/arm.yaml", 3),
        ("user/user/watch.py", 10),
        ("user/user/watch.py", 5),
        ("user/user/watch.py", 14),
        ("user/src/my_driver.cpp", 4),
    }
    assert {f["rule"] for f in found["findings"]} == {"VER001"}
    assert set(found["findings"][0]["evidence"][0]) == {"path", "line", "end_line", "commit"}
    parameter = next(f for f in found["findings"] if "yaml" in f["evidence"][0]["path"])
    assert "checker_plugins" in parameter["resolution"]


def test_one_cause_is_one_finding_with_all_readers(
    repo: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The field that is written and filled by keyword is one finding with two lines."""
    write(tmp_path / "ws", dict(CONSUMER))
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws")
    field = [f for f in found["findings"] if "force" in f["message"]]
    lines = [e["line"] for f in field for e in f["evidence"] if e["path"] == "user/user/watch.py"]
    assert sorted(lines) == [14, 15]
    assert len({f["fingerprint"] for f in field}) == 1


def test_a_consumer_that_follows_is_quiet(repo: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """New names and the new signature of an overridden method raise nothing."""
    write(tmp_path / "ws", dict(FIXED))
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws")
    assert found["findings"] == []


def test_old_scripts_of_the_provider_are_consumers(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A script that the release forgot breaks as well."""
    script = CONSUMER["user/user/watch.py"].replace("from arm_msgs.srv import Go\n", "")
    release(repo, {"arm/scripts/watch": "#!/usr/bin/env python3\n" + script}, "1.1.1")
    found = document(capsys, "1.0.0", "1.1.1", "--repo", repo)
    assert any(f["evidence"][0]["path"] == "arm/scripts/watch" for f in found["findings"])


def test_built_sources_of_the_provider_are_quiet(repo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """C++ of the new side was built with the change, so an override there is no forgotten consumer."""
    release(repo, {"arm/src/mine.cpp": CONSUMER["user/src/my_driver.cpp"]}, "1.1.1")
    assert document(capsys, "1.0.0", "1.1.1", "--repo", repo)["findings"] == []


REMAPPED_XML = """<launch><node pkg="tool" exec="tool">
<remap from="/arm/state/joints" to="/arm/joint_state/raw/joints"/></node></launch>
"""
REMAPPED_PYTHON = """from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    remaps = [("/arm/state/joints", "/arm/joint_state/raw/joints")]
    return LaunchDescription([Node(package="tool", executable="tool", remappings=remaps)])
"""


@pytest.mark.parametrize(
    ("path", "text"),
    [("user/launch/a.launch", REMAPPED_XML), ("user/launch/a.launch.py", REMAPPED_PYTHON)],
)
def test_a_remap_that_keeps_the_old_name_downgrades(
    repo: Path, tmp_path: Path, path: str, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Who remaps the old name is warned, not failed."""
    write(tmp_path / "ws", {**CONSUMER, path: text})
    found = document(capsys, "1.0.0", "1.1.0", "--repo", repo, "--consumer", tmp_path / "ws")
    levels = {f["severity"] for f in found["findings"] if f["message"].startswith("topic")}
    assert levels == {"warning"}


def test_launch_files_set_parameters_and_start_programs(
    repo: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A parameter set in XML and a program started there are uses like any other."""
    release(repo, {"arm/CMakeLists.txt": "project(arm)\n"}, "1.2.0")
    text = '<launch>\n<node pkg="arm" exec="arm">\n<param name="checker_plugin" value="x"/>\n</node>\n</launch>\n'
    write(tmp_path / "ws", {"user/package.xml": package("user"), "user/launch/a.launch.xml": text})
    found = document(capsys, "1.0.0", "1.2.0", "--repo", repo, "--consumer", tmp_path / "ws")
    assert sorted(f["evidence"][0]["line"] for f in found["findings"]) == [2, 3]
