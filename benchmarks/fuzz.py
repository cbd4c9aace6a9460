"""Mutated and made-up inputs: `python benchmarks/fuzz.py CLONE... [--seed N] [--minutes M] [--into DIR] [--kind K]`.

Real files of the clones are changed at random by kind, or get something deep, wide, long or repeated put in, and every
command that reads them is run on them, in processes with bounds of time and memory. Several inputs share a process;
where one ends wrongly, halves are run again until one input is left. Printed are, by kind, the inputs and how many made
the tool fail (status 3, a signal, a traceback), take more than 10 seconds of CPU or more than 1 GB; below DIR lies the
smallest input found for each, with what the tool said. Ends with status 1 when there is any. The same seed makes the
same inputs.
"""

from __future__ import annotations

import argparse
import hashlib
import random
import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from fuzz_inputs import KINDS, bomb, drawn, mutant, real_inputs
from fuzz_run import Input, Run, run, write

BATCH: Final = 32
BOMBS: Final = 0.15
"""Share of inputs that have something made up in them."""
MAX_SHRINKING: Final = 60.0
"""Seconds that making one failing input smaller may take."""
PROBLEMS: Final = ("traceback", "slow", "large")


def made(kind: str, texts: Mapping[str, list[str]], chance: random.Random) -> Input:
    """Return one input of a kind."""
    real = chance.choice(texts[kind])
    if chance.random() < BOMBS:
        return Input(kind, real, bomb(KINDS[kind], real, chance))
    return Input(kind, real, mutant(real, texts[kind], chance))


def failures(inputs: list[Input]) -> list[tuple[Input, Run]]:
    """Return the inputs that the tool fails on, each alone: halves of those that fail together are run again."""
    found = run(inputs)
    if not found.problem:
        return []
    if len(inputs) == 1:
        return [(inputs[0], found)]
    middle = len(inputs) // 2
    return [*failures(inputs[:middle]), *failures(inputs[middle:])]


def shrunk(entry: Input, problem: str) -> Input:
    """Return a smaller input with the same problem: parts are left out as long as it stays."""
    end = time.monotonic() + MAX_SHRINKING
    lines, size = entry.text.splitlines(keepends=True), 0
    size = max(1, len(lines) // 2)
    while size and time.monotonic() < end:
        at = 0
        while at < len(lines) and time.monotonic() < end:
            fewer = lines[:at] + lines[at + size :]
            if run([entry._replace(text="".join(fewer))]).problem == problem:
                lines = fewer
            else:
                at += size
        size //= 2
    return entry._replace(text="".join(lines))


def keep(entry: Input, found: Run, folder: Path) -> None:
    """Write an input and what the tool said of it, once for each last line of the error."""
    last = "".join(char for char in found.told.strip().rpartition("\n")[2] if not char.isdigit())
    name = f"{entry.kind.replace(' ', '-')}-{found.problem}-{hashlib.sha1(last.encode()).hexdigest()[:8]}"
    target = folder / name
    if not target.exists():
        write([shrunk(entry, found.problem)], target)
        (target / "told.txt").write_text(found.told, "utf-8")


def report(counts: Mapping[str, Counter[str]]) -> None:
    """Print a line for each kind."""
    print(f"{'kind':14}{'inputs':>8}{'traceback':>11}{'> 10 s':>8}{'> 1 GB':>8}")
    for kind, count in counts.items():
        figures = [count[problem] for problem in PROBLEMS]
        print(f"{kind:14}{count['inputs']:8}{figures[0]:11}{figures[1]:8}{figures[2]:8}")


def arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", nargs="+", type=Path, help="work trees of repositories")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--into", type=Path, default=Path("fuzz-failures"))
    parser.add_argument("--kind", choices=KINDS, action="append", help="only these")
    return parser.parse_args()


def main() -> int:
    """Fuzz until the time is up."""
    asked = arguments()
    chance = random.Random(asked.seed)
    texts = drawn(real_inputs(asked.clones), chance)
    counts = {kind: Counter[str]() for kind in asked.kind or KINDS if texts[kind]}
    end = time.monotonic() + 60 * asked.minutes
    while time.monotonic() < end:
        for kind, count in counts.items():
            inputs = [made(kind, texts, chance) for _ in range(BATCH)]
            count["inputs"] += len(inputs)
            for entry, found in failures(inputs):
                count[found.problem] += 1
                keep(entry, found, asked.into)
    report(counts)
    return int(any(count[problem] for count in counts.values() for problem in PROBLEMS))


if __name__ == "__main__":
    sys.exit(main())
