"""Names that `rosdep` knows: packages released into a distribution, and keys for what the system provides.

The table is made from a copy of github.com/ros/rosdistro (`python -m ecm_extract.lint.known_packages DIR`), which lists
the packages of each distribution and the keys.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import yaml

FILE_NAME: Final = "known_packages.txt"
_ROS_1: Final = ("groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
_KEYS: Final = ("base", "python", "ruby")


@cache
def known_packages() -> Mapping[str, str]:
    """Return name -> where it is known: some of `1`, `2` (distributions of ROS 1, ROS 2) and `k` (a key of rosdep)."""
    text = (resources.files("ecm_extract.lint") / FILE_NAME).read_text("utf-8")
    rows = (line.partition(" ") for line in text.splitlines() if not line.startswith("#"))
    return MappingProxyType({name: where for name, _, where in rows})


def collected(folder: Path) -> dict[str, str]:
    """Return the same from a work tree of rosdistro.

    Raises:
        OSError: a file is not there.
        yaml.YAMLError: a file is no YAML.
    """
    found: dict[str, set[str]] = defaultdict(set)
    for path in sorted(folder.glob("*/distribution.yaml")):
        for name in _packages(_loaded(path)):
            found[name].add("1" if path.parent.name in _ROS_1 else "2")
    for key in _KEYS:
        for name in _loaded(folder / "rosdep" / f"{key}.yaml"):
            found[name].add("k")
    return {name: "".join(sorted(where)) for name, where in sorted(found.items())}


def _loaded(path: Path) -> dict[str, Any]:
    content = yaml.load(path.read_text("utf-8"), Loader=yaml.CSafeLoader)
    return content if isinstance(content, dict) else {}


def _packages(distribution: dict[str, Any]) -> Iterator[str]:
    for name, repository in distribution.get("repositories", {}).items():
        release = repository.get("release") or {}
        yield from release.get("packages") or [name]


def _main(folder: str) -> None:
    lines = [f"{name} {where}" for name, where in collected(Path(folder)).items()]
    text = "\n".join(["# Names known to rosdep, from github.com/ros/rosdistro; see known_packages.py.", *lines, ""])
    Path(__file__).with_name(FILE_NAME).write_text(text, "utf-8")


if __name__ == "__main__":
    _main(sys.argv[1])
