"""Judged findings of lint: `python benchmarks/lint_precision.py [FILE...]`; `--tiers` prints what each rule has earned.

Each file of benchmarks/lint_precision is one sample: repositories that nobody had looked at, with findings of `lint
--preview` that were read in their sources and judged. `wanted`: true, and somebody would mend it; `noise`: true, and
nobody would; `false`: not so. Printed is the share that is wanted, by severity, and by rule with its repositories.

A rule is stable when, in at least ten repositories that did not shape it, 95 of 100 of what it said was wanted. A row
that led to a change of its rule is marked `shaped`: its repository no longer counts for that rule.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Literal

import msgspec

FOLDER = Path(__file__).parent / "lint_precision"
ENOUGH = 10
SHARE = 0.95


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One finding; `why` tells by what in the sources it was judged, `shaped` that its rule was changed for it."""

    rule: str
    severity: Literal["error", "warning", "info"]
    path: str
    line: int
    verdict: Literal["wanted", "noise", "false"]
    why: str
    shaped: bool = False


class Repository(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What lint said of one commit; no rows where it said nothing above an info."""

    repository: str
    commit: str
    rows: tuple[Row, ...]


class Sample(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Repositories that were drawn at one time; `note` tells of which state of the program they are."""

    note: str
    repositories: tuple[Repository, ...]


class Record(msgspec.Struct, frozen=True):
    """What counts for the tier of a rule: the repositories that did not shape it, and their verdicts."""

    repositories: frozenset[str]
    wanted: int
    judged: int

    @property
    def tier(self) -> Literal["stable", "preview"]:
        """The tier that the rule has earned."""
        enough = len(self.repositories) >= ENOUGH and self.wanted >= SHARE * self.judged
        return "stable" if enough else "preview"


def samples(paths: Iterable[Path] = ()) -> list[Sample]:
    """Read files; all of the folder when none is named."""
    files = list(paths) or sorted(FOLDER.glob("*.yaml"))
    return [msgspec.yaml.decode(path.read_bytes(), type=Sample) for path in files]


def records(found: Iterable[Sample]) -> Mapping[str, Record]:
    """Return what counts for each rule that was judged."""
    rows: dict[str, dict[str, list[Row]]] = defaultdict(lambda: defaultdict(list))
    for sample in found:
        for repository in sample.repositories:
            for row in repository.rows:
                rows[row.rule][repository.repository].append(row)
    return {rule: _record(by_repository) for rule, by_repository in sorted(rows.items())}


def _record(by_repository: Mapping[str, list[Row]]) -> Record:
    counted = {name: rows for name, rows in by_repository.items() if not any(row.shaped for row in rows)}
    every = [row for rows in counted.values() for row in rows]
    return Record(frozenset(counted), sum(row.verdict == "wanted" for row in every), len(every))


def report(sample: Sample) -> None:
    """Print the verdicts of a sample by severity, and by rule and severity."""
    rows = [row for repository in sample.repositories for row in repository.rows]
    print(f"{len(sample.repositories)} repositories, {len(rows)} findings; {sample.note}")
    for severity in ("error", "warning", "info"):
        print(f"  {severity:16} {_shares([row for row in rows if row.severity == severity])}")
    groups: dict[tuple[str, str], list[Row]] = defaultdict(list)
    for row in rows:
        groups[row.rule, row.severity].append(row)
    for (rule, severity), group in sorted(groups.items()):
        print(f"    {rule} {severity:7} {_shares(group)}")


def _shares(rows: list[Row]) -> str:
    counts = {verdict: sum(row.verdict == verdict for row in rows) for verdict in ("wanted", "noise", "false")}
    share = f"{counts['wanted'] / len(rows):4.0%}" if rows else "   -"
    return f"{share} wanted: " + ", ".join(f"{count:3} {verdict}" for verdict, count in counts.items())


def report_tiers(found: Iterable[Sample]) -> None:
    """Print the tier that each judged rule has earned, with what it rests on."""
    for rule, record in records(found).items():
        print(f"{rule} {record.tier:8} {record.wanted:3} of {record.judged:3} in {len(record.repositories):2}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="*", type=Path)
    parser.add_argument("--tiers", action="store_true", help="print what each rule has earned by all rows")
    arguments = parser.parse_args()
    found = samples(arguments.file)
    if arguments.tiers:
        report_tiers(found)
        return
    for sample in found:
        report(sample)


if __name__ == "__main__":
    main()
