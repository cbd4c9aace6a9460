"""The whole circle: published, refused for want of evidence, observed, promoted."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from sample import driver, packages, published, write

from ecm_extract.cli.run import run
from ecm_extract.registry.store import Registry

ROOT = Path(__file__).parents[2]
OLD, NEW = "driver@1.0.0", "driver@1.0.1"


@pytest.fixture(scope="session")
def filled(tmp_path_factory: pytest.TempPathFactory, made_file: Path) -> Path:
    """A folder whose registry has two releases of a driver; the old one is stable, the new one beta and reviewed."""
    folder = tmp_path_factory.mktemp("filled")
    found = shutil.copy(made_file, folder / "registry.sqlite")
    with Registry(str(found)) as registry:
        published(registry, packages(folder / "old", driver("1.0.0")))
        published(registry, packages(folder / "new", driver("1.0.1")))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ECM_REGISTRY", str(found))
        for release in (OLD, NEW):
            _beta(release)
        assert run(["promote", OLD, "--to", "stable"]) == 0
    return folder


@pytest.fixture
def place(tmp_path: Path, filled: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of that folder, whose registry commands take."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    return Path(shutil.copytree(filled, tmp_path, dirs_exist_ok=True))


def _beta(release: str) -> None:
    for channel in ("beta", "stable"):
        said = ["--name", "Ada", "--reason", "a test", "--until", "2999-12-31"]
        assert run(["waive", release, "contract", "--to", channel, *said]) == 0
    _state(release, "policy_review")
    assert run(["promote", release, "--to", "beta"]) == 0
    for kind in ("policy_review", "rollback_test"):
        _state(release, kind)


def _state(release: str, kind: str) -> None:
    assert run(["evidence", "state", release, "--kind", kind, "--by", "Grace", "--on", "bench"]) == 0


def _recorded(place: Path, topic: str = "/state") -> str:
    folder = place / f"run{len(list(place.iterdir()))}"
    script = ROOT / "fixtures" / "registry" / "recording.py"
    subprocess.run([sys.executable, str(script), str(folder), topic], check=True)
    return str(folder)


def _refused(capsys: pytest.CaptureFixture[str]) -> dict[str, list[str]]:
    capsys.readouterr()
    run(["promote", NEW, "--to", "stable", "--format", "json"])
    gates = json.loads(capsys.readouterr().out)["gates"]
    return {each["gate"]: each["reasons"] for each in gates if each["state"] == "refused"}


def test_the_circle(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is wanting is told, a recording gives it, and the release goes."""
    refused = _refused(capsys)
    assert set(refused) == {"resource", "recovery"}
    assert refused["resource"] == ["the upgrade from 1.0.0 must be tested: no upgrade test since it came to beta"]
    assert run(["observe", "--bag", _recorded(place), "--release", NEW, "--registry", "--kind", "upgrade_test"]) == 0
    assert f"{NEW}: 1 records\n" in capsys.readouterr().err
    assert _refused(capsys) == {}
    assert run(["registry", "verify"]) == 0


def test_a_file_of_observations_does_the_same(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """On a robot that reaches no registry the records go through a file."""
    seen = str(place / "seen.jsonl")
    words = ["--bag", _recorded(place), "--release", NEW, "--kind", "upgrade_test", "--evidence", seen]
    assert run(["observe", *words]) == 0
    assert _refused(capsys)
    assert run(["evidence", "add", seen]) == 0
    assert _refused(capsys) == {}


def test_a_recording_of_something_else_proves_nothing(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A node that was not seen was not tested."""
    words = ["--bag", _recorded(place, "/other"), "--release", NEW, "--registry", "--kind", "upgrade_test"]
    assert run(["observe", *words]) == 2
    assert set(_refused(capsys)) == {"resource", "recovery"}


def test_another_content_under_the_same_version_proves_nothing(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What was observed is a work tree that says 1.0.1 and is not what was published."""
    changed = write(place / "changed", driver("1.0.1", parameter="speed"))
    words = ["--bag", _recorded(place), "--workspace", str(changed), "--registry", "--kind", "upgrade_test"]
    assert run(["observe", *words]) == 0
    assert "about another content than is stored" in capsys.readouterr().err
    assert _refused(capsys)["resource"][0].endswith("the upgrade test is of another content than is stored")


def test_the_same_content_of_another_clone_is_the_same(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Evidence names a contract, not the folder that it was read from."""
    same = write(place / "same", driver("1.0.1"))
    words = ["--bag", _recorded(place), "--workspace", str(same), "--registry", "--kind", "upgrade_test"]
    assert run(["observe", *words]) == 0
    assert _refused(capsys) == {}


def test_evidence_needs_somebody_to_be_about(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A registry without a release is told what to name; so is an environment of which nothing is known."""
    recorded = _recorded(place)
    assert run(["observe", "--bag", recorded, "--registry", str(place / "registry.sqlite")]) == 2
    assert "--release PACKAGE@VERSION" in capsys.readouterr().err
    assert run(["observe", "--bag", recorded, "--environment", "robot_7"]) == 2
    assert "nothing is recorded of the environment robot_7" in capsys.readouterr().err


def test_an_environment_is_observed(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a robot runs, with the release that is tried on it in the place of the old one."""
    assert run(["registry", "record", "robot_7", OLD]) == 0
    words = ["--environment", "robot_7", "--release", NEW, "--registry", "--kind", "upgrade_test"]
    assert run(["observe", "--bag", _recorded(place), *words]) == 0
    assert _refused(capsys) == {}
