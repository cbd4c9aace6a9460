"""Launch files that lie in no package, as in a folder that the build ignores, and what they may read beside them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Final

from ecm_checker.hub.package import folders_of

from ecm_extract.entities.side_texts import DESCRIPTIONS, PARAMETERS
from ecm_extract.system.launch_files import is_aside, is_launch_file
from ecm_extract.tree import Entry

_READ: Final = (*DESCRIPTIONS, *PARAMETERS)


def launches_outside(entries: Sequence[Entry], owned: Collection[str]) -> list[Entry]:
    """Return launch files outside of packages with the parameter files and descriptions around their folders.

    Args:
        entries: of a tree.
        owned: paths of the files of its packages.
    """
    outside = [entry for entry in entries if entry.path not in owned and not is_aside(entry.path)]
    around = {_around(entry.path) for entry in outside if is_launch_file(entry.path)}
    return [entry for entry in outside if is_launch_file(entry.path) or _is_read(entry.path, around)]


def _is_read(path: str, around: Collection[str]) -> bool:
    return path.endswith(_READ) and any(folder in around for folder in ("", *folders_of(path)))


def _around(path: str) -> str:
    """The folder that holds the folder of a launch file: `config` stands there beside `launch`."""
    return path.rpartition("/")[0].rpartition("/")[0]
