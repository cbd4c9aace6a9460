"""Contents that the documents of packages keep, so that launch files can be evaluated without the sources."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
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
"""Of one file: parameter files and descriptions that people write are smaller by far."""
_ENDS: Final = (*DESCRIPTIONS, *PARAMETERS, ".xml", ".srdf", ".sdf", ".gazebo")
_PYTHON: Final = ".py"


def kept_texts(tree: Tree, texts: SideTexts, packages: Sequence[PackageFacts]) -> Mapping[str, str]:
    """Return the contents, by path, of what launch files are and read; too large and undecodable ones are left out."""
    listed = {entry.path for facts in packages for entry in facts.root.files}
    wanted = {path for path in listed if path.endswith(_ENDS) or is_launch_file(path)}
    wanted |= set(_imported(tree, packages)) & listed
    decoded = ((path, _text(data)) for path, data in texts.read_many(sorted(wanted)))
    return {path: text for path, text in decoded if text is not None}


def _imported(tree: Tree, packages: Sequence[PackageFacts]) -> Iterator[str]:
    """Files that launch files in Python import and open, as they do when nobody gives them an argument."""
    files = Files(tree, folders_read(packages))
    for facts in packages:
        for entry in facts.root.files:
            if entry.path.endswith(_PYTHON) and is_launch_file(entry.path):
                yield from _read_by(entry.path, facts, files)


def _read_by(path: str, facts: PackageFacts, files: Files) -> Iterator[str]:
    data = files.read(path)
    if data is not None:
        sources = LaunchSources(files, path, Scope(), Budget())
        read_launch(path, data, facts.ros, sources)
        yield from sources.read


def _text(data: bytes) -> str | None:
    if len(data) > MAX_BYTES:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None
