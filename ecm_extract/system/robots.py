"""Robot descriptions that a launch gives to its nodes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ecm_extract.description.model import Description
from ecm_extract.description.read import read_description
from ecm_extract.system.files import TREE, Files
from ecm_extract.system.model import Launched

_FILE = re.compile(r"tree:[^\s'\"{}]+\.(?:urdf\.xacro|xacro|urdf)")
_GIVEN = re.compile(r"(\w+):=(\"[^\"]*\"|'[^']*'|[^\s}]*)")
MAX_ROBOTS = 20


@dataclass(frozen=True, slots=True)
class Robots:
    """Descriptions that a launch names, each once, and the paths of those that are too many to be read."""

    found: list[Description]
    left_out: list[str]


def descriptions_of(launched: Launched, files: Files) -> Robots:
    """Return the descriptions that parameters and command lines of a launch name."""
    left_out: dict[str, None] = {}
    found: dict[tuple[str, tuple[tuple[str, str], ...]], Description] = {}
    for text in _texts(launched):
        for match in _FILE.finditer(text):
            path = files.find(match[0])
            if path is None or ".srdf" in path:
                continue
            given = tuple((name, value.strip("\"'")) for name, value in _GIVEN.findall(text[match.end() :]))
            known = {name: value for name, value in given if "{" not in value}
            key = (path, tuple(sorted(known.items())))
            if key not in found and len(found) >= MAX_ROBOTS:
                left_out[path] = None
            elif key not in found:
                found[key] = read_description(path, known, files)
    return Robots(list(found.values()), list(left_out))


def controller_files(descriptions: list[Description]) -> list[str]:
    """Return the parameter files that simulator plugins give their controller manager, as marked paths."""
    return [
        path
        for description in descriptions
        for plugin in description.plugins
        for path in plugin.files
        if path.startswith(TREE)
    ]


def _texts(launched: Launched) -> Iterator[str]:
    for setting in launched.globals:
        yield str(setting.value)
    for instance in launched.instances:
        for setting in instance.settings:
            if isinstance(setting.value, str):
                yield setting.value
        yield " ".join(word.text for word in instance.arguments)
