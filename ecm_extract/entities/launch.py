"""Launch files that a package offers, and the arguments that whoever includes them can give."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath
from typing import Final

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import Argument, Include, LaunchFile
from ecm_parsers.launch.templates import all_actions, written

from ecm_extract.entities.launch_conditions import arguments, taken
from ecm_extract.entities.launch_reads import is_open, reads
from ecm_extract.entities.launch_runs import runs_of
from ecm_extract.entities.nodes import launched_nodes
from ecm_extract.entities.paths import inside
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.launch_files import is_launch_file, read_launch
from ecm_extract.test_code import is_test_path

_XML: Final = ".xml"
"""Of a launch file that only who includes it tells to be one."""


def launch_entities(facts: PackageFacts, launches: Sequence[tuple[str, LaunchFile]]) -> Iterator[Provision]:
    """Yield the launch files of a package, their arguments and nodes; a file goes by its name, as for `ros2 launch`."""
    for path, file in launches:
        name = PurePosixPath(path).name
        base = Provision(kind="launch_argument", package=facts.name, owner=name, name="", path=path, line=1)
        runs = runs_of(file, facts.name, inside(path, facts.root.path))
        yield msgspec.structs.replace(base, kind="launch_file", owner="", name=name, bases=runs, open=is_open(file))
        yield from launched_nodes(facts, path, name, file.actions)
        for each in taken(file.actions):
            argument = each.action
            if not isinstance(argument, Argument) or argument.value is not None:
                continue
            yield msgspec.structs.replace(
                base,
                name=argument.name,
                default=None if argument.default is None else written(argument.default),
                deprecated=argument.description if "deprecat" in argument.description.lower() else None,
                line=argument.line,
                when=each.when,
            )
        named = {argument.name for argument in arguments(file.actions)}
        for read in {found.name: found for found in reads(file) if found.name not in named}.values():
            yield msgspec.structs.replace(base, name=read.name, default=written(read.default), line=read.line)


def launch_files(texts: SideTexts, facts: PackageFacts) -> Sequence[tuple[str, LaunchFile]]:
    """Return the launch files of a package that can be read, by path, without those of tests; each is parsed once."""
    known = texts.launches.get(facts.root.path)
    if known is None:
        known = texts.launches[facts.root.path] = tuple(_parsed(texts, facts))
    return known


def _parsed(texts: SideTexts, facts: PackageFacts) -> Iterator[tuple[str, LaunchFile]]:
    """Yield those that their names tell, then those that they include, whatever these are called."""
    files = {entry.path for entry in facts.root.files if not is_test_path(entry.path, facts.root.path)}
    pending = sorted(path for path in files if is_launch_file(path))
    seen = set(pending)
    while pending:
        included: set[str] = set()
        for path, data in texts.read_many(pending):
            file = texts.told(path, read_launch(path, data, facts.ros))
            if file is not None:
                yield path, file
                included.update(_own_included(file, facts))
        pending = sorted(included & files - seen)
        seen.update(pending)


def _own_included(file: LaunchFile, facts: PackageFacts) -> Iterator[str]:
    """Yield the XML files of the package itself that a launch file includes by where the package lies."""
    prefix = f"$(find {facts.name})/"
    for action in all_actions(file.actions):
        named = written(action.path) if isinstance(action, Include) else ""
        if named.startswith(prefix) and named.endswith(_XML):
            yield str(PurePosixPath(facts.root.path) / named.removeprefix(prefix))
