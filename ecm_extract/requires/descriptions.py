"""Robot descriptions: the frames that joints hang on, and the descriptions that they include."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.robot_names import NamedLine

from ecm_extract.entities.descriptions import descriptions, tested, written_name
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required

_FOUND: Final = re.compile(r"\$\(find ([\w-]+)\)/(.+)")


def description_requirements(texts: SideTexts, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the descriptions of a package require; what a link of any of them provides is not asked of others."""
    read = list(descriptions(texts, facts))
    own = {written_name(entry.name) for _, names in read for entry in names.links}
    for path, names in read:
        by = f"description {path.rpartition('/')[2]}"
        for entry in names.parents:
            name = written_name(entry.name)
            if name not in own:
                yield from _under(entry, required("hangs_joint", name, Place(path, entry.line, by), "likely"))
        for entry in names.includes:
            found = _FOUND.fullmatch(entry.name)
            if found is not None:
                place = Place(path, entry.line, by)
                yield from _under(entry, required("includes_description", found[2], place, package=found[1]))


def _under(entry: NamedLine, found: Requirement) -> Iterator[Requirement]:
    """A requirement with the conditions around its line; nothing where they never hold."""
    when = tested(entry)
    if when is not None:
        conditions = tuple(each.text for each in when)
        yield msgspec.structs.replace(found, conditions=conditions, when=when) if when else found
