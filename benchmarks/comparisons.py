"""Runs `ecm-extract diff` on a local clone and reads its JSON (DESIGN §6): what changed between two refs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import msgspec
from extracted import command

_INCOMPLETE = 2
"""Status of a comparison that did not read everything; without a document it is that of a wrong command line."""


class Evidence(msgspec.Struct, frozen=True):
    """A place in a tree, 1-based."""

    path: str
    line: int


class Change(msgspec.Struct, frozen=True):
    """What the benchmarks read of a change; `old` is None of what was added, `new` of what was removed."""

    kind: str
    change: str
    package: str
    owner: str
    old: str | None
    new: str | None
    breaking: bool
    reason: str = ""
    evidence_old: Evidence | None = None
    evidence_new: Evidence | None = None


class _Document(msgspec.Struct, frozen=True):
    changes: tuple[Change, ...]


def changes_between(repo: Path, old: str, new: str, saved: Path | None = None) -> tuple[Change, ...]:
    """Return all changes between two refs of a clone.

    Args:
        repo: the clone, bare or not.
        old, new: the refs.
        saved: folder where the document of an earlier run lies, or where this one is put; None keeps nothing.
    """
    name = f"{repo.stem}..{old}..{new}.json".replace("/", "_")
    kept = saved / name if saved is not None else None
    if kept is not None and kept.is_file():
        return _read(kept.read_bytes())
    data = _run(repo, old, new)
    if kept is not None:
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_bytes(data)
    return _read(data)


def _run(repo: Path, old: str, new: str) -> bytes:
    line = [command(), "diff", old, new, "--repo", str(repo), "--format", "json", "--fail-on", "never"]
    done = subprocess.run(line, capture_output=True, check=False)
    if done.returncode not in {0, _INCOMPLETE} or not done.stdout:
        sys.exit(f"diff {old} {new} of {repo} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    if done.returncode == _INCOMPLETE:
        print(f"{repo.name} {old}..{new}: not everything was read, so that rows may be missed", file=sys.stderr)
    return done.stdout


def _read(data: bytes) -> tuple[Change, ...]:
    return msgspec.json.decode(data, type=_Document).changes
