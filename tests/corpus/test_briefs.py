"""Briefs hold what contracts say, and nothing of what was found or told."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from click.testing import CliRunner
from ecm_corpus.blind import write_outcome
from ecm_corpus.commands.brief import command
from judged_cases import Judged


@pytest.fixture
def corpus(judged: Judged, tmp_path: Path) -> Path:
    """Two judged cases with their store."""
    (tmp_path / "cases" / "interface").mkdir(parents=True)
    write_outcome(judged.outcome, tmp_path)
    return tmp_path


def test_a_brief_says_what_the_sides_declare(corpus: Path, tmp_path: Path) -> None:
    """Endpoints, types, QoS and what changed; states and an unrelated pair under names that tell nothing."""
    done = CliRunner().invoke(command, ["R-small", "--corpus", str(corpus), "--key", str(tmp_path / "key")])
    assert done.exit_code == 0, done.exception
    assert "publisher, /raw_fix, std_msgs/msg/String, reliable, volatile" in done.output
    assert "publisher /fix is gone" in done.output
    key = dict(line.split(": ", 1) for line in (tmp_path / "key").read_text().splitlines())
    assert sorted(key.values()) == ["R-small:a", "R-small:b", "R-small:c", "R-small:d", "unrelated:R-small+R-other"]
    assert [line[8:] for line in done.output.splitlines() if line.startswith("# Brief")] == sorted(key)
    assert "R-small" not in done.output
    assert "VER001" not in done.output
    assert "used by" not in done.output


def test_an_unknown_case_is_an_error_of_the_user(corpus: Path) -> None:
    done = CliRunner().invoke(command, ["R-none", "--corpus", str(corpus)])
    assert "no results of a case" in str(done.exception)


def test_briefs_repeat(corpus: Path) -> None:
    outputs = {CliRunner().invoke(command, ["R-small", "--corpus", str(corpus)]).output for _ in range(2)}
    assert len(outputs) == 1
    assert msgspec.json.decode((corpus / "results.json").read_bytes())["schema"] == "ecm-corpus/results/2"
