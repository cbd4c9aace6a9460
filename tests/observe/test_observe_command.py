"""The command line: from a recording or a graph to findings, evidence and an overlay."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml
from bags import SENSOR, Recorder, times
from ecm_checker import json_schema
from fake_ros1 import TWIST, TWIST_MD5, FakeNode, Publisher, running
from observe_fixtures import ROOT

from ecm_extract.cli.run import run
from ecm_extract.observe.model import Observation, SourceKind

ROBOT = str(ROOT / "fixtures" / "demo_robot")


@pytest.fixture
def bag(tmp_path: Path) -> str:
    """The base driver of the demo robot as it should be, at 20 Hz."""
    with Recorder(tmp_path, "mcap") as recorder:
        odom = recorder.topic("/wheel_state", "sensor_msgs/msg/Imu", qos=SENSOR)
        for now in times(40):
            recorder.write(odom, now, recorder.imu(now, "base_link"))
    return str(recorder.path)


def test_a_recording_against_a_workspace(bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A topic with another type than the contract says is an error on the line of the contract."""
    assert run(["observe", "--bag", bag, "--workspace", ROBOT]) == 1
    told = capsys.readouterr()
    assert "OBS003 type_differs: /wheel_state" in told.out
    assert "base_driver.cpp" in told.out
    assert "differs" in told.err


@pytest.mark.parametrize("form", ["text", "json", "sarif", "github", "junit", "markdown", "html"])
def test_every_format(bag: str, form: str, capsys: pytest.CaptureFixture[str]) -> None:
    """All formats of findings show these as well."""
    assert run(["observe", "--bag", bag, "--workspace", ROBOT, "--format", form, "--fail-on", "never"]) == 0
    assert "OBS003" in capsys.readouterr().out


def test_document(bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    """One document holds verdict, modules, findings and everything that was seen."""
    run(["observe", bag, "--contracts", "none"])
    assert "none" in capsys.readouterr().err
    run(["observe", bag, "--workspace", ROBOT, "--format", "json", "-q"])
    found = json.loads(capsys.readouterr().out)
    assert found["schema"] == "ecm-extract/observe/1"
    assert found["verdict"] == "differs"
    assert found["observation"]["streams"][0]["hz"] == pytest.approx(20.0)
    assert "ecm.demo_robot_base.battery_monitor" in found["not_seen"]


def test_evidence_is_valid_and_added(bag: str, tmp_path: Path) -> None:
    """Each run adds a record a module, valid against the published schema."""
    file = tmp_path / "evidence.jsonl"
    for _ in range(2):
        run(["observe", bag, "--workspace", ROBOT, "--evidence", str(file), "--witness", "lab", "-q"])
    found = [json.loads(line) for line in file.read_text().splitlines()]
    for record in found:
        jsonschema.validate(record, json_schema.shipped("evidence"))
    by_module = {record["subject"]["module_id"]: record for record in found}
    assert len(found) == 2 * len(by_module)
    driver = by_module["ecm.demo_robot_base.base_driver"]
    assert driver["result"] == "contradicted"
    assert driver["by"]["name"] == "lab"
    assert driver["on"]["digest"].startswith("sha256:")
    assert by_module["ecm.demo_robot_base.battery_monitor"]["result"] == "not_seen"


def test_a_graph_as_promised(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A graph that does what its contracts say is confirmed, with status 0."""
    base = tmp_path / "base.ecm.yaml"
    base.write_text(yaml.safe_dump(manifest("base", {"role": "subscriber", "name": "/cmd_vel"})))
    evidence = tmp_path / "evidence.jsonl"
    with running(FakeNode("/base", [], {"/cmd_vel": TWIST})) as graph:
        command = ["observe", "--ros1", graph.uri, "--once", "--contracts", str(base), "--evidence", str(evidence)]
        assert run(command) == 0
    assert "as promised" in capsys.readouterr().err
    assert json.loads(evidence.read_text())["result"] == "confirmed"


def test_a_launch_says_what_must_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A node that the launch starts and that is not there is an error; evidence names the release of its package."""
    evidence = tmp_path / "evidence.jsonl"
    robot = str(ROOT / "fixtures" / "path_a" / "cmd_vel_robot")
    drive = FakeNode("/diff_drive", [Publisher("/odom", "nav_msgs/Odometry", "*")], {"/cmd_vel": TWIST})
    with running(drive) as graph:
        command = ["observe", "--ros1", graph.uri, "--once", "--workspace", robot, "--evidence", str(evidence)]
        assert run([*command, "--launch", "cmd_vel_robot/launch/one_writer.launch"]) == 1
    told = capsys.readouterr().out
    assert "OBS019 node_not_running: the launch starts /teleop" in told
    assert "accept" not in told
    results = {r["subject"]["module_id"]: r for r in map(json.loads, evidence.read_text().splitlines())}
    assert results["/diff_drive"]["result"] == "confirmed"
    assert results["/diff_drive"]["subject"]["version"] == "1.0.0"


def test_nothing_that_was_promised_is_no_all_clear(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Contracts of which nothing runs were not confirmed."""
    other = tmp_path / "other.ecm.yaml"
    other.write_text(yaml.safe_dump(manifest("arm", {"role": "subscriber", "name": "/goal"})))
    with running(FakeNode("/base", [], {"/cmd_vel": TWIST})) as graph:
        assert run(["observe", "--ros1", graph.uri, "--once", "--contracts", str(other)]) == 2
    assert "nothing was compared" in capsys.readouterr().err


def test_a_part_of_what_is_promised_confirms_nothing(bag: str, tmp_path: Path) -> None:
    """A recording with one of two topics says nothing of the other one."""
    evidence = tmp_path / "evidence.jsonl"
    imu = manifest("imu", {"role": "publisher", "name": "/wheel_state"})
    (end,) = imu["signature"]["interfaces"]
    end["type"] = "sensor_msgs/msg/Imu"
    both = {**imu, "signature": {"interfaces": [end, {**end, "name": "/magnet", "raw_name": "/magnet"}]}}
    for number, document in enumerate((imu, both)):
        path = tmp_path / f"{number}.ecm.yaml"
        path.write_text(yaml.safe_dump(document))
        run(["observe", bag, "--contracts", str(path), "--evidence", str(evidence), "-q"])
    found = [json.loads(line) for line in evidence.read_text().splitlines()]
    assert [each["result"] for each in found] == ["confirmed", "doubtful"]


def test_an_empty_graph_is_no_all_clear(capsys: pytest.CaptureFixture[str]) -> None:
    """A master under which nothing runs may be the wrong one, whoever asks for contracts or not."""
    with running() as graph:
        assert run(["observe", "--ros1", graph.uri, "--once"]) == 2
    told = capsys.readouterr().err
    assert "nothing there" in told
    assert "nothing is there" in told


def test_a_launch_in_a_recording_that_knows_no_nodes(bag: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A recording of ROS 2 cannot tell that a node does not run, so silence is none of it."""
    robot = str(ROOT / "fixtures" / "path_a" / "cmd_vel_robot")
    command = ["observe", "--bag", bag, "--workspace", robot, "--launch", "cmd_vel_robot/launch/one_writer.launch"]
    assert run(command) == 2
    assert "nothing was compared" in capsys.readouterr().err


@pytest.mark.parametrize("fail_on", ["error", "never"])
def test_what_could_not_be_read_is_no_all_clear(
    bag: str, fail_on: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The rest is shown, and the status says that it is not the whole."""
    (tmp_path / "cut.mcap").write_bytes(b"\x89MCAP0\r\n" + b"\xff" * 500)
    assert run(["observe", bag, str(tmp_path / "cut.mcap"), "--fail-on", fail_on]) == 2
    told = capsys.readouterr()
    assert "OBS020" in told.out
    assert "not all seen" in told.err
    assert "not everything could be read" in told.err


def test_a_finding_is_true_whatever_could_not_be_read(bag: str, tmp_path: Path) -> None:
    (tmp_path / "cut.mcap").write_bytes(b"")
    assert run(["observe", bag, str(tmp_path / "cut.mcap"), "--workspace", ROBOT, "-q"]) == 1


def test_what_a_source_cannot_see_is_not_as_promised(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """ROS 1 registers no service clients, so a contract with one is confirmed as far as that only."""
    base = tmp_path / "base.ecm.yaml"
    ends = [{"role": "subscriber", "name": "/cmd_vel"}, {"role": "service_client", "name": "/reset"}]
    whole = manifest("base", ends[0])
    whole["signature"]["interfaces"] += manifest("base", ends[1])["signature"]["interfaces"]
    base.write_text(yaml.safe_dump(whole))
    with running(FakeNode("/base", [], {"/cmd_vel": TWIST})) as graph:
        command = ["observe", "--ros1", graph.uri, "--once", "--contracts", str(base), "--format", "json"]
        assert run(command) == 0
    told = capsys.readouterr()
    assert json.loads(told.out)["verdict"] == "as_far_as_seen"
    assert json.loads(told.out)["cannot_be_seen"] == {"service_client": 1}
    assert "1 service client" in told.err


def test_open_names_are_completed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What stayed a pattern is written as an overlay, which the next extraction takes with origin `observed`."""
    package = tmp_path / "ws" / "bridge"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>bridge</name><version>1.0.0</version><description>b</description>'
        '<maintainer email="a@b.c">a</maintainer><license>MIT</license>'
        "<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend></package>"
    )
    (package / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.0)\nproject(bridge)\nfind_package(catkin REQUIRED)\n"
        "catkin_package()\ncatkin_install_python(PROGRAMS scripts/bridge.py DESTINATION bin)\n"
    )
    (package / "scripts" / "bridge.py").write_text(
        "#!/usr/bin/env python\nimport socket\nimport rospy\nfrom geometry_msgs.msg import Twist\n\n"
        'rospy.init_node("bridge")\n'
        'publisher = rospy.Publisher("/" + socket.gethostname() + "/cmd_vel", Twist, queue_size=1)\n'
        "rospy.spin()\n"
    )
    overlay = package / "ecm.yaml"
    publisher = Publisher("/robot7/cmd_vel", TWIST, TWIST_MD5, hz=40)
    with running(FakeNode("/bridge", [publisher])) as graph:
        command = ["observe", "--ros1", graph.uri, "--for", "1.5", "--workspace", str(tmp_path / "ws")]
        assert run([*command, "--complete", str(overlay), "--no-cache"]) == 0
    assert yaml.safe_load(overlay.read_text())["origin"] == "observed"
    capsys.readouterr()
    assert run([str(tmp_path / "ws"), "--format", "json", "-o", "-", "--no-cache"]) == 0
    (module,) = json.loads(capsys.readouterr().out)["packages"][0]["modules"]
    (end,) = [each for each in module["signature"]["interfaces"] if each["role"] == "publisher"]
    assert (end["name"], end["confidence"]) == ("/robot7/cmd_vel", "default")
    rates = module["behavior"]["rates"]
    assert rates["origin"] == "observed"
    assert 0 < rates["value"]["/robot7/cmd_vel"] < 200


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["--ros1", "--dds"],
        ["--dds", "999"],
        ["--dds", "x"],
        ["--bag", "none.bag"],
        ["--ros1", "http://127.0.0.1:9/", "--launch", "a.launch"],
        ["--ros1", "http://127.0.0.1:9/"],
    ],
)
def test_what_cannot_be_looked_at(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """Exit status 2 and one clear line."""
    assert run(["observe", *arguments]) == 2
    assert capsys.readouterr().err.startswith("error: ")


def test_without_the_extra(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Without Cyclone DDS the line says what to install."""
    for name in [name for name in sys.modules if name.startswith(("cyclonedds", "ecm_extract.observe.dds"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "cyclonedds", None)
    assert run(["observe", "--dds"]) == 2
    assert "ecm-extract[dds]" in capsys.readouterr().err


def test_import_stays_light() -> None:
    """Help and the import of the package load no middleware."""
    code = (
        "import sys, ecm_extract; from ecm_extract.cli.run import run; run(['observe', '--help']); "
        "print([name for name in sys.modules if name.split('.')[0] in {'cyclonedds', 'rosbags', 'numpy', 'rich'}])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.endswith("[]\n")


def test_the_model_is_the_document() -> None:
    """A source is one of three, and every record of the model is in an observation."""
    assert set(SourceKind.__args__) == {"ros1", "dds", "bag"}  # type: ignore[attr-defined]
    assert {"nodes", "endpoints", "parameters", "streams", "transforms"} <= set(Observation.__struct_fields__)


def manifest(name: str, interface: dict[str, Any]) -> dict[str, Any]:
    plain = {"raw_name": interface["name"], "type": "geometry_msgs/msg/Twist", "qos": None, "frame": None}
    evidence = {"confidence": "literal", "evidence": [{"path": "src/a.cpp", "line": 3}]}
    source = {"repository": None, "commit": None, "path": "."}
    identity = {"module_id": f"ecm.robot.{name}", "package": "robot", "kind": "node", "version": "1.0.0"}
    return {
        "schema": "ecm-extract/manifest/1",
        "ecm": {**identity, "source": source, "ros": 1},
        "signature": {"interfaces": [{**interface, **plain, **evidence}]},
    }
