"""`ecm-extract system`: the instance graph of the arm robot, in every format."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from ecm_extract.cli.run import run

ARM = Path(__file__).parent.parent.parent / "fixtures" / "arm_robot"


def system(*arguments: str) -> int:
    return run(["system", *arguments, "--workspace", str(ARM)])


@pytest.mark.parametrize("form", ["text", "json", "dot", "mermaid"])
def test_arm(form: str, golden: object, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Names, remaps, parameters, claims and frames of the arm are what its files say."""
    monkeypatch.chdir(ARM.parent)
    assert run(["system", "arm_bringup/arm.launch.py", "--workspace", "arm_robot", "--format", form]) == 0
    text = capsys.readouterr().out
    if form == "json":
        document = json.loads(text)
        document["source"]["commit"] = None
        text = json.dumps(document, indent=1) + "\n"
    else:
        text = "\n".join(
            line.partition(" (")[0] if line.startswith("arm_robot (") else line for line in text.split("\n")
        )
    golden(f"system_arm.{form}", text)  # type: ignore[operator]


def test_a_launch_file_by_its_place_on_disk(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The packages around a launch file are read wherever one stands; a path inside the workspace may be whole."""
    shutil.copytree(ARM, tmp_path / "ws")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    launch = tmp_path / "ws" / "arm_bringup" / "launch" / "arm.launch.py"
    graphs = []
    for arguments in ([str(launch)], [str(launch), "--workspace", str(tmp_path / "ws")]):
        assert run(["system", *arguments, "--format", "json"]) == 0
        graphs.append(json.loads(capsys.readouterr().out)["nodes"])
    assert graphs[0]
    assert graphs[0] == graphs[1]


def test_argument_changes_the_graph(capsys: pytest.CaptureFixture[str]) -> None:
    """Who asks for the right arm without a panel gets that."""
    assert system("arm_bringup/arm.launch.py", "side:=right", "panel:=false", "record:=true", "--format", "json") == 0
    names = [node["name"] for node in json.loads(capsys.readouterr().out)["nodes"]]
    assert "/right/driver" in names
    assert "/recorder" in names
    assert not [name for name in names if name.endswith("/panel")]


def test_markups_agree(capsys: pytest.CaptureFixture[str]) -> None:
    """The XML and the YAML file of the panel start the same node."""
    found = []
    for name in ("arm_bringup/panel.launch.xml", "arm_bringup/panel.launch.yaml"):
        assert system(name, "ns:=left", "--format", "json") == 0
        (node,) = json.loads(capsys.readouterr().out)["nodes"]
        found.append([(entry["role"], entry["name"], entry["type"]) for entry in node["endpoints"]])
    assert found[0] == found[1]


def test_ros1_names(capsys: pytest.CaptureFixture[str]) -> None:
    """Group namespaces, private names, remaps and `$(eval)` of ROS 1."""
    assert system("arm_legacy/watchdog.launch", "--format", "json") == 0
    nodes = {node["name"]: node for node in json.loads(capsys.readouterr().out)["nodes"]}
    assert list(nodes) == ["/arm/guard", "/spare/arm_extra"]
    assert [entry["name"] for entry in nodes["/arm/guard"]["endpoints"]] == ["/alarm", "/arm/guard/beat"]
    values = {entry["name"]: entry["value"] for entry in nodes["/arm/guard"]["parameters"]}
    assert values["limits/force"] == 10.0


def test_missing_launch_file_is_an_error_of_the_user(capsys: pytest.CaptureFixture[str]) -> None:
    """Status 2 and a hint, no traceback."""
    assert system("arm_bringup/none.launch.py") == 2
    assert "package/file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        ("some.yaml", "a: 1\n", "There is no `launch:` list"),
        ("robot.xml", "<robot/>", "The root is <robot>, not <launch>"),
        ("program.py", "print(1)\n", "There is no `generate_launch_description`"),
        ("broken.launch", "", "The file holds no XML"),
        ("notes.txt", "hello\n", "Not well-formed"),
    ],
)
def test_a_file_that_is_no_launch_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, text: str, why: str
) -> None:
    """A file that starts nothing is a mistake, and what was looked for is told."""
    (tmp_path / name).write_text(text)
    assert run(["system", str(tmp_path / name)]) == 2
    err = capsys.readouterr().err
    assert f"{name} cannot be read as a launch file" in err
    assert why in err
