"""What goes wrong outside: unfit documents, a full disk, a clock, kills and rivals: it is told, and nothing is lost."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from sample import driver, packages, panel, published, write

from ecm_extract.cli.run import run
from ecm_extract.registry import clock
from ecm_extract.registry.releases import list_releases
from ecm_extract.registry.store import Registry
from ecm_extract.registry.tables import VerdictRow
from ecm_extract.registry.verify import verify

_EXTRACT = str(Path(sys.executable).with_name("ecm-extract"))
_ROOM = 16_384


@pytest.fixture
def place(tmp_path: Path, usual: Path) -> Path:
    """A registry with a driver that somebody answers for, so that it may go to beta."""
    with Registry(str(usual)) as registry:
        published(registry, packages(tmp_path / "a", driver()))
    assert run(["evidence", "state", "driver", "--kind", "policy_review", "--by", "Grace"]) == 0
    reason = ["--name", "Ada", "--reason", "a bench", "--until", "2999-12-31"]
    assert run(["waive", "driver", "contract", "--to", "beta", *reason]) == 0
    return tmp_path


def _state(place: Path) -> dict[str, Any]:
    """All that a person sees of the registry, which must be whole."""
    with Registry(str(place / "registry.sqlite")) as registry, registry.reading() as session:
        found = verify(session)
        verdicts = session.query(VerdictRow).count()
        assert found.problems == ()
        listed = [(each.name, each.channel) for each in list_releases(session)]
        return {"releases": listed, "entries": found.entries, "verdicts": verdicts}


def _without(*keys: str) -> Callable[[dict[str, Any]], dict[str, Any]]:
    return lambda document: {key: value for key, value in document.items() if key not in keys}


UNFIT = [
    pytest.param(_without("name"), "name", id="no name"),
    pytest.param(lambda document: {**document, "modules": [{"ecm": 7}]}, "modules", id="a module that is none"),
    pytest.param(lambda document: {**document, "schema": "ecm-extract/package/9"}, "schema", id="another schema"),
    pytest.param(lambda document: {**document, "provides": {"a": 1}}, "provides", id="provides no list"),
    pytest.param(lambda document: {**document, "version": ["1", "0"]}, "version", id="a version that is no text"),
]


@pytest.mark.parametrize(("change", "told"), UNFIT)
def test_a_document_that_does_not_fit(
    place: Path, change: Callable[[dict[str, Any]], dict[str, Any]], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The message names file and key; what came with it is not stored either."""
    capsys.readouterr()
    assert run(["registry", "show", "driver", "--format", "json"]) == 0
    document = json.loads(capsys.readouterr().out)
    folder = place / "documents"
    good = {**document, "version": "1.1.0"}
    write(folder, {"good.package.json": json.dumps(good), "bad.package.json": json.dumps(change(document))})
    before = _state(place)
    assert run(["registry", "publish", str(folder)]) == 2
    error = capsys.readouterr().err
    assert "bad.package.json" in error
    assert told in error
    assert _state(place) == before


@pytest.mark.parametrize("text", ["", "{", "[]", '{"schema": "ecm-extract/migration/2"}', "\x00\xff", "[" * 100_000])
def test_files_that_are_none(place: Path, text: str, capsys: pytest.CaptureFixture[str]) -> None:
    """A migration, evidence, gates and profiles: status 2 with the name of the file, never a traceback."""
    file = place / "given"
    file.write_text(text, "utf-8")
    before = _state(place)
    for words in (
        ["registry", "migration", "driver", str(file)],
        ["promote", "driver", "--to", "beta", "--gates", str(file)],
        ["registry", "publish", str(file)],
    ):
        assert run(words) == 2, words
        assert "given" in capsys.readouterr().err, words
    if text:
        assert run(["evidence", "add", str(file)]) == 2
    assert _state(place) == before


def _no_room() -> None:
    """Let files grow to a few pages only, as a full disk would; the kernel refuses the rest (EFBIG)."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (_ROOM, _ROOM))


def test_a_full_disk(place: Path) -> None:
    """Status 2 and what to look at; with room again the same command does it."""
    source = str(write(place / "b", {**driver("1.1.0", topic="status"), **panel()}))
    words = [_EXTRACT, "registry", "publish", source, "--jobs", "1"]
    before = _state(place)
    apart = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}  # of which Python would write the first pages only
    found = subprocess.run(words, capture_output=True, text=True, check=False, preexec_fn=_no_room, env=apart)
    assert found.returncode == 2, found.stderr
    assert "the registry cannot be used" in found.stderr
    assert "look at the disk" in found.stderr
    assert _state(place) == before
    assert subprocess.run(words, capture_output=True, check=False).returncode == 0
    assert len(_state(place)["releases"]) == 3


def test_a_clock_that_went_back(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The last entry was made by a machine that is an hour ahead: nothing is written by this one, and it is told."""
    ahead = clock.now() + timedelta(hours=1)
    with monkeypatch.context() as other, Registry(str(place / "registry.sqlite")) as registry:
        other.setattr(clock, "now", lambda: ahead)
        published(registry, packages(place / "ahead", panel()))
    before = _state(place)
    source = str(write(place / "b", driver("1.1.0")))
    for words in (
        ["registry", "publish", source, "--jobs", "1"],
        ["promote", "driver", "--to", "beta"],
        ["demote", "driver", "--to", "sandbox", "--reason", "x"],
        ["deprecate", "driver", "--reason", "x"],
        ["evidence", "state", "driver", "--kind", "rollback_test", "--by", "Ada"],
        ["registry", "record", "robot_7", "driver"],
    ):
        assert run(words) == 2, words
    assert "set the clock; nothing was changed" in capsys.readouterr().err
    assert _state(place) == before


_KILLED = """
import os, signal, sys
from ecm_checker.profiles import NO_PROFILES
from ecm_extract.registry.channels import gate_table
from ecm_extract.registry.promotion import promote
from ecm_extract.registry.store import Registry

with Registry() as registry, registry.writing() as session:
    assert promote(session, "driver", "beta", gate_table(), NO_PROFILES).passed
    session.flush()
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_promotion_that_is_killed(place: Path) -> None:
    """Verdict, channel and log come together, or not at all; the next one goes as if nothing had been."""
    before = _state(place)
    found = subprocess.run([sys.executable, "-c", _KILLED], check=False, env=os.environ.copy())
    assert found.returncode == -signal.SIGKILL
    assert _state(place) == before
    assert run(["promote", "driver", "--to", "beta"]) == 0
    assert _state(place)["releases"] == [("driver@1.0.0", "beta")]


def test_two_who_promote_the_same_release(place: Path) -> None:
    """One leads it up, the others are told where it is; the log has one promotion."""
    words = [_EXTRACT, "promote", "driver", "--to", "beta"]
    running = [subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(3)]
    told = [(each.communicate(), each.returncode) for each in running]
    assert sorted(status for _, status in told) == [0, 2, 2]
    assert all("driver@1.0.0 is in beta and cannot go to beta" in err for (_, err), status in told if status == 2)
    assert _state(place)["verdicts"] == 1


def test_two_who_publish_different_content(place: Path) -> None:
    """The same version from two machines: one is stored, the other one is refused, whichever comes first."""
    sources = [write(place / topic, driver("1.1.0", topic=topic)) for topic in ("status", "state")]
    words = [[_EXTRACT, "registry", "publish", str(each), "--jobs", "1"] for each in sources]
    running = [subprocess.Popen(each, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for each in words]
    told = [(each.communicate()[1], each.returncode) for each in running]
    assert sorted(status for _, status in told) == [0, 2]
    assert any("it is stored with other content" in error for error, status in told if status == 2)
    assert len(_state(place)["releases"]) == 2
