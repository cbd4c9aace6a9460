"""The C++ and Python files of a tree, by package, as the benchmarks count them."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec

CPP = {".cpp", ".cc", ".cxx", ".h", ".hpp", ".hh", ".hxx", ".ipp", ".inl", ".tpp"}
_IGNORE = {"COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"}
_LARGEST = 8_000_000

IsTest = Callable[[str, str], bool]
"""Whether the file of this path is test code, in the package at this path (both below the root)."""


class Source(msgspec.Struct, frozen=True):
    """One source file: its text, and the ROS generations of the package that holds it."""

    path: str
    lang: str
    ros: frozenset[int]
    text: str


def walk(root: Path, is_test: IsTest, skipped: Counter[str]) -> Iterator[Source]:
    """Yield the product sources of every package under `root`; count in `skipped` the files left out."""
    packages: dict[Path, frozenset[int]] = {}
    for folder, folders, files in os.walk(root):
        here = Path(folder)
        if _IGNORE & set(files):
            folders.clear()
            skipped["in_an_ignored_folder"] += sum(language(path) is not None for path in here.rglob("*"))
            continue
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        if "package.xml" in files:
            packages[here] = generations(here / "package.xml")
        for name in sorted(files):
            yield from _source(root, here / name, packages, is_test, skipped)


def _source(
    root: Path,
    path: Path,
    packages: dict[Path, frozenset[int]],
    is_test: IsTest,
    skipped: Counter[str],
) -> Iterator[Source]:
    lang = language(path)
    if lang is None:
        return
    relative = path.relative_to(root).as_posix()
    owner = next((folder for folder in path.parents if folder in packages), None)
    if owner is None:
        skipped["in_no_package"] += 1
    elif is_test(relative, owner.relative_to(root).as_posix().removeprefix(".")):
        skipped["test_code"] += 1
    else:
        yield Source(relative, lang, packages[owner], path.read_bytes()[:_LARGEST].decode("utf-8", "replace"))


def language(path: Path) -> str | None:
    """`cpp` or `python` by suffix, or by the first line of an executable script; else None."""
    if path.is_symlink() or not path.is_file():
        return None
    if path.suffix in CPP:
        return "cpp"
    if path.suffix == ".py":
        return "python"
    if path.suffix or not os.access(path, os.X_OK):
        return None
    with path.open("rb") as stream:
        first = stream.readline(200)
    return "python" if first.startswith(b"#!") and b"python" in first else None


def generations(manifest: Path) -> frozenset[int]:
    """ROS 1, ROS 2 or both, as the dependencies of a package.xml tell; both when they tell nothing."""
    text = re.sub(r"<!--.*?-->", "", manifest.read_text("utf-8", "replace"), flags=re.DOTALL)
    first = re.search(r">\s*(?:catkin|roscpp|rospy)\s*<", text) is not None
    second = re.search(r">\s*(?:ament_\w+|rclcpp\w*|rclpy|rosidl_default_generators)\s*<", text) is not None
    return frozenset(number for number, known in ((1, first), (2, second)) if known or not (first or second))
