"""Launch files of any size end, and what is left out of them is told with its line."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest

from ecm_extract.cli.run import run

MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version></package>"
PYTHON = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    "from launch.substitutions import LaunchConfiguration, PythonExpression\n"
    "def generate_launch_description():\n    a = LaunchConfiguration('a')\n{body}"
    "    return LaunchDescription([Node(package='p', executable='e', name=a), "
    "Node(package='p', executable='e', name='fine')])\n"
)
LONG = "y" * 90_000
SECONDS = 20


def system(folder: Path, name: str, text: str, capsys: pytest.CaptureFixture[str]) -> tuple[int, Any]:
    """Exit status and JSON document of one launch file; it is read in a bounded time."""
    (folder / "package.xml").write_text(MANIFEST)
    (folder / name).write_text(text)
    started = time.process_time()
    status = run(["system", name, "--workspace", str(folder), "--format", "json", "--no-cache"])
    assert time.process_time() - started < SECONDS
    return status, json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(
    "body",
    [
        "    a = PythonExpression([a, '+', a])\n" * 40,
        "    a = a and a\n" * 60,
        "    a = a + a\n" * 60,
        "".join(
            f"    if LaunchConfiguration('c{at}'):\n        a = a + '1'\n    else:\n        a = a + '2'\n"
            for at in range(60)
        ),
        "    a = NotSubstitution(a)\n" * 2_000,
    ],
    ids=["expression", "condition", "sum", "branches", "nesting"],
)
def test_a_text_of_python_that_doubles(body: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The text stays unknown and its line is told; the other nodes of the file are there."""
    status, found = system(tmp_path, "a.launch.py", PYTHON.format(body=body), capsys)
    assert (status, found["launch"]["complete"]) == (1, False)
    assert [node["name"] for node in found["nodes"]] == ["/{more text than is read}", "/fine"]
    told = [entry for entry in found["diagnostics"] if entry["code"] == "launch-text-cut"]
    assert told
    assert all(entry["path"] == "a.launch.py" and entry["line"] > 0 for entry in told)


@pytest.mark.parametrize(
    "body", ["    a = [a, a]\n" * 40, "    a = {'a': a, 'b': a}\n" * 40, "    b = [a]\n" + "    b.extend(b)\n" * 40]
)
def test_lists_of_python_that_double(body: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What would take for ever is told with the line that was reached."""
    status, found = system(tmp_path, "a.launch.py", PYTHON.format(body=body), capsys)
    assert status == 1
    assert [(entry["code"], entry["line"] > 5) for entry in found["diagnostics"]] == [("launch-too-long", True)]


def test_a_list_of_many_actions_is_read_whole(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No number of items is left out without a word."""
    body = "    many = []\n    for at in range(1900):\n        many.append(Node(package='p', executable='e', name=f'n{at}'))\n"
    text = PYTHON.format(body=body).replace("LaunchDescription([", "LaunchDescription(many + many[:300] + [")
    status, found = system(tmp_path, "a.launch.py", text, capsys)
    assert (status, len(found["nodes"])) == (0, 2_202)


def test_a_text_of_markup_that_doubles(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The line where it grows too long is told, and so is every later one that it is used in."""
    lets = '<let name="a" value="$(var a)$(var a)"/>\n' * 20
    text = f'<launch><let name="a" value="x"/>{lets}<node pkg="p" exec="e" name="fine"/></launch>'
    status, found = system(tmp_path, "a.launch.xml", text, capsys)
    assert (status, [node["name"] for node in found["nodes"]]) == (1, ["/fine"])
    assert {entry["code"] for entry in found["diagnostics"]} == {"launch-text-cut"}


def test_all_texts_together_are_bounded(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What was read before the bound is kept, and the line that reached it is told."""
    node = '<node pkg="p" exec="e" name="$(var a)" namespace="$(var a)"><remap from="$(var a)" to="$(var a)"/></node>\n'
    status, found = system(
        tmp_path, "a.launch.xml", f'<launch><let name="a" value="{LONG}"/>{node * 2_000}</launch>', capsys
    )
    (told,) = found["diagnostics"]
    assert (status, told["code"], told["severity"]) == (1, "launch-too-large", "error")
    assert 0 < len(found["nodes"]) < told["line"] + 1


def test_too_many_nodes_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file with more nodes than any robot has is cut where the bound is."""
    node = '<node pkg="p" exec="e"/>\n'
    status, found = system(tmp_path, "a.launch.xml", f"<launch>\n{node * 5_001}</launch>", capsys)
    (told,) = found["diagnostics"]
    assert (status, len(found["nodes"]), told["line"]) == (1, 5_000, 5_002)


def test_one_element_with_many_attributes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its attributes are left out, the rest of the file is read."""
    crowd = " ".join(f'a{at}="1"' for at in range(100_000))
    text = f'<launch>\n<group {crowd}>\n<node pkg="p" exec="e" name="fine"/></group></launch>'
    status, found = system(tmp_path, "a.launch.xml", text, capsys)
    assert (status, [node["name"] for node in found["nodes"]]) == (1, ["/fine"])
    assert [(entry["code"], entry["line"]) for entry in found["diagnostics"]] == [("xml-too-many-attributes", 2)]


@pytest.mark.parametrize("at_once", [True, False], ids=["at once", "included"])
def test_many_launch_files(at_once: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of 600 launch files none is left out."""
    (tmp_path / "package.xml").write_text(MANIFEST)
    names = [f"f{at}.launch.xml" for at in range(600)]
    for name in names:
        (tmp_path / name).write_text(f'<launch><node pkg="p" exec="e" name="{name[:-11]}"/></launch>')
    includes = "".join(f'<include file="$(find-pkg-share p)/{name}"/>' for name in names)
    (tmp_path / "all.launch.xml").write_text(f"<launch>{includes}</launch>")
    given = names if at_once else ["all.launch.xml"]
    assert run(["system", *given, "--workspace", str(tmp_path), "--format", "json", "--no-cache"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (len(found["nodes"]), found["launch"]["complete"]) == (600, True)


def test_too_many_robots_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Each description that is not read is named."""
    nodes = ""
    for at in range(22):
        (tmp_path / f"r{at}.urdf").write_text(f'<robot name="r{at}"/>')
        nodes += f'<node pkg="p" exec="e" args="$(find-pkg-share p)/r{at}.urdf"/>\n'
    status, found = system(tmp_path, "a.launch.xml", f"<launch>{nodes}</launch>", capsys)
    assert (status, len(found["robots"])) == (1, 20)
    assert [entry["path"] for entry in found["diagnostics"]] == ["r20.urdf", "r21.urdf"]


def test_a_malformed_file_among_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The others are read, and the text says first that something is missing."""
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "bad.launch.py").write_text("def generate_launch_description(:\n")
    (tmp_path / "good.launch.xml").write_text('<launch><node pkg="p" exec="e" name="fine"/></launch>')
    assert run(["system", "bad.launch.py", "good.launch.xml", "--workspace", str(tmp_path)]) == 1
    text = capsys.readouterr().out
    assert "INCOMPLETE" in text
    assert "/fine" in text
    assert "bad.launch.py:1" in text
    assert run(["check", str(tmp_path), "--launch", "bad.launch.py", "--launch", "good.launch.xml"]) == 2
