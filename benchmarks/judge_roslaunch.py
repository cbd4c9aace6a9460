"""Our reading of ROS 1 launch files against Debian's roslaunch: `judge_roslaunch.py CLONES... [--seed 0]`.

Launch files are drawn from clones by a seed and read with their default arguments, by roslaunch's own loader
(`apt-get install python3-roslaunch`) and by our reader; packages are those of the clone. Nothing is started,
commands that launch files name are not run. Both readers are given the same environment. Compared are nodes with their
program, remaps and parameters. Copies in install spaces, and packages that are marked to be ignored, are left out as
they are everywhere.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import subprocess
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from clone_files import Clone, asked, drawn, read_clone

from ecm_extract.system.evaluate import launched
from ecm_extract.system.model import Given, Instance, Launched

PYTHON = "/usr/bin/python3"
COMMAND = "<what a command prints>"
_FILE = "<content of "
_CONTENT = re.compile(r"\{content of (?:tree:)?([^}]*)\}")
KINDS = ("node", "remap", "parameter")


@dataclass
class Read:
    """What a reader says of a launch file: rows by kind, each a key with its value; open ones have no value here."""

    rows: dict[str, dict[str, Any]] = field(default_factory=lambda: {kind: {} for kind in KINDS})
    open: set[str] = field(default_factory=set)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path, nargs="+")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--most", type=int, default=8, help="files of one clone")
    given = parser.parse_args()
    if not _is_there():
        print("roslaunch is not installed: apt-get install --no-install-recommends python3-roslaunch")
        return 0
    clones = [path for folder in given.clones for path in folder.iterdir() if path.is_dir()]
    counts: Counter[str] = Counter()
    for clone, files in drawn(clones, given.seed, given.most, _is_launch_file).items():
        for line in _judged(clone, files, counts):
            print(line)
    return _summary(counts)


def _is_there() -> bool:
    command = [PYTHON, "-c", "import roslaunch"]
    return Path(PYTHON).exists() and not subprocess.run(command, capture_output=True, check=False).returncode


def _is_launch_file(path: Path) -> bool:
    """A launch file of ROS 1: nodes of ROS 2 name an executable."""
    if path.suffix != ".launch":
        return False
    text = path.read_text("utf-8", "replace")
    return "<launch" in text and " exec=" not in text and "$(find-pkg" not in text and "$(var" not in text


def _judged(clone: Path, files: list[Path], counts: Counter[str]) -> Iterator[str]:
    read = read_clone(clone, None)
    folders = [clone / package.root.path for package in read.packages]
    files = [path for path in files if any(path.is_relative_to(folder) for folder in folders)]
    files = [path for path in files if read.files.ros_of(str(path.relative_to(clone))) != 2]
    read = read_clone(clone, 1)
    with tempfile.TemporaryDirectory() as home:
        environment = {"PATH": os.environ["PATH"], "HOME": home, "ROS_HOME": home, "ROS_LOG_DIR": home}
        environment |= {"ROS_PACKAGE_PATH": str(clone), "ROS_MASTER_URI": "http://localhost:11311"}
        oracle = str(Path(__file__).parent / "roslaunch_oracle.py")
        answers = list(asked([PYTHON, oracle], files, env=environment, cwd=home))
    for path, truth in zip(files, answers, strict=True):
        if "refused" in truth:
            counts["refused"] += 1
            continue
        counts["files"] += 1
        relative = str(path.relative_to(clone))
        told = _told(launched(read.tree, read.files, [relative], Given(environment=environment)), read)
        differences = list(_differences(told, _truth(truth), counts))
        counts["files equal"] += not differences
        yield from (f"{clone.name}/{relative}: {text}" for text in differences)


def _truth(answer: dict[str, Any]) -> Read:
    read = Read()
    names: Counter[str] = Counter()
    for node in answer["nodes"]:
        key = _unique(node["name"], names)
        read.rows["node"][key] = f"{node['package']}/{node['type']}"
        read.rows["remap"].update({f"{key} {source}": target for source, target in node["remaps"].items()})
    read.rows["parameter"] = {name: value for name, value in answer["params"].items() if value != COMMAND}
    read.open = {name for name, value in answer["params"].items() if value == COMMAND}
    return read


def _unique(name: str, names: Counter[str]) -> str:
    """The key of a node; several may have one name, and the last one wins when they run."""
    names[name] += 1
    return name if names[name] == 1 else f"{name} #{names[name]}"


def _told(result: Launched, clone: Clone) -> Read:
    read = Read()
    names: Counter[str] = Counter()
    settings = list(result.globals)
    for instance in result.instances:
        key = _unique(instance.full_name or "", names)
        read.rows["node"][key] = _program(instance)
        if instance.conditional:
            read.open.add(key)
        for remap in instance.remaps:
            read.rows["remap"][f"{key} {_plain(remap.source)}"] = _plain(remap.target)
        settings += instance.settings
    for setting in settings:
        for name, value in _leaves(setting.name, setting.value):
            read.rows["parameter"][name] = _placed(value, clone.root)
    return read


def _program(instance: Instance) -> str:
    return f"{instance.package}/{instance.executable}"


def _plain(name: str) -> str:
    """A name as roslaunch keeps it."""
    while "//" in name:
        name = name.replace("//", "/")
    return name.rstrip("/") if len(name) > 1 else name


def _leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """A dictionary is a folder of parameters."""
    if not isinstance(value, dict) or not value:
        yield name, value
        return
    for key, inner in value.items():
        yield from _leaves(f"{name.rstrip('/')}/{key}", inner)


def _placed(value: Any, root: Path) -> Any:
    """A value with the paths of this machine; a text that is the content of a file is the name of the file."""
    if isinstance(value, list):
        return [_placed(item, root) for item in value]
    if not isinstance(value, str):
        return value
    content = _CONTENT.fullmatch(value)
    return (
        f"<content of {content[1]}>"
        if content is not None
        else value.replace("tree:/", f"{root}/").replace("tree:", f"{root}/")
    )


def _differences(told: Read, truth: Read, counts: Counter[str]) -> Iterator[str]:
    truth.rows["parameter"] = dict(
        leaf for name, value in truth.rows["parameter"].items() for leaf in _leaves(name, value)
    )
    for kind in KINDS:
        ours, theirs = told.rows[kind], truth.rows[kind]
        for key in sorted(ours.keys() | theirs.keys()):
            if key in truth.open or (key not in theirs and any(key.startswith(f"{name}/") for name in truth.open)):
                continue
            outcome = _outcome(key, ours, theirs)
            counts[f"{kind} {outcome}"] += 1
            if outcome != "equal":
                yield f"{outcome} {kind} {key}: ours {_shown(ours.get(key))}, roslaunch {_shown(theirs.get(key))}"


def _outcome(key: str, ours: dict[str, Any], theirs: dict[str, Any]) -> str:
    if key not in ours:
        return "missing"
    if key not in theirs:
        return "false"
    return "equal" if _is_same(ours[key], theirs[key]) else "other"


def _is_same(one: Any, other: Any) -> bool:
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one) and math.isnan(other):
        return True
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_is_same, one, other))
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_is_same(one[key], other[key]) for key in one)
    if isinstance(one, str) and isinstance(other, str) and one.startswith(_FILE) and other.startswith(_FILE):
        # Ours is named from the root of the tree.
        return other.endswith(one.removeprefix(_FILE).lstrip("/"))
    return type(one) is type(other) and bool(one == other)


def _shown(value: Any) -> str:
    return repr(value)[:80]


def _summary(counts: Counter[str]) -> int:
    print(f"{counts['files equal']} of {counts['files']} files equal; roslaunch refused {counts['refused']} more")
    low = 0
    for kind in KINDS:
        found = {outcome: counts[f"{kind} {outcome}"] for outcome in ("equal", "other", "missing", "false")}
        total = max(sum(found.values()), 1)
        low += found["equal"] / total < 0.99
        print(f"{kind}s: {found['equal'] / total:.2%} equal of {total}; {found}")
    return 1 if low else 0


if __name__ == "__main__":
    raise SystemExit(main())
