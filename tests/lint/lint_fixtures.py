"""Runs lint over the fixtures of the rules."""

from __future__ import annotations

from pathlib import Path

from ecm_checker.finding import Finding

from ecm_extract.cli.run import run
from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree import open_tree

ROOT = Path(__file__).parent.parent.parent
FIXTURES = ROOT / "fixtures" / "lint"
BAD = FIXTURES / "LNT003" / "bad"
LAUNCH = "demo/launch/a.launch.xml"


def lint(folder: Path) -> list[Finding]:
    """Findings of a folder."""
    return findings_of(Workspace(open_tree(folder), Options(jobs=1)))


def run_lint(*arguments: str | Path) -> int:
    """Status of the command, rules on trial too."""
    return run(["lint", "--preview", *map(str, arguments)])
