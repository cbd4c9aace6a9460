"""Documented changes that `diff` finds: `python benchmarks/diff_recall.py --clones DIR [FILE...]`.

Each file of benchmarks/diff_recall holds what migration guides and changelogs of a project say. Printed are the recall
by kind and by project, and a line for each row that is not found. Status 1 when the recall is below the figure.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import msgspec
from comparisons import changes_between
from documented_changes import Guide, Row, load, told_instead, verdict

FOLDER = Path(__file__).parent / "diff_recall"
FIGURE = 0.90
_SHOWN = 3


class Judged(msgspec.Struct, frozen=True):
    """A row with what the comparison makes of it; `told` says what it says of the name instead."""

    project: str
    guide: Guide
    row: Row
    verdict: str
    told: tuple[str, ...]


def judged(path: Path, clones: Path, saved: Path | None) -> list[Judged]:
    """Compare the refs of a file and judge its rows; nothing when the clone is not there."""
    file = load(path)
    repo = clones / f"{file.project}.git"
    if not repo.is_dir():
        print(f"skipped: no clone {repo.name}", file=sys.stderr)
        return []
    found = []
    for guide in file.comparisons:
        changes = changes_between(repo, guide.old, guide.new, saved)
        for row in guide.rows:
            if not row.absent:
                told = tuple(told_instead(row, changes))[:_SHOWN]
                found.append(Judged(file.project, guide, row, verdict(row, changes), told))
    return found


def table(entries: list[Judged], key: Callable[[Judged], str]) -> None:
    """Print the recall by a key, and how many rows are told with another change."""
    total, hits, wrong = Counter[str](), Counter[str](), Counter[str]()
    for entry in entries:
        total[key(entry)] += 1
        hits[key(entry)] += entry.verdict == "found"
        wrong[key(entry)] += entry.verdict == "wrong change"
    for name in sorted(total):
        share = hits[name] / total[name]
        print(f"  {name:32} {hits[name]:4} of {total[name]:4}  {share:4.0%}  wrong change {wrong[name]}")


def report(entries: list[Judged]) -> float:
    """Print everything and return the recall."""
    print("by project")
    table(entries, lambda entry: entry.project)
    print("by kind")
    table(entries, lambda entry: entry.row.kind)
    print("by change")
    table(entries, lambda entry: entry.row.change)
    for entry in entries:
        if entry.verdict != "found":
            guide = entry.guide
            print(f"- {entry.verdict}: {entry.project} {guide.old}..{guide.new} {entry.row.text}")
            print(f"    {guide.guide}:{entry.row.line}" + "".join(f"\n    told: {text}" for text in entry.told))
    recall = sum(entry.verdict == "found" for entry in entries) / max(1, len(entries))
    print(f"recall {recall:.3f} of {len(entries)} documented changes; figure to reach {FIGURE:.2f}")
    return recall


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="*", type=Path, default=sorted(FOLDER.glob("*.yaml")))
    parser.add_argument("--clones", type=Path, required=True, help="folder with <project>.git")
    parser.add_argument("--saved", type=Path, help="folder that keeps the documents of the comparisons")
    arguments = parser.parse_args()
    entries = [entry for path in arguments.file for entry in judged(path, arguments.clones, arguments.saved)]
    sys.exit(0 if report(entries) >= FIGURE else 1)


if __name__ == "__main__":
    main()
