"""`ecm-extract check`: outcomes, exit status, formats."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from ecm_extract.cli.run import run

ROOT = Path(__file__).parent.parent.parent
RULES = ROOT / "fixtures" / "rules"
PAPER = ROOT / "fixtures" / "paper"


def check(*arguments: str | Path) -> int:
    return run(["check", *map(str, arguments)])


@pytest.mark.parametrize(("rule", "dimension"), [("RES001", "resources"), ("BEH001", "behavior")])
def test_conflict_is_rejected_and_twin_accepted(rule: str, dimension: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Modules that run together: status 1 with the right dimension, 0 for the good twin."""
    assert check(RULES / rule / "bad", "--together", "--format", "json") == 1
    document = json.loads(capsys.readouterr().out)
    assert document["outcome"] == "reject"
    assert [each["dimension"] for each in document["findings"]] == [dimension]
    assert check(RULES / rule / "good", "--together") == 0
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("form", ["sarif", "github", "junit", "markdown", "html"])
def test_findings_in_every_format(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The file holds what standard output would, and the rule."""
    bad = RULES / "RES001" / "bad"
    assert check(bad, "--together", "--format", form, "--output", f"{form}={tmp_path / 'report'}") == 1
    assert "RES001" in (tmp_path / "report").read_text("utf-8")
    assert capsys.readouterr().out == (tmp_path / "report").read_text("utf-8")


@pytest.mark.parametrize("entry", ["pdf=a", "html", "html=", "html=none/such/file"])
def test_output_that_cannot_be(entry: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A wrong --output is a wrong command line, not a crash."""
    assert check(RULES / "RES001" / "bad", "--output", entry) == 2
    assert entry.split("=")[-1] in capsys.readouterr().err


def test_frame_without_transform_is_rejected(capsys: pytest.CaptureFixture[str]) -> None:
    """base_link to camera: a registered transform makes the difference."""
    manifests = sorted((RULES / "SIG006" / "bad").glob("*.ecm.yaml"))
    robot = RULES / "SIG006" / "good" / "embodiment.yaml"
    assert check("compose", *manifests, "--dimensions", "signature") == 1
    assert "SIG006" in capsys.readouterr().out
    assert check("compose", *manifests, "--dimensions", "signature", "--embodiment", robot) == 0


def test_chain_of_the_paper(capsys: pytest.CaptureFixture[str]) -> None:
    """Profiles come from files; the outcome is on standard error, findings on standard output."""
    folder = PAPER / "scenario_composition"
    manifests = sorted(folder.glob("*.ecm.yaml"))
    profiles: list[str | Path] = ["--embodiment", folder / "embodiment.yaml", "--policy", folder / "policy.yaml"]
    assert check("chain", *manifests, *profiles, "--runtime", folder / "runtime.yaml") == 1
    shown = capsys.readouterr()
    assert shown.out.count("\nerror ") + shown.out.startswith("error ") == 4
    assert shown.err.startswith("chain: reject\n")


def test_a_dimension_can_be_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    """Ablation from the command line."""
    assert check(RULES / "RES001" / "bad", "--together", "--without", "resources") == 0
    assert check(RULES / "RES001" / "bad", "--without", "colour") == 2
    assert "no dimension is called 'colour'" in capsys.readouterr().err


def test_upgrade_takes_old_and_new(capsys: pytest.CaptureFixture[str]) -> None:
    """Modules are paired by id; without a robot the upgrade is reviewed."""
    folder = PAPER / "scenario_upgrade"
    assert check("upgrade", folder / "old.ecm.yaml", folder / "new.ecm.yaml") == 0
    assert "upgrade: review" in capsys.readouterr().err
    robot: list[str | Path] = ["--embodiment", folder / "embodiment.yaml"]
    assert check("upgrade", folder / "old.ecm.yaml", folder / "new.ecm.yaml", *robot) == 1
    assert check("upgrade", folder / "old.ecm.yaml") == 2


def test_repository_is_extracted_and_checked(capsys: pytest.CaptureFixture[str]) -> None:
    """A source tree is as good as its manifests; modules that only could run together are no errors."""
    assert check(ROOT / "fixtures" / "demo_robot", "--format", "json") == 0
    document = json.loads(capsys.readouterr().out)
    assert document["operation"] == "system"
    assert len(document["checker"]["hash"]) == 64


def test_threshold_and_wrong_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 1 from the threshold on, 2 for what is no manifest or profile, never a traceback."""
    near = RULES / "SIG005" / "bad"
    assert check(near) == 0
    assert check(near, "--fail-on", "warning") == 1
    broken = tmp_path / "a.ecm.yaml"
    broken.write_text("ecm: [", "utf-8")
    assert check(broken) == 2
    broken.write_text("ecm: 3\n", "utf-8")
    assert check(broken) == 2
    profile = tmp_path / "robot.yaml"
    profile.write_text("sensor: [lidar]\n", "utf-8")
    assert check(near, "--embodiment", profile) == 2
    assert check() == 2
    assert check(tmp_path / "nothing") == 2
    assert "Traceback" not in capsys.readouterr().err


def test_nothing_is_decided_about_what_was_not_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither about an empty folder, nor about a package whose manifest is none."""
    (tmp_path / "empty").mkdir()
    assert run(["check", str(tmp_path / "empty")]) == 2
    assert "no ROS package" in capsys.readouterr().err
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "package.xml").write_text("<package><name>a</na")
    assert run(["check", str(tmp_path / "a")]) == 2
    assert "not read: 1 package.xml" in capsys.readouterr().err


def extracted(sources: Path, to: Path) -> Path:
    """A folder with the manifests and the documents of a tree."""
    assert run(["extract", str(sources), "-o", str(to), "--quiet"]) == 0
    return to


def test_documents_of_which_something_was_not_read_are_not_accepted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A stored document with a gap is accepted no more than its tree is."""
    stored = extracted(RULES.parent / "demo_robot", tmp_path / "stored")
    document = next(stored.rglob("*.package.json"))
    data = json.loads(document.read_text("utf-8"))
    data["unread"] = [{"path": "src/big.cpp", "reason": "too-large", "carries": True}]
    document.write_text(json.dumps(data), "utf-8")
    assert check(stored) == 2
    assert "src/big.cpp" in capsys.readouterr().err


def test_manifests_without_documents_are_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Requirements can be asked of documents only; the others are still asked."""
    stored = extracted(RULES.parent / "demo_robot", tmp_path / "stored")
    bare = RULES / "RES001" / "good"
    assert check("system", stored, bare, "--format", "json") == 0
    (line,) = [each for each in json.loads(capsys.readouterr().out)["not_asked"] if "manifests only" in each]
    assert line.startswith(f"requirements of {bare}")
