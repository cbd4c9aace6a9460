"""Files that git takes for moved between a package that is gone and a new one that is another.

What tools write for one robot is half the same for the next: a package became another one when its manifest moved
there, or nearly all that it had.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from ecm_extract.diff.file_moves import folder_moved
from ecm_extract.entities.side import PackageInfo, Side

_NEARLY_ALL: Final = 0.75


def without_likened(files: Mapping[str, str], old: Side, new: Side) -> Mapping[str, str]:
    """Return the new path of each file that moved, by its old one, without those to packages that are others."""
    fresh = {info.path for name, info in new.packages.items() if name not in old.packages}
    likened = {}
    for name, info in old.packages.items():
        target = folder_moved(info.path, files) if name not in new.packages else None
        if target in fresh and target != info.path and not _is_whole(info, files, old):
            likened[f"{info.path}/"] = f"{target}/"
    if not likened:
        return files
    return {path: to for path, to in files.items() if not any(map(_leads(path, to), likened.items()))}


def _leads(path: str, to: str) -> Callable[[tuple[str, str]], bool]:
    return lambda folders: path.startswith(folders[0]) and to.startswith(folders[1])


def _is_whole(package: PackageInfo, files: Mapping[str, str], old: Side) -> bool:
    """Whether its manifest moved, or nearly all of its files that are of kinds that can."""
    endings = {path.rpartition(".")[2] for path in files}
    had = [path for path in old.blobs if path.startswith(f"{package.path}/") and path.rpartition(".")[2] in endings]
    return package.manifest in files or sum(path in files for path in had) >= len(had) * _NEARLY_ALL
