"""The commands of the registry, as a person types them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from sample import driver, panel, write

from ecm_extract.cli.run import run


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A registry with the driver and the panel, named by the environment."""
    monkeypatch.setenv("ECM_REGISTRY", str(tmp_path / "registry.sqlite"))
    assert run(["registry", "init"]) == 0
    folder = write(tmp_path / "robot", {**driver(), **panel()})
    assert run(["registry", "publish", str(folder), "--jobs", "1"]) == 0
    return folder


def test_publishing_twice(robot: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It says what was there already."""
    capsys.readouterr()
    assert run(["registry", "publish", str(robot), "--jobs", "1"]) == 0
    assert "driver@1.0.0: is there already" in capsys.readouterr().out


def test_another_content_is_refused(robot: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Status 2, and what to do."""
    write(robot, driver(topic="status"))
    assert run(["registry", "publish", str(robot), "--jobs", "1"]) == 2
    assert "release it under a new version" in capsys.readouterr().err


def test_list_and_show(robot: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Text for people, documents for programs."""
    capsys.readouterr()
    assert run(["registry", "list", "--newest", "--format", "json"]) == 0
    assert [each["package"] for each in json.loads(capsys.readouterr().out)["releases"]] == ["driver", "panel"]
    assert run(["registry", "show", "driver"]) == 0
    assert "channel:    sandbox" in capsys.readouterr().out


def test_a_document_that_is_shown_can_be_published(
    robot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What leaves one registry comes into another as the same content."""
    capsys.readouterr()
    run(["registry", "show", "driver", "--format", "json"])
    file = tmp_path / "driver.package.json"
    file.write_text(capsys.readouterr().out, "utf-8")
    assert run(["registry", "publish", str(file)]) == 0
    assert "is there already" in capsys.readouterr().out


def test_who_uses(robot: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Names with the lines that use them."""
    capsys.readouterr()
    assert run(["registry", "who-uses", "driver", "rate"]) == 0
    told = capsys.readouterr().out
    assert "parameter rate of driver" in told or "parameter rate of drive" in told
    assert "panel@1.0.0 panel/config/driver.yaml:3 sets rate" in told


def test_verify(robot: Path) -> None:
    """Nothing is wrong with what was just stored."""
    assert run(["registry", "verify"]) == 0


def test_bad_input(robot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A document of another schema, a folder without packages, no registry: status 2."""
    bad = tmp_path / "bad.package.json"
    bad.write_text('{"schema": "ecm-extract/package/9"}', "utf-8")
    assert run(["registry", "publish", str(bad)]) == 2
    (tmp_path / "empty").mkdir()
    assert run(["registry", "publish", str(tmp_path / "empty")]) == 2
    assert run(["registry", "list", "--registry", str(tmp_path / "none.sqlite")]) == 2
    assert run(["registry", "list", "--registry", str(bad)]) == 2
    assert "Traceback" not in capsys.readouterr().err
