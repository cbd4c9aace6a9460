"""Files of clones drawn by a seed, and the packages of a tree without reading its sources."""

from __future__ import annotations

import json
import random
import subprocess
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ecm_parsers import package_xml

from ecm_extract.discover import discover
from ecm_extract.exclusion import Exclusion
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.files import Files
from ecm_extract.system.package_folders import folders_read
from ecm_extract.tree import Tree, open_tree


@dataclass(frozen=True)
class Clone:
    """A tree with its packages, by name with their folders."""

    root: Path
    tree: Tree
    packages: tuple[PackageFacts, ...]

    @property
    def files(self) -> Files:
        """The files of the tree as launch files and descriptions name them."""
        return Files(self.tree, folders_read(self.packages))

    def folders(self) -> dict[str, str]:
        """Return the folder of each package on this machine."""
        return {package.name: str(self.root / package.root.path) for package in self.packages}


def read_clone(root: Path, ros: int | None) -> Clone:
    """Open a clone; all its packages are taken for those of one version of ROS."""
    tree = open_tree(root)
    found = []
    for package in discover(tree, Exclusion(())):
        if package.manifest is None:
            continue
        facts = package_xml.parse(tree.read(package.manifest)).facts if not package.rosbuild else None
        version = ros or (1 if facts is None else package_xml.ros_version(facts))
        found.append(PackageFacts(package, manifest=facts, ros=version))
    return Clone(root, tree, tuple(found))


def drawn(clones: Iterable[Path], seed: int, most: int, is_wanted: Callable[[Path], bool]) -> dict[Path, list[Path]]:
    """Return files by clone: at most some of each, in an order that a seed gives."""
    rng = random.Random(seed)
    found: dict[Path, list[Path]] = defaultdict(list)
    for clone in sorted(clones):
        files = sorted(path for path in clone.rglob("*") if path.is_file() and is_wanted(path))
        if files:
            found[clone] = rng.sample(files, min(most, len(files)))
    return found


def asked(command: list[str], files: Iterable[Path], **options: Any) -> Iterator[dict[str, Any]]:
    """Yield the answer of an oracle to each file: a JSON document after a mark, since readers print as they like."""
    text = "".join(f"{path}\n" for path in files)
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=False, **options)
    yield from (json.loads(part.split("\n", 1)[0]) for part in done.stdout.split("\x1e")[1:])
