"""Contents that the documents of packages keep, so that launch files can be evaluated without the sources."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import accumulate
from typing import Final

from ecm_extract.entities.side_texts import DESCRIPTIONS, PARAMETERS, SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.budget import Budget
from ecm_extract.system.files import Files
from ecm_extract.system.launch_files import is_launch_file, read_launch
from ecm_extract.system.launch_sources import LaunchSources
from ecm_extract.system.package_folders import folders_read
from ecm_extract.system.scope import Scope
from ecm_extract.tree import Tree

MAX_BYTES: Final = 256_000
"""Of one file, and of all together that lie in no package: what people write is smaller by far."""
_ENDS: Final = (*DESCRIPTIONS, *PARAMETERS, ".xml", ".srdf", ".sdf", ".gazebo")
_PYTHON: Final = ".py"


def kept_texts(
    tree: Tree, texts: SideTexts, packages: Sequence[PackageFacts], shared: Sequence[str]
) -> Mapping[str, str]:
    """Return the contents, by path, of what launch files are and read; too large and undecodable ones are left out.

    Args:
        tree: that was read.
        texts: gives contents of its files.
        packages: of the tree.
        shared: paths of what lies outside of packages and concerns all of them.
    """
    owned = {entry.path for facts in packages for entry in facts.root.files}
    listed = owned.union(shared)
    wanted = {path for path in listed if path.endswith(_ENDS) or is_launch_file(path)}
    wanted |= set(_imported(tree, packages, listed)) & listed
    kept = _decoded(texts, wanted & owned)
    return kept | _first(_decoded(texts, wanted - owned))


def _decoded(texts: SideTexts, paths: Collection[str]) -> dict[str, str]:
    decoded = ((path, _text(data)) for path, data in texts.read_many(sorted(paths)))
    return {path: text for path, text in decoded if text is not None}


def _first(found: Mapping[str, str]) -> dict[str, str]:
    """Texts up to the bound: each package's document repeats those that lie in no package."""
    sizes = accumulate(len(text) for text in found.values())
    return {path: text for (path, text), size in zip(found.items(), sizes, strict=True) if size <= MAX_BYTES}


def _imported(tree: Tree, packages: Sequence[PackageFacts], listed: Collection[str]) -> Iterator[str]:
    """Files that launch files in Python import and open, as they do when nobody gives them an argument."""
    files = Files(tree, folders_read(packages))
    for path in sorted(listed):
        if path.endswith(_PYTHON) and is_launch_file(path):
            yield from _read_by(path, files)


def _read_by(path: str, files: Files) -> Iterator[str]:
    data = files.read(path)
    if data is not None:
        sources = LaunchSources(files, path, Scope(), Budget())
        read_launch(path, data, files.ros_of(path), sources)
        yield from sources.read


def _text(data: bytes) -> str | None:
    if len(data) > MAX_BYTES:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None
