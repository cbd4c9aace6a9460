"""Real ROS 1 nodes of clones under Debian's master, beside their contracts.

python benchmarks/live_ros1/run.py TREE... [--most 4] [--messages DIR] [--json FILE]

Starts scripts of rospy straight from the trees, one at a time, and compares what each registers and which parameters it
asks for with its contract. Messages that Debian lacks are made in memory, those of other trees with `--messages`. A
row whose lines did not run (a branch, a callback that nobody called) is told as not reached. A script that registers no
node (it needs hardware, Python 2, or a library that is not here) is left out. The code of the trees is run: do it where
it can do no harm, such as a network namespace that has only loopback (`unshare -rn`) and a file system of its own.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from path_a.ros1 import PACKAGES, Master, require
from path_a.row import NotMeasured

from ecm_extract.errors import EcmError
from ecm_extract.observe.model import Observation
from ecm_extract.observe.ros1 import watch_ros1
from ecm_extract.observe.standard import is_tool
from live_ros1.candidates import Candidate, candidates
from live_ros1.recording import recording
from live_ros1.rows import Compared, Line, compared

HOOK = Path(__file__).parent / "hook"
LINES = "lines.txt"
SETTLE_S = 1.5
LIMIT_S = 8.0


@dataclass(frozen=True)
class Ran:
    """A node that ran: its module, its rows."""

    module: str
    tree: str
    node: str
    rows: Compared


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trees", nargs="+", type=Path)
    parser.add_argument("--most", type=int, default=4, help="nodes that run of one tree")
    parser.add_argument("--tries", type=int, default=16, help="scripts that are tried of one tree")
    parser.add_argument("--messages", type=Path, action="append", default=[], help="tree with more messages")
    parser.add_argument("--json", type=Path)
    given = parser.parse_args()
    try:
        require(("rospy", "genpy.dynamic"), PACKAGES)
    except NotMeasured as reason:
        sys.exit(f"not measured: {reason}")
    ran = [each for tree in given.trees for each in _of_tree(tree.resolve(), given)]
    _print(ran)
    if given.json:
        given.json.write_text(json.dumps([_data(each) for each in ran], indent=1))


def _of_tree(tree: Path, given: argparse.Namespace) -> Iterator[Ran]:
    count = 0
    try:
        found = list(candidates(tree))[: given.tries]
    except EcmError as error:
        print(f"{tree.name}: {error}", flush=True)
        return
    for candidate in found:
        result = _run(candidate, [tree, *map(Path.resolve, given.messages)])
        if result is not None:
            count += 1
            yield result
        if count == given.most:
            return


def _run(candidate: Candidate, trees: Sequence[Path]) -> Ran | None:
    with tempfile.TemporaryDirectory() as folder:
        core = Master(folder)
        try:
            with recording(core.uri) as master:
                sources = {path.parent.parent for path in candidate.tree.glob("**/src/*/__init__.py")}
                core.set(
                    ROS_MASTER_URI=master.uri,
                    ECM_LIVE_TREE=os.pathsep.join(map(str, trees)),
                    ECM_LIVE_LINES=f"{folder}/{LINES}",
                    PYTHONPATH=":".join([str(HOOK), str(candidate.script.parent), *sorted(map(str, sources))]),
                    PYTHONDONTWRITEBYTECODE="1",
                )
                process = core.start(candidate.script, cwd=folder)
                seen = _settled(core.uri, process)
                nodes = [node.name for node in seen.nodes if not is_tool(node.name)]
                asked = set(master.asked)
                lines = set(_lines(candidate.tree, Path(folder) / LINES))
        finally:
            core.stop_all()
    if len(nodes) != 1:
        return None
    rows = compared(candidate.contract, nodes[0], seen, asked, lines)
    result = Ran(candidate.contract.ecm.module_id, candidate.tree.name, nodes[0], rows)
    print(_shown(result), flush=True)
    return result


def _lines(tree: Path, noted: Path) -> Iterator[Line]:
    """The lines of a tree that ran; the last one may be half written."""
    for text in noted.read_text("utf-8").splitlines() if noted.exists() else ():
        path, _, number = text.rpartition(":")
        if number.isdigit() and Path(path).is_relative_to(tree):
            yield Path(path).relative_to(tree).as_posix(), int(number)


def _settled(uri: str, process: subprocess.Popen[str]) -> Observation:
    """Look until a node has registered and nothing more comes, or until the script is over."""
    start = last = time.monotonic()
    known: Sequence[object] = ()
    while True:
        (seen,) = watch_ros1(uri, 0, once=True)
        now = time.monotonic()
        if seen.endpoints != known:
            known, last = seen.endpoints, now
        registered = any(not is_tool(node.name) for node in seen.nodes)
        over = process.poll() is not None or now - start > LIMIT_S
        if over or (registered and now - last > SETTLE_S):
            return seen
        time.sleep(0.3)


def _shown(ran: Ran) -> str:
    rows = ran.rows
    missed = [f"  missed {role} {name}" for role, name in sorted(rows.registered - rows.known)]
    false = [f"  not registered {role} {name}" for role, name in sorted(rows.promised - rows.kept - rows.unreached)]
    idle = [f"  not reached {role} {name}" for role, name in sorted(rows.unreached)]
    counts = f"{len(rows.known)}/{len(rows.registered)}, {len(rows.kept)}/{len(rows.promised - rows.unreached)}"
    head = f"{ran.tree} {ran.module} as {ran.node}: {counts}"
    return "\n".join([head, *missed, *false, *idle])


def _data(ran: Ran) -> dict[str, object]:
    rows = ran.rows
    return {
        "module": ran.module,
        "tree": ran.tree,
        "node": ran.node,
        "missed": sorted(rows.registered - rows.known),
        "not_registered": sorted(rows.promised - rows.kept - rows.unreached),
        "not_reached": sorted(rows.unreached),
        "registered": len(rows.registered),
        "promised": len(rows.promised),
    }


def _print(ran: Sequence[Ran]) -> None:
    print(f"{len(ran)} nodes of {len({each.tree for each in ran})} trees")
    known, registered = (sum(len(getattr(each.rows, name)) for each in ran) for name in ("known", "registered"))
    kept, promised, idle = (
        sum(len(getattr(each.rows, name)) for each in ran) for name in ("kept", "promised", "unreached")
    )
    for name, part, whole in (("recall", known, registered), ("precision", kept, promised - idle)):
        print(f"{name}: {part} of {whole}" + (f" = {part / whole:.1%}" if whole else ""))
    print(f"promised and not reached: {idle}")


if __name__ == "__main__":
    main()
