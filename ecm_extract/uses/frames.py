"""Frames that are gone: joints hung on them, look-ups, parameters that name them; descriptions that are included."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from ecm_parsers.parameter_yaml import parse_parameter_yaml

from ecm_extract.diff.model import Located
from ecm_extract.discover import is_test_path
from ecm_extract.entities.descriptions import MAX_BYTES, descriptions, written_name
from ecm_extract.entities.side import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_FOUND: Final = re.compile(r"\$\(find ([\w-]+)\)/(.+)")
_NAMES_FRAME: Final = re.compile(r"(?:frame|frame_id|link)s?$")
_Gone = Mapping[str, Located]


def frame_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of a workspace that name a frame, or include a description, that is gone."""
    frames = _gone_frames(index)
    files = {_file(entry): entry for entry in index.of_kind("file") if entry.change.change in GONE}
    for facts in workspace.packages if frames or files else ():
        yield from _of_descriptions(workspace, facts, frames, files)
        yield from _of_parameters(workspace, facts, frames) if frames else ()
    for module in workspace.linked if frames else ():
        for entry in module.interfaces:
            for name in (entry.frame or "").split(" <- ") if entry.role == "tf_lookup" else ():
                if name in frames:
                    at = entry.evidence[0]
                    place = Place(module.module.package, at.path, at.line)
                    yield use_at(frames[name], place, f"looks up a transform of {name}", "likely")


def _gone_frames(index: ChangeIndex) -> _Gone:
    """Changes by the name of a frame that no description of the new side has any more."""
    offered = {entity.name for entity in index.offered("frame", "")}
    gone = (entry for entry in index.of_kind("frame") if entry.change.change in GONE)
    named = ((entry.pair.old.name, entry) for entry in gone if entry.pair.old is not None)
    return {name: entry for name, entry in named if name not in offered}


def _file(located: Located) -> tuple[str, str]:
    old = located.pair.old
    return (old.package, old.name) if old is not None else ("", "")


def _of_descriptions(
    workspace: Workspace, facts: PackageFacts, frames: _Gone, files: Mapping[tuple[str, str], Located]
) -> Iterator[Use]:
    read = list(descriptions(workspace.tree, facts))
    own = {written_name(entry.name) for _, names in read for entry in names.links}
    for path, names in read:
        for entry in names.parents:
            name = written_name(entry.name)
            if name in frames and name not in own:
                place = Place(facts.name, path, entry.line)
                yield use_at(frames[name], place, f"hangs a joint on {name}", "likely")
        for entry in names.includes:
            found = _FOUND.fullmatch(entry.name)
            located = files.get((found[1], found[2])) if found is not None else None
            if located is not None:
                yield use_at(located, Place(facts.name, path, entry.line), f"includes {entry.name}")


def _of_parameters(workspace: Workspace, facts: PackageFacts, frames: _Gone) -> Iterator[Use]:
    paths = [
        entry.path
        for entry in facts.root.files
        if entry.path.endswith((".yaml", ".yml")) and not is_test_path(entry.path, facts.root.path)
    ]
    for path, data in workspace.tree.read_many(sorted(paths)):
        for entry in parse_parameter_yaml(data).facts.sets if len(data) <= MAX_BYTES else ():
            for name in _texts(entry.value) if _NAMES_FRAME.search(entry.name) else ():
                if name in frames:
                    place = Place(facts.name, path, entry.line)
                    yield use_at(frames[name], place, f"sets {entry.name} to {name}", "likely")


def _texts(value: object) -> Iterable[str]:
    items = value if isinstance(value, list) else [value]
    return [item for item in items if isinstance(item, str)]
