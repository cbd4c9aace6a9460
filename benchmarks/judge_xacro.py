"""Our descriptions against xacro: `python benchmarks/judge_xacro.py CLONES [--seed 0] [--most 6]`.

Descriptions are drawn from clones by a seed and expanded with their default arguments, by xacro (`pip install
'ecm-extract[judges]'`) and by our reader; packages are those of the clone. Links, joints and ros2_control tags must be
the same for each that xacro accepts.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from clone_files import asked, drawn, read_clone

from ecm_extract.description.model import Description, Hardware
from ecm_extract.description.read import read_description

KINDS = ("links", "joints", "control")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--most", type=int, default=6, help="files of one clone")
    parser.add_argument("--only", help="text that the path of a clone holds")
    given = parser.parse_args()
    if importlib.util.find_spec("xacro") is None:
        print("xacro is not installed: pip install 'ecm-extract[judges]'")
        return 0
    clones = [path for path in given.clones.iterdir() if path.is_dir() and (given.only or "") in path.name]
    counts: Counter[str] = Counter()
    for clone, files in drawn(clones, given.seed, given.most, _is_robot).items():
        for line in _judged(clone, files, counts):
            print(line)
    return _summary(counts)


def _is_robot(path: Path) -> bool:
    """A description that is whole: its root has a name, and it is not all macros."""
    if path.suffix not in {".xacro", ".urdf"}:
        return False
    text = path.read_text("utf-8", "replace")
    return "<robot" in text and ("name=" in text.partition("<robot")[2].partition(">")[0])


def _judged(clone: Path, files: list[Path], counts: Counter[str]) -> Iterator[str]:
    # xacro of today knows no element without its prefix, as that of ROS 2 never did.
    read = read_clone(clone, 2)
    with tempfile.NamedTemporaryFile("w", suffix=".json") as packages:
        json.dump(read.folders(), packages)
        packages.flush()
        command = [sys.executable, str(Path(__file__).parent / "xacro_oracle.py"), packages.name]
        answers = list(asked(command, files))
    known = read.files
    for path, truth in zip(files, answers, strict=True):
        relative = str(path.relative_to(clone))
        if "refused" in truth or not (truth["links"] or truth["control"]):
            counts["refused or empty"] += 1
            continue
        counts["files"] += 1
        told = _told(read_description(relative, {}, known))
        differences = list(_differences(told, truth, counts))
        counts["files equal"] += not differences
        yield from (f"{clone.name}/{relative}: {text}" for text in differences)


def _told(description: Description) -> dict[str, Any]:
    return {
        "links": sorted(link.name for link in description.links),
        "joints": sorted([joint.name, joint.kind, joint.parent, joint.child] for joint in description.joints),
        "control": sorted(_control(entry) for entry in description.hardware),
        "problems": [problem.message for problem in description.problems],
    }


def _control(entry: Hardware) -> list[Any]:
    parts = sorted([part.kind, part.name, sorted(part.command), sorted(part.state)] for part in entry.parts)
    return [entry.name, entry.kind, entry.plugin, parts]


def _differences(told: dict[str, Any], truth: dict[str, Any], counts: Counter[str]) -> Iterator[str]:
    for kind in KINDS:
        ours, theirs = _counted(told[kind]), _counted(truth[kind])
        counts[f"{kind} equal"] += (ours & theirs).total()
        counts[f"{kind} missing"] += (theirs - ours).total()
        counts[f"{kind} false"] += (ours - theirs).total()
        if ours != theirs:
            missing, false = list((theirs - ours).elements()), list((ours - theirs).elements())
            cause = "; ".join(told["problems"][:2]) or "no problem told"
            yield f"{kind}: missing {len(missing)} {missing[:3]}, false {len(false)} {false[:3]}: {cause}"


def _counted(rows: list[Any]) -> Counter[str]:
    return Counter(json.dumps(row) for row in rows)


def _summary(counts: Counter[str]) -> int:
    print(f"{counts['files equal']} of {counts['files']} files equal; {counts['refused or empty']} refused or empty")
    bad = 0
    for kind in KINDS:
        missing, false = counts[f"{kind} missing"], counts[f"{kind} false"]
        total = counts[f"{kind} equal"] + missing + false
        bad += missing + false
        equal = counts[f"{kind} equal"] / max(total, 1)
        print(f"{kind}: {equal:.2%} equal of {total}, missing {missing}, false {false}")
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(main())
