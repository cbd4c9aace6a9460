"""Launch files by their paths, and the values that each names, needs or reads: what other files can hand it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import Action, Argument, LaunchFile, SetConfiguration
from ecm_parsers.launch.templates import all_actions, plain_text

from ecm_extract.entities.launch_reads import is_partly_read, reads
from ecm_extract.entities.paths import inside
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.launch_files import is_aside

FILE: Final = "launch_path"
VALUE: Final = "launch_value"
NAMED: Final = "named"
"""Facet of what a file gives a name."""
NEEDED: Final = "needed"
"""Facet of what it declares without a value, whatever the conditions."""
READ: Final = "read"
"""Facet of what it reads with a default of its own."""
_TEMPLATES: Final = ("/templates/", "/template/")


def is_judged(path: str) -> bool:
    """Tell whether a launch file is one that runs as it is: no template, and none that is put aside."""
    return not is_aside(path) and not any(part in f"/{path}" for part in _TEMPLATES)


def launch_values(facts: PackageFacts, launches: Iterable[tuple[str, LaunchFile]]) -> Iterator[Provision]:
    """Yield each launch file of a package by its path from there, and the values that it has."""
    for path, file in launches:
        if is_judged(path):
            name = inside(path, facts.root.path)
            base = Provision(kind=VALUE, package=facts.name, owner="", name=name, path=path, line=1, ros=file.ros)
            yield msgspec.structs.replace(base, kind=FILE, open=file.ros == 2 and is_partly_read(file))
            yield from _values(file, msgspec.structs.replace(base, owner=base.name))


def _values(file: LaunchFile, base: Provision) -> Iterator[Provision]:
    """Each value once, by the first line that says it."""
    found: dict[tuple[str, str], int] = {}
    for action in all_actions(file.actions):
        for facet, name in _of_action(action):
            found.setdefault((facet, name), action.line)
    for action in file.actions:
        if isinstance(action, Argument) and _is_needed(action):
            found[NEEDED, action.name] = action.line
    for each in reads(file):
        found.setdefault((READ, each.name), each.line)
    for (facet, name), line in found.items():
        yield msgspec.structs.replace(base, name=name, facet=facet, line=line)


def _of_action(action: Action) -> Iterator[tuple[str, str]]:
    if isinstance(action, Argument):
        yield NAMED, action.name
    elif isinstance(action, SetConfiguration):
        name = plain_text(action.name)
        if name:
            yield NAMED, name


def _is_needed(action: Argument) -> bool:
    return action.condition is None and action.default is None and action.value is None
