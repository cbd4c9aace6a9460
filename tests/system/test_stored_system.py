"""A system of stored documents is the system of their sources, byte for byte."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from workspaces import Workspace

from ecm_extract.cli.run import run
from ecm_extract.system.launch_files import is_launch_file

FIXTURES = Path(__file__).parent.parent.parent / "fixtures"
FORMATS = ("text", "json", "dot", "mermaid")


def workspaces() -> Iterator[Path]:
    """Folders of packages of which one has a launch file."""
    manifests = sorted(FIXTURES.rglob("package.xml"))
    yield from dict.fromkeys(each.parent.parent for each in manifests if any(launches(each.parent)))


def launches(folder: Path) -> Iterator[str]:
    paths = (each.relative_to(folder).as_posix() for each in sorted(folder.rglob("*")) if each.is_file())
    return (path for path in paths if is_launch_file(path))


def said(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    status = run(["system", *words])
    return status, capsys.readouterr().out


def stored(tree: Path, folder: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """Write the extract document of a tree."""
    capsys.readouterr()
    assert run(["extract", str(tree), "--quiet", "--format", "json", "-o", "-"]) == 0
    document = folder / "stored.json"
    document.write_text(capsys.readouterr().out, "utf-8")
    return document


@pytest.mark.parametrize("folder", list(workspaces()), ids=lambda folder: folder.relative_to(FIXTURES).as_posix())
def test_documents_give_what_sources_give(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every launch file of a fixture, in every format: from sources, a document, and a folder of documents."""
    shutil.copytree(folder, tmp_path / "ws")
    monkeypatch.chdir(tmp_path)
    stored(Path("ws"), tmp_path, capsys)
    assert run(["extract", "ws", "-o", "stored"]) == 0
    shutil.move("ws", "elsewhere")
    capsys.readouterr()
    for launch in launches(folder):
        for form in FORMATS:
            known = [said(capsys, each, launch, "--format", form) for each in ("stored.json", "stored")]
            shutil.move("elsewhere", "ws")
            known.append(said(capsys, launch, "--workspace", "ws", "--format", form))
            shutil.move("ws", "elsewhere")
            assert known[0] == known[1] == known[2]
            assert known[0][1]


LAUNCH = """<launch>
  <include file="$(dirname)/{name}"/>
  <node pkg="pkg" exec="talker" name="talker"/>
</launch>
"""


def test_arguments_count_for_documents(
    workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A launch file in Python is read anew with what it is given."""
    text = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from names import NAME


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("side", default_value="left"),
        Node(package="pkg", executable="talker", name=NAME, namespace=LaunchConfiguration("side")),
    ])
"""
    workspace.package({"launch/a.launch.py": text, "launch/names.py": 'NAME = "voice"\n'}, 2)
    document = stored(workspace.root, tmp_path, capsys)
    status, out = said(capsys, str(document), "pkg/a.launch.py", "side:=right", "--format", "json")
    assert status == 0
    assert [node["name"] for node in json.loads(out)["nodes"]] == ["/right/voice"]


def test_what_no_document_keeps_is_told(
    workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that is too large to be kept is no file that starts nothing."""
    large = "<launch>" + "<!-- much -->" * 30_000 + "</launch>"
    workspace.package({"launch/a.launch.xml": LAUNCH.format(name="b.launch.xml"), "launch/b.launch.xml": large}, 2)
    document = stored(workspace.root, tmp_path, capsys)
    status, out = said(capsys, str(document), "pkg/a.launch.xml")
    assert status == 1
    assert "keeps no content of" in out
    assert "/talker" in out


@pytest.mark.parametrize("marker", ["aside/COLCON_IGNORE", "aside/README"])
def test_launch_files_of_no_package_are_in_documents(
    marker: str, workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A launch file in a folder that the build ignores, or in none of a package, is started with what it reads."""
    text = '<launch><node pkg="pkg" exec="talker" name="talker"><param from="$(dirname)/../config/a.yaml"/></node></launch>'
    workspace.package({"launch/b.launch.xml": "<launch/>"}, 2)
    config = "talker: {ros__parameters: {loud: true}}\n"
    for path, content in ((marker, ""), ("aside/launch/a.launch.xml", text), ("aside/config/a.yaml", config)):
        (workspace.root / path).parent.mkdir(parents=True, exist_ok=True)
        (workspace.root / path).write_text(content, "utf-8")
    document = stored(workspace.root, tmp_path, capsys)
    assert run(["extract", str(workspace.root), "--quiet", "-o", str(tmp_path / "stored")]) == 0
    launch = ("aside/launch/a.launch.xml", "--format", "json")
    from_sources = said(capsys, *launch, "--workspace", str(workspace.root))
    assert '"loud"' in from_sources[1]
    assert ("ignored-folder" in from_sources[1]) == marker.endswith("COLCON_IGNORE")
    assert said(capsys, str(document), *launch) == from_sources
    assert said(capsys, str(tmp_path / "stored"), *launch) == from_sources


def test_a_document_that_does_not_tell_what_runs_is_refused(
    workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    workspace.package({"launch/a.launch.xml": "<launch/>"}, 2)
    document = stored(workspace.root, tmp_path, capsys)
    old = json.loads(document.read_text("utf-8"))
    for package in old["packages"]:
        del package["running"]
    document.write_text(json.dumps(old), "utf-8")
    assert run(["system", str(document), "pkg/a.launch.xml"]) == 2
    assert "extract the package once more" in capsys.readouterr().err


def test_documents_and_a_tree_are_not_mixed(
    workspace: Workspace, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    workspace.package({"launch/a.launch.xml": "<launch/>"}, 2)
    document = stored(workspace.root, tmp_path, capsys)
    assert run(["system", str(document), "pkg/a.launch.xml", "--workspace", str(workspace.root)]) == 2
    assert "leave --workspace" in capsys.readouterr().err


def test_check_of_a_launch_in_documents(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a launch file composes is checked the same with documents."""
    shutil.copytree(FIXTURES / "path_a", tmp_path / "ws")
    monkeypatch.chdir(tmp_path)
    stored(Path("ws"), tmp_path, capsys)
    launch = ["--launch", "cmd_vel_robot/two_writers.launch", "--format", "json"]
    statuses = [run(["check", "system", "ws", *launch])]
    found = [capsys.readouterr().out]
    shutil.rmtree("ws")
    statuses.append(run(["check", "system", "stored.json", *launch]))
    found.append(capsys.readouterr().out)
    assert statuses[0] == statuses[1]
    assert found[0] == found[1]
    assert json.loads(found[0])["findings"]
