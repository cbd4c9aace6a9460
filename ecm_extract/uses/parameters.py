"""Parameter files that set what is no longer declared, or name plugins that are gone."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ecm_parsers.parameter_yaml import ParameterFile, ParameterSet, parse_parameter_yaml

from ecm_extract.diff.model import Located
from ecm_extract.discover import is_test_path
from ecm_extract.entities.endpoints import HOLE
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at
from ecm_extract.uses.names import node_matches, parameter_name_matches

MAX_BYTES = 1_000_000
_TYPES = {"int": "integer", "int_array": "integer_array"}


def parameter_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of YAML files that a change of a parameter or plugin breaks."""
    if not index.of_kind("parameter") and not index.of_kind("plugin"):
        return
    owners: dict[str, str] = {}
    for package in workspace.packages:
        for entry in package.root.files:
            if entry.path.endswith((".yaml", ".yml")) and not is_test_path(entry.path, package.root.path):
                owners[entry.path] = package.name
    for path, data in workspace.tree.read_many(sorted(owners)):
        if len(data) <= MAX_BYTES:
            yield from _of_file(parse_parameter_yaml(data).facts, owners[path], path, index)


def _of_file(file: ParameterFile, package: str, path: str, index: ChangeIndex) -> Iterator[Use]:
    for entry in file.sets:
        place = Place(package, path, entry.line, entry.column)
        for located in index.of_kind("parameter"):
            certainty = _sets(entry, file.ros, located)
            if certainty is not None and not _declared(entry, file.ros, located, index):
                yield use_at(located, place, f"sets {entry.name}", certainty)
        for value in _strings(entry.value):
            for located in index.named("plugin", value):
                if located.change.change in GONE:
                    yield use_at(located, place, f"loads {value}")


def _sets(entry: ParameterSet, ros: int, located: Located) -> Any:
    """Return how surely a line sets the parameter of a change in a way that no longer works; None if it does not."""
    entity, change = located.pair.old, located.change
    if entity is None or entity.ros not in (None, ros) or change.change == "default_changed":
        return None
    if not parameter_name_matches(entity.name, entry.name):
        return None
    computed = HOLE in entity.name
    if ros == 2 and not computed and not node_matches(entity.owner, entry.node):
        return None
    if change.change == "type_changed":
        given = _TYPES.get(entry.type, entry.type)
        after = located.pair.new
        return "proved" if after is not None and given == entity.type and given != after.type else None
    if entry.node in {None, "/**", "/*"} or computed:
        return "likely"
    return "proved"


def _declared(entry: ParameterSet, ros: int, located: Located, index: ChangeIndex) -> bool:
    """Whether something on the new side still declares what the line sets."""
    if located.change.change in {"type_changed", "deprecated"}:
        return False
    old = located.pair.old
    return any(
        parameter_name_matches(entity.name, entry.name)
        and (ros == 1 or HOLE in entity.name or node_matches(entity.owner, entry.node))
        for entity in index.offered("parameter", "")
        if old is None or entity.package == old.package or HOLE not in entity.name or entity.name == old.name
    )


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, list):
        yield from (item for item in value if isinstance(item, str))
