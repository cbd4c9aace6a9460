"""Judged breaking changes: `python benchmarks/diff_precision.py [FILE...]`; `--sample SEED --clones DIR` draws some.

Each file of benchmarks/diff_precision is one sample over the comparisons of `diff_precision/comparisons.toml`: breaking
changes that `diff` reported, each read in the sources of both refs and judged. Printed is the share that is true, by
kind and change, with a line for each false one. `--again --clones DIR` judges the program of today by them: how many of
the true and of the false ones it still tells. Status 1 when the share of the newest sample is below the figure.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import msgspec
from comparisons import Change, changes_between

FOLDER = Path(__file__).parent / "diff_precision"
FIGURE = 0.90
COUNT = 100
_ALSO = re.compile(r"\(also of ([^)]*)\)")


class Judgement(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One reported change; `verdict` tells whether the sources of both refs bear it out, `reason` why.

    `private`: they do, and nobody outside of the package could depend on it. It does not count as true.
    """

    project: str
    refs: tuple[str, str]
    kind: str
    change: str
    package: str
    owner: str
    old: str | None
    new: str | None
    verdict: Literal["true", "private", "false", ""]
    reason: str


class Sample(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The changes that a seed drew; `note` tells of which state of the program they are."""

    seed: int
    note: str
    judged: tuple[Judgement, ...]


def drawn(seed: int, clones: Path, saved: Path | None) -> Sample:
    """Draw breaking changes at random, the same number from each comparison as far as it has them."""
    chosen = random.Random(seed)
    pools = {pair: _breaking(pair, clones, saved) for pair in _comparisons(seed)}
    for pool in pools.values():
        chosen.shuffle(pool)
    found: list[Judgement] = []
    while len(found) < COUNT and any(pools.values()):
        for (project, old, new), pool in pools.items():
            if pool and len(found) < COUNT:
                found.append(_unjudged(project, (old, new), pool.pop()))
    return Sample(seed, "", tuple(found))


def _seed(path: Path) -> int:
    """The number in the name of a sample, by which the newest is the last."""
    return int(path.stem.rpartition("_")[2])


def _comparisons(seed: int) -> list[tuple[str, str, str]]:
    data = tomllib.loads((FOLDER / "comparisons.toml").read_text("utf-8"))
    return [(project, old, new) for project, pairs in data[f"seed_{seed}"].items() for old, new in pairs]


def _breaking(pair: tuple[str, str, str], clones: Path, saved: Path | None) -> list[Change]:
    project, old, new = pair
    changes = changes_between(clones / f"{project}.git", old, new, saved)
    return sorted((each for each in changes if each.breaking), key=lambda each: (each.kind, each.owner, str(each.old)))


def _unjudged(project: str, refs: tuple[str, str], each: Change) -> Judgement:
    return Judgement(
        project, refs, each.kind, each.change, each.package, each.owner, each.old, each.new, verdict="", reason=""
    )


def again(sample: Sample, clones: Path, saved: Path | None) -> float:
    """Print how many of the judged changes are told today and return the share of true ones among them."""
    told = [entry for entry in sample.judged if _is_told(entry, clones, saved)]
    true = sum(entry.verdict == "true" for entry in told)
    all_true = sum(entry.verdict == "true" for entry in sample.judged)
    print(f"seed {sample.seed} today: {true} of {all_true} true ones told, {len(told) - true} of", end=" ")
    print(f"{len(sample.judged) - all_true} false ones")
    return true / max(1, len(told))


def _is_told(entry: Judgement, clones: Path, saved: Path | None) -> bool:
    changes = changes_between(clones / f"{entry.project}.git", *entry.refs, saved)
    wanted = (entry.kind, entry.change, entry.old, entry.new)
    fitting = (each for each in changes if each.breaking and (each.kind, each.change, each.old, each.new) == wanted)
    return any(entry.owner in _owners(each) for each in fitting) or _is_told_by_whole(entry, changes)


def _is_told_by_whole(entry: Judgement, changes: Sequence[Change]) -> bool:
    """Whether what has it is told to have moved: a method or field that went with it has no line of its own."""
    moved = (each.old or "" for each in changes if each.breaking and each.change == entry.change == "moved")
    return bool(entry.owner) and any(old.rpartition(": ")[2] == entry.owner for old in moved)


def _owners(each: Change) -> set[str]:
    """Who a change is told of: one line of several programs is told once, with the others in its reason."""
    others = _ALSO.search(each.reason)
    return {each.owner, *(others[1].split(", ") if others else ())}


def report(sample: Sample) -> float:
    """Print the share of true changes and return it."""
    groups: dict[str, list[Judgement]] = defaultdict(list)
    for entry in sample.judged:
        groups[f"{entry.kind} {entry.change}"].append(entry)
    true = sum(entry.verdict == "true" for entry in sample.judged)
    share = true / max(1, len(sample.judged))
    print(f"seed {sample.seed}: {true} of {len(sample.judged)} true ({share:.0%}); {sample.note}")
    for name in sorted(groups):
        entries = groups[name]
        print(f"  {name:36} {sum(entry.verdict == 'true' for entry in entries):3} of {len(entries):3}")
    for entry in sample.judged:
        if entry.verdict != "true":
            names = f"{entry.owner or entry.package} {entry.old or ''} -> {entry.new or ''}"
            print(f"- {entry.verdict or 'not judged'}: {entry.project} {'..'.join(entry.refs)} {entry.kind} {names}")
            print(f"    {entry.change}: {entry.reason}")
    return share


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="*", type=Path, default=sorted(FOLDER.glob("*.yaml"), key=_seed))
    parser.add_argument("--sample", type=int, metavar="SEED", help="print a new sample to judge, as YAML")
    parser.add_argument("--again", action="store_true", help="tell how many of the judged ones are told today")
    parser.add_argument("--clones", type=Path, help="folder with <project>.git, for the two above")
    parser.add_argument("--saved", type=Path, help="folder that keeps the documents of the comparisons")
    arguments = parser.parse_args()
    if arguments.sample is not None:
        if arguments.clones is None:
            parser.error("--sample needs --clones")
        sys.stdout.write(msgspec.yaml.encode(drawn(arguments.sample, arguments.clones, arguments.saved)).decode())
        return
    samples = [msgspec.yaml.decode(path.read_bytes(), type=Sample) for path in arguments.file]
    if arguments.again and arguments.clones is None:
        parser.error("--again needs --clones")
    shares = [
        again(sample, arguments.clones, arguments.saved) if arguments.again else report(sample) for sample in samples
    ]
    sys.exit(0 if shares and shares[-1] >= FIGURE else 1)


if __name__ == "__main__":
    main()
