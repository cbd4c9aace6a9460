"""Path A: each prediction of contracts beside what the middleware does.

python benchmarks/path_a/run.py [--repetitions 5] [--only ROW]...      (or: make path-a)

Predictions are findings of `ecm-extract check` (`diff` for the version row) on contracts that are extracted from
fixtures/path_a. A row whose middleware is not at hand says what it needs. Everything runs on loopback.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from path_a import claim, frames, lifecycle, permission, qos, qos_ros2, recovery, version, writers
from path_a.row import Case, NotMeasured, Row, shown

ROWS: Mapping[str, Row] = {
    "qos": qos.measure,
    "qos-ros2": qos_ros2.measure,
    "writers": writers.measure,
    "claim": claim.measure,
    "lifecycle": lifecycle.measure,
    "frames": frames.measure,
    "version": version.measure,
    "recovery": recovery.measure,
    "permission": permission.measure,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--only", action="append", choices=ROWS)
    given = parser.parse_args()
    cases = [case for name in given.only or ROWS for case in _measured(name, given.repetitions)]
    counts = {
        verdict: sum(case.verdict == verdict for case in cases) for verdict in ("confirmed", "REFUTED", "not measured")
    }
    print(", ".join(f"{count} {verdict}" for verdict, count in counts.items()))
    sys.exit(bool(counts["REFUTED"]))


def _measured(name: str, repetitions: int) -> list[Case]:
    try:
        cases = list(ROWS[name](repetitions))
    except NotMeasured as reason:
        cases = [Case(name, "not asked for", missing=str(reason))]
    for case in cases:
        print(shown(case), flush=True)
    return cases


if __name__ == "__main__":
    main()
