"""The way of a release from channel to channel, and the paper's upgrade from publication to promotion."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from sample import driver, packages, panel, published, write
from sqlalchemy import select

from ecm_extract.cli.run import run
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import AuditEntry


@pytest.fixture
def place(tmp_path: Path, usual: Path) -> Path:
    """A registry with a driver, who listens to it, and a driver that breaks it."""
    with Registry(str(usual)) as registry:
        published(registry, packages(tmp_path / "a", {**driver(), **panel()}))
        published(registry, packages(tmp_path / "b", driver("2.0.0", topic="status")))
    return tmp_path


def _gates(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, str]:
    capsys.readouterr()
    run(["promote", *words, "--format", "json"])
    return {each["gate"]: each["state"] for each in json.loads(capsys.readouterr().out)["gates"]}


def _waive(release: str, gate: str) -> int:
    reason = ["--name", "Ada", "--reason", "a bench", "--until", "2999-12-31"]
    return run(["waive", release, gate, "--to", "beta", *reason])


def _review(release: str) -> None:
    assert run(["evidence", "state", release, "--kind", "policy_review", "--by", "Grace"]) == 0


def test_a_breaking_release_brings_its_migration(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Refused without, admitted with it."""
    assert run(["promote", "driver@2.0.0", "--to", "beta"]) == 1
    assert "it is breaking and brings no migration" in capsys.readouterr().out
    old, new = str(place / "a" / "driver"), str(place / "b" / "driver")
    capsys.readouterr()
    assert run(["diff", f"{old}/", f"{new}/", "--repo", str(place), "--format", "migration-spec", "--jobs", "1"]) == 0
    file = place / "migration.json"
    file.write_text(capsys.readouterr().out, "utf-8")
    assert run(["registry", "migration", "driver@2.0.0", str(file)]) == 0
    assert _gates(capsys, "driver@2.0.0", "--to", "beta")["compatibility"] == "passed"


def test_a_waiver_lets_pass_and_stays_in_the_verdict(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A driver from sources has no complete contract."""
    assert _gates(capsys, "driver@1.0.0", "--to", "beta")["contract"] == "refused"
    assert _waive("driver@1.0.0", "contract") == 0
    _review("driver@1.0.0")
    assert run(["promote", "driver@1.0.0", "--to", "beta"]) == 0
    out = capsys.readouterr().out
    assert "Ada answers for it until 2999-12-31" in out
    assert "driver@1.0.0 goes from sandbox to beta" in out


def test_channels_are_taken_one_by_one(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Up by the gates, down by a person."""
    assert run(["promote", "driver@1.0.0", "--to", "stable"]) == 2
    assert "the next channel is beta" in capsys.readouterr().err
    assert run(["promote", "driver@1.0.0", "--to", "nowhere"]) == 2
    assert run(["demote", "driver@1.0.0", "--to", "sandbox", "--reason", "x"]) == 2
    _waive("driver@1.0.0", "contract")
    _review("driver@1.0.0")
    assert run(["promote", "driver@1.0.0", "--to", "beta"]) == 0
    assert run(["demote", "driver@1.0.0", "--to", "sandbox", "--reason", "it stalls"]) == 0
    assert _gates(capsys, "driver@1.0.0", "--to", "beta")["contract"] == "waived"


def test_a_release_is_deprecated_for_a_cycle_before_it_is_withdrawn(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not deprecated, no release since, still running, then gone; its contract stays."""
    old = "driver@1.0.0"
    assert run(["withdraw", old]) == 2
    assert run(["deprecate", old, "--reason", "its topic is renamed", "--successor", "driver@2.0.0"]) == 0
    assert run(["withdraw", old]) == 2
    assert "no release of driver came since" in capsys.readouterr().err
    with Registry() as registry:
        published(registry, packages(place / "c", driver("2.1.0", topic="status")))
    assert run(["registry", "record", "robot_7", old]) == 0
    assert run(["withdraw", old]) == 2
    assert "runs on robot_7" in capsys.readouterr().err
    assert run(["registry", "record", "robot_7", "driver@2.1.0"]) == 0
    assert run(["withdraw", old]) == 0
    assert run(["withdraw", old]) == 2
    assert run(["promote", old, "--to", "beta"]) == 2
    capsys.readouterr()
    assert run(["registry", "show", old]) == 0
    assert "withdrawn:" in capsys.readouterr().out


def test_evidence_is_stated_read_and_listed(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A record of a tool, one of a person, and what fits no schema."""
    assert run(["evidence", "state", "driver", "--kind", "upgrade_test", "--by", "Ada", "--on", "bench"]) == 0
    record = {
        "schema": "ecm-extract/evidence/1",
        "kind": "observation",
        "subject": {"package": "driver", "version": "1.0.0", "module_id": "ecm.driver.drive", "contract": "sha256:0"},
        "result": "confirmed",
        "by": {"name": "robot 7", "tool": "ecm-extract", "version": "0.1.0"},
        "begun": "2026-01-01T00:00:00Z",
        "seconds": 5.0,
        "on": {"source": "bag", "target": "run.mcap", "senses": [], "digest": "sha256:0"},
    }
    file = write(place, {"seen.jsonl": json.dumps(record) + "\n"}) / "seen.jsonl"
    assert run(["evidence", "add", str(file)]) == 0
    assert run(["evidence", "add", str(file)]) == 0
    capsys.readouterr()
    assert run(["evidence", "list", "driver@1.0.0"]) == 0
    listed = capsys.readouterr().out
    assert listed.count("observation of ecm.driver.drive confirmed by robot 7 on bag run.mcap") == 1
    bad = write(place, {"bad.jsonl": '\n{"schema": "ecm-extract/evidence/1"}\n'}) / "bad.jsonl"
    assert run(["evidence", "add", str(bad)]) == 2
    assert "bad.jsonl:2" in capsys.readouterr().err


def test_a_project_has_its_own_table(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Another table is named in the verdict; one that does not fit is refused."""
    levels = 'column = "contract"\nlevels.any = []\n'
    text = f'[channels.lab]\ncontract = "any"\n[channels.field]\ncontract = "any"\n[gates.contract]\n{levels}'
    file = write(place, {"gates.toml": text.replace("lab", "sandbox")}) / "gates.toml"
    capsys.readouterr()
    assert run(["promote", "driver@2.0.0", "--to", "field", "--gates", str(file)]) == 0
    assert "judged by a table of the project (--gates), not by that of the paper" in capsys.readouterr().out
    bad = write(place, {"bad.toml": text.replace('contract = "any"', 'contract = "none"')}) / "bad.toml"
    assert run(["promote", "driver@2.0.0", "--to", "field", "--gates", str(bad)]) == 2
    unknown = write(place, {"odd.toml": text.replace("levels.any = []", 'levels.any = ["luck"]')}) / "odd.toml"
    assert run(["promote", "driver@1.0.0", "--to", "lab", "--gates", str(unknown)]) == 2


def test_each_step_is_audited(place: Path) -> None:
    """Who asked what of a release can be read later."""
    _waive("driver@1.0.0", "contract")
    run(["promote", "driver@1.0.0", "--to", "beta"])
    run(["deprecate", "driver@1.0.0", "--reason", "old"])
    with Registry() as registry, registry.reading() as session:
        actions = session.scalars(select(AuditEntry.action).order_by(AuditEntry.number)).all()
    assert actions[-3:] == ["waive", "promote", "deprecate"]
    assert run(["registry", "verify"]) == 0
