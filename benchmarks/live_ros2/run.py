"""Nodes of whichever ROS 2 is sourced, beside the contracts of their sources.

python benchmarks/live_ros2/run.py TREE... [--most 4] [--starts FILE] [--json FILE]

Starts programs that the sourced ROS 2 has of the packages of the trees, and scripts of rclpy straight from the trees,
one at a time. ROS 2 itself tells names, types, QoS and parameters with their values (the calls behind `ros2 node info`,
`topic info -v` and `param dump`), `observe --dds` sees them beside it; both are compared with the contracts. Without a
sourced ROS 2 it says so and measures nothing. The code of the trees is run: do it where it can do no harm, such as a
network namespace that has only loopback (`unshare -rn`).
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

import yaml

sys.path.insert(0, str(Path(__file__).parents[1]))

from path_a.ros2 import LOOPBACK, PYTHON, environment, require, running
from path_a.row import NotMeasured

from ecm_extract.errors import EcmError
from ecm_extract.observe.model import Observation
from live_ros2.candidates import Candidate, Tree, candidates, of_node, python_path, tree_of
from live_ros2.rows import KINDS, Count, compared
from live_ros2.told import observation

ASKER = Path(__file__).parent / "programs" / "asker.py"
SETTLE_S = 20
GIVE_UP_S = 5.0
ANSWER_S = 200
Starts = Mapping[str, Sequence[str]]


@dataclass(frozen=True)
class Ran:
    """A node that ran.

    Attributes:
        program: `package/program`. tree: name of the source tree. node: its full name.
        modules: contracts that it is an instance of. counts: rows by kind.
    """

    program: str
    tree: str
    node: str
    modules: tuple[str, ...]
    counts: Mapping[str, Count]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trees", nargs="+", type=Path)
    parser.add_argument("--most", type=int, default=8, help="programs that run of one tree")
    parser.add_argument("--tries", type=int, default=24, help="programs that are tried of one tree")
    parser.add_argument("--only", action="append", default=[], help="PACKAGE/PROGRAM; may be repeated")
    parser.add_argument("--starts", type=Path, help="YAML: PACKAGE/PROGRAM: [arguments that it needs to run]")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    try:
        distribution = require(("rclpy",))
    except NotMeasured as reason:
        sys.exit(f"not measured: {reason}")
    print(f"ROS 2 {distribution}, {os.environ.get('RMW_IMPLEMENTATION', 'its own middleware')}", flush=True)
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    starts: Starts = yaml.safe_load(given.starts.read_text("utf-8")) if given.starts else {}
    ran = [each for path in given.trees for each in _of_tree(path.resolve(), given, starts)]
    _print(ran)
    if given.json:
        given.json.write_text(json.dumps([_data(each) for each in ran], indent=1))


def _of_tree(path: Path, given: argparse.Namespace, starts: Starts) -> Iterator[Ran]:
    try:
        tree = tree_of(path)
    except EcmError as error:
        print(f"{path.name}: {error}", flush=True)
        return
    found = [each for each in candidates(tree) if not given.only or each.name in given.only]
    count = 0
    for candidate in found[: given.tries]:
        ran = list(_run(tree, candidate, starts.get(candidate.name, ())))
        yield from ran
        count += bool(ran)
        if count == given.most:
            return


def _run(tree: Tree, candidate: Candidate, arguments: Sequence[str]) -> Iterator[Ran]:
    domain = 10 + os.getpid() % 80
    variables = environment(domain, PYTHONPATH=python_path(tree), PYTHONDONTWRITEBYTECODE="1")
    with TemporaryFile("w+") as log, running([*candidate.line, *arguments], variables, log) as process:
        if _ends(process):
            print(f"{candidate.name}: ends at once: {_last_line(log)}", flush=True)
            return
        told = _asked(domain)
        seen = _seen(domain)
        if not told.nodes:
            print(f"{candidate.name}: makes no node: {_last_line(log)}", flush=True)
    yield from _compared(tree, candidate, told, seen)


def _ends(process: subprocess.Popen[str]) -> bool:
    """Whether it is over within the time in which a program that lacks something gives up."""
    try:
        process.wait(GIVE_UP_S)
    except subprocess.TimeoutExpired:
        return False
    return True


def _last_line(log: IO[str]) -> str:
    log.seek(0)
    return next((line.strip() for line in reversed(log.read().splitlines()) if line.strip()), "it says nothing")


def _compared(tree: Tree, candidate: Candidate, told: Observation, seen: Observation) -> Iterator[Ran]:
    for node in told.nodes:
        own = of_node(tree, candidate, node.name)
        counts = compared(own, node.name, told, seen)
        modules = tuple(each.ecm.module_id for each in own)
        print("".join(f"{gap.what} {gap.why}\n" for gap in told.gaps), end="")
        result = Ran(candidate.name, tree.path.name, node.name, modules, counts)
        print(_shown(result), flush=True)
        yield result


def _asked(domain: int) -> Observation:
    line = [PYTHON, str(ASKER), str(SETTLE_S)]
    done = subprocess.run(line, env=environment(domain), capture_output=True, text=True, timeout=ANSWER_S, check=False)
    if done.returncode:
        sys.exit(f"rclpy does not answer: {done.stderr.strip()}")
    return observation(json.loads(done.stdout.strip().splitlines()[-1]))


def _seen(domain: int) -> Observation:
    from ecm_extract.observe.dds import watch_dds

    (seen,) = watch_dds(domain, 0, once=True)
    return seen


def _shown(ran: Ran) -> str:
    whole = ", ".join(f"{kind} {count.right}/{count.whole}" for kind, count in ran.counts.items() if count.whole)
    named = ", ".join(ran.modules) or "no contract"
    wrong = [f"  {kind}: {text}" for kind, count in ran.counts.items() for text in count.wrong]
    return "\n".join([f"{ran.program} as {ran.node} ({named}): {whole or 'nothing of its own'}", *wrong])


def _data(ran: Ran) -> dict[str, Any]:
    rows = {kind: {"right": count.right, "wrong": count.wrong} for kind, count in ran.counts.items()}
    return {"program": ran.program, "tree": ran.tree, "node": ran.node, "modules": ran.modules, "rows": rows}


def _print(ran: Sequence[Ran]) -> None:
    print(f"{len(ran)} nodes of {len({each.tree for each in ran})} trees")
    for kind in KINDS:
        right, whole = (sum(getattr(each.counts[kind], name) for each in ran) for name in ("right", "whole"))
        print(f"{kind}: {right} of {whole}" + (f" = {right / whole:.1%}" if whole else ""))


if __name__ == "__main__":
    main()
