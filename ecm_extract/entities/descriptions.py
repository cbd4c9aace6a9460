"""Robot descriptions that a package offers: their files with arguments, frames of links, command interfaces of joints.

They are read as written. What whoever expands a macro chooses, such as `${prefix}`, is a hole in the name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_checker.hub.condition import Condition
from ecm_checker.hub.provision import HOLE, Provision
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.robot_names import NamedArgument, NamedLine, RobotNames, parse_robot_names
from ecm_parsers.template import negated

from ecm_extract.entities.launch_conditions import conditions_of, together
from ecm_extract.entities.paths import inside
from ecm_extract.entities.side_texts import DESCRIPTIONS, SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_path

_COMPUTED: Final = re.compile(r"(?:\$\{[^}]*\}|\$\([^)]*\))+")
_PREFIXED: Final = re.compile(rf"{re.escape(HOLE)}/?[A-Za-z]")
_EXAMPLES: Final = frozenset({"example", "examples", "tutorial", "tutorials", "demo", "demos"})


def description_entities(texts: SideTexts, facts: PackageFacts) -> Iterator[Provision]:
    """Yield the files, their arguments, frames and command interfaces; a name that several files have is one."""
    for path, names in descriptions(texts, facts):
        own = inside(path, facts.root.path)
        yield Provision(kind="file", package=facts.name, owner="", name=own, path=path, line=1)
        if _EXAMPLES.isdisjoint(own.split("/")):
            yield from _entities(facts.name, "frame", path, names.links)
            yield from _entities(facts.name, "command_interface", path, names.commands, typed=True)
            yield from _arguments(facts.name, own, path, names.arguments)


def descriptions(texts: SideTexts, facts: PackageFacts) -> Iterator[tuple[str, RobotNames]]:
    """Yield the description files of a package by path, without those of tests and those of planning groups."""
    paths = [
        entry.path
        for entry in facts.root.files
        if entry.path.endswith(DESCRIPTIONS)
        and ".srdf" not in entry.path
        and not is_test_path(entry.path, facts.root.path)
    ]
    for path, data in texts.read_many(sorted(paths)):
        yield path, texts.told(path, parse_robot_names(data))


def written_name(name: str) -> str:
    """Return a name with holes; a prefix is empty until somebody gives one: `${prefix}tool0` -> `tool0`."""
    holed = _COMPUTED.sub(HOLE, name)
    return holed.removeprefix(HOLE).removeprefix("/") if _PREFIXED.match(holed) else holed


def tested(entry: NamedLine) -> tuple[Condition, ...] | None:
    """Return the conditions under which a description has a name; None where it never has."""
    found: tuple[Condition, ...] = ()
    for test in entry.tests:
        template = parse_template(test.value)
        own = conditions_of(negated(template) if test.negated else template)
        if own is None:
            return None
        found = together(found, own)
    return found


def _entities(
    package: str, kind: str, path: str, names: tuple[NamedLine, ...], *, typed: bool = False
) -> Iterator[Provision]:
    for entry in names:
        name, when = written_name(entry.name), tested(entry)
        if when is not None and re.search(r"\w", name.replace(HOLE, "")):
            yield Provision(
                kind=kind,
                package=package,
                owner="",
                name=name,
                type=name.rpartition("/")[2] if typed else None,
                path=path,
                line=entry.line,
                when=when,
            )


def _arguments(package: str, file: str, path: str, arguments: tuple[NamedArgument, ...]) -> Iterator[Provision]:
    for entry in arguments:
        when = tested(entry)
        if when is not None and not _COMPUTED.search(entry.name):
            yield Provision(
                kind="xacro_argument",
                package=package,
                owner=file,
                name=entry.name,
                default=entry.default,
                path=path,
                line=entry.line,
                when=when,
            )
