"""Seconds of comparisons of two refs of a repository: of their sources, and of their stored documents."""

from __future__ import annotations

import subprocess
from pathlib import Path

import msgspec
from extracted import command
from timed_tool import Tool, best


class DiffTiming(msgspec.Struct, frozen=True):
    """Seconds, all best of three.

    Attributes:
        cold: from sources, without the cache. warm: with it. extraction: of the new side, cold.
        stored: of the documents of one package, the largest, as they were extracted from both refs.
        stored_all: of the documents of all packages.
    """

    cold: float
    warm: float
    extraction: float
    stored: float
    stored_all: float


def newest_tags(root: Path) -> tuple[str, str] | None:
    """Return the two newest versions among the tags that HEAD can reach, older one first; None without."""
    line = ["git", "-C", str(root), "tag", "--merged", "HEAD", "--sort=-version:refname"]
    tags = subprocess.run(line, capture_output=True, text=True, check=False).stdout.split()
    versions = [tag for tag in tags if tag.lstrip("v")[:1].isdigit()]
    return (versions[1], versions[0]) if len(versions) > 1 else None


def measure_diff(root: Path, refs: tuple[str, str], tool: Tool, folder: Path) -> DiffTiming:
    """Take all times of comparisons between two refs of a repository; documents are written into a folder."""
    line = [*_diff(*refs), "--repo", str(root)]
    sides = [folder / "old", folder / "new"]
    for ref, side in zip(refs, sides, strict=True):
        tool.run([command(), "extract", str(root), "--ref", ref, "-o", str(side)])
    largest = _largest(*sides)
    return DiffTiming(
        cold=tool.cold(line),
        warm=tool.warm(line),
        extraction=tool.cold(tool.extraction(str(root), "--ref", refs[1])),
        stored=best(lambda: tool.run(_diff(*(str(side / largest) for side in sides)))),
        stored_all=best(lambda: tool.run(_diff(*map(str, sides)))),
    )


def _diff(old: str, new: str) -> list[str]:
    return [command(), "diff", old, new, "--format", "json", "--fail-on", "never"]


def _largest(old: Path, new: Path) -> Path:
    """The path of the largest document that both folders hold."""
    kept = [path.relative_to(new) for path in new.rglob("*.package.json")]
    return max((path for path in kept if (old / path).is_file()), key=lambda path: (new / path).stat().st_size)
