"""Parameters that the files of a package set: who starts its launch files runs with these values, not with defaults.

A file counts where users get it: an install rule names it, or a launch file of its own package loads it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Final

from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import Action, Group, LaunchFile, Node, ParameterFile
from ecm_parsers.launch.templates import written
from ecm_parsers.parameter_yaml import ParameterSet, parse_parameter_yaml
from ecm_parsers.python_setup_facts import PythonSetup

from ecm_extract.entities.setting import SETTING
from ecm_extract.entities.side_texts import PARAMETERS, SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_path

FILE: Final = "parameter_file"
_MAX_INTEGER: Final = 2**63
_COPIED: Final = frozenset({"directory", "files"})


def parameter_settings(
    texts: SideTexts, facts: PackageFacts, launches: Sequence[tuple[str, LaunchFile]]
) -> Iterator[Provision]:
    """Yield the files that users get, and each parameter that one sets, whose owner is the file within the package."""
    loaded = _loaded(facts, launches)
    candidates = loaded | _installed(facts)
    for path, data in texts.read_many(sorted(candidates)):
        yield Provision(kind=FILE, package=facts.name, owner="", name=_inside(path, facts), path=path, line=1)
        file = texts.told(path, parse_parameter_yaml(data))
        if file.ros == 2 or path in loaded:  # any map is a parameter file of ROS 1
            yield from (_setting(entry, path, file.ros, facts) for entry in file.sets)


def _setting(entry: ParameterSet, path: str, ros: int, facts: PackageFacts) -> Provision:
    return Provision(
        kind=SETTING,
        package=facts.name,
        owner=_inside(path, facts),
        name=f"{entry.node.lstrip('/')}.{entry.name}" if entry.node else entry.name,
        default=plain(entry.value),
        ros=ros,
        path=path,
        line=entry.line,
    )


def plain(value: object) -> object:
    """A value as every document can hold it; a list, a map and a number that JSON has no form for are text."""
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int) and abs(value) < _MAX_INTEGER:
        return value
    return value if isinstance(value, float) and math.isfinite(value) else str(value)


def _files(facts: PackageFacts) -> Iterator[str]:
    for entry in facts.root.files:
        if entry.path.endswith(PARAMETERS) and not is_test_path(entry.path, facts.root.path):
            yield entry.path


def _inside(path: str, facts: PackageFacts) -> str:
    return _below(path, facts.root.path)


def _below(path: str, folder: str) -> str:
    return path.removeprefix(f"{folder}/") if folder not in {"", "."} else path


def _installed(facts: PackageFacts) -> set[str]:
    places = [*_of_cmake(facts), *(place for path, setup in facts.setups.items() for place in _of_setup(path, setup))]
    return {path for path in _files(facts) for place in places if _is_at(PurePosixPath(path), place)}


def _of_cmake(facts: PackageFacts) -> Iterator[PurePosixPath]:
    for path, file in facts.cmake.items():
        for rule in file.installs:
            if rule.kind in _COPIED:
                yield from (PurePosixPath(path).parent / item for item in rule.items)


def _of_setup(path: str, setup: PythonSetup) -> Iterator[PurePosixPath]:
    for entry in setup.data_files:
        yield from (PurePosixPath(path).parent / item for item in entry.files)


def _is_at(path: PurePosixPath, place: PurePosixPath) -> bool:
    """Whether a file is what a rule names, lies below the folder that it names, or fits its pattern."""
    return place == path or place in path.parents or (len(place.parts) == len(path.parts) and path.match(str(place)))


def _loaded(facts: PackageFacts, launches: Iterable[tuple[str, LaunchFile]]) -> set[str]:
    prefix = f"$(find {facts.name})/"
    named = {written(file.path) for _, launch in launches for file in _parameter_files(launch.actions)}
    inside = {name.removeprefix(prefix) for name in named if name.startswith(prefix)}
    return {path for path in _files(facts) if _inside(path, facts) in inside}


def _parameter_files(actions: Iterable[Action]) -> Iterator[ParameterFile]:
    for action in actions:
        if isinstance(action, ParameterFile):
            yield action
        elif isinstance(action, Group):
            yield from _parameter_files(action.actions)
        elif isinstance(action, Node):
            yield from (each for each in action.sources if isinstance(each, ParameterFile))
            yield from _parameter_files(action.components)
