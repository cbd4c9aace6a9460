"""Launch files that include a launch file which is gone, or give it other arguments than it takes now."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import msgspec
from ecm_checker.finding import Certainty
from ecm_parsers.launch.model import Action, Group, Include

from ecm_extract.diff.model import Located
from ecm_extract.entities.launch import launch_files, written
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_FOUND = re.compile(r"\$\((?:find|find_prefix) ([^\s$()]+)\).*?([^/$()]+)$", re.DOTALL)


class Included(msgspec.Struct, frozen=True):
    """An include whose file is known: package and name of the file, names of the arguments that it is given."""

    package: str
    name: str
    arguments: frozenset[str]
    pass_all: bool


def include_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the includes of a workspace that a change of a launch file or of its arguments breaks."""
    changes = [*index.of_kind("launch_file"), *index.of_kind("launch_argument"), *index.additions("launch_argument")]
    if not changes:
        return
    for facts in workspace.packages:
        for path, file in launch_files(workspace.tree, facts):
            for action, included in _includes(file.actions):
                place = Place(facts.name, path, action.line)
                yield from _of_include(included, place, changes)


def _includes(actions: Iterable[Action]) -> Iterator[tuple[Include, Included]]:
    for action in actions:
        if isinstance(action, Group):
            yield from _includes(action.actions)
        elif isinstance(action, Include):
            found = _FOUND.search(written(action.path))
            if found is not None:
                given = frozenset(name for name, _ in action.arguments)
                yield action, Included(found[1], found[2], given, action.pass_all)


def _of_include(included: Included, place: Place, changes: Iterable[Located]) -> Iterator[Use]:
    for located in changes:
        old, new, change = located.pair.old, located.pair.new, located.change
        entity = old or new
        if entity is None or entity.package != included.package:
            continue
        if entity.kind == "launch_file":
            if entity.name == included.name and change.change in GONE:
                yield use_at(located, place, f"includes {entity.name} of {entity.package}")
        elif entity.owner == included.name:
            yield from _of_argument(included, located, place)


def _of_argument(included: Included, located: Located, place: Place) -> Iterator[Use]:
    old, new, change = located.pair.old, located.pair.new, located.change
    if old is not None and change.change in GONE and old.name in included.arguments:
        yield use_at(located, place, f"gives {old.name} to {included.name}")
    needed = new is not None and new.default is None and (old is None or change.change == "default_changed")
    if new is not None and needed and new.name not in included.arguments:
        certainty: Certainty = "likely" if included.pass_all else "proved"
        yield use_at(located, place, f"includes {included.name} without {new.name}", certainty)
