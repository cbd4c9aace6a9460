"""Who names a node that has another name now: parameter files, remaps, policies, lists of managed nodes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from ecm_parsers.launch.model import LaunchFile, Node, ParameterValue
from ecm_parsers.parameter_yaml import node_keys, parse_parameter_yaml
from ecm_parsers.sros_policy import is_policy, parse_policy

from ecm_extract.diff.model import Located
from ecm_extract.discover import is_test_path
from ecm_extract.entities.launch import MAX_BYTES, launch_files
from ecm_extract.entities.nodes import all_nodes, plain_text
from ecm_extract.entities.side import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_LISTS: Final = "node_names"
"""Parameter by which a lifecycle manager is told its nodes (nav2_lifecycle_manager, nav2_util)."""
_Gone = Mapping[str, Located]


def node_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of a workspace that are keyed by the name of a node that is gone.

    A name that a launch file of the workspace gives to a node is there, whatever the program calls itself.
    """
    gone = _gone(index)
    if not gone:
        return
    launches = [
        (facts, path, file) for facts in workspace.packages for path, file in launch_files(workspace.tree, facts)
    ]
    given = {plain_text(node.name) for _, _, file in launches for node in all_nodes(file.actions)}
    gone = {name: located for name, located in gone.items() if name not in given}
    for facts, path, file in launches if gone else ():
        yield from _of_launch(file, Place(facts.name, path, 1), gone)
    for facts in workspace.packages if gone else ():
        yield from _of_files(workspace, facts, gone)


def _gone(index: ChangeIndex) -> _Gone:
    """Changes by the name of a node that no program or launch file of the new side has any more."""
    changed = [entry for entry in index.of_kind("node") if entry.change.change in GONE]
    offered = {entity.name for entity in index.new.entities.values() if entity.kind == "node"}
    named = {entry.pair.old.name: entry for entry in changed if entry.pair.old is not None}
    return {name: entry for name, entry in named.items() if name not in offered}


def _of_launch(file: LaunchFile, place: Place, gone: _Gone) -> Iterator[Use]:
    for node in all_nodes(file.actions):
        for remap in node.remaps:
            for name in (plain_text(remap.source), plain_text(remap.target)):
                located = gone.get(_below(name))
                if located is not None:
                    yield use_at(located, _at(place, remap.line), f"remaps {name}", "likely")
        for parameter in node.parameters:
            if isinstance(parameter, ParameterValue) and plain_text(parameter.name) == _LISTS:
                for name in _listed(parameter.value):
                    if name in gone:
                        yield use_at(gone[name], _at(place, parameter.line or node.line), f"manages {name}", "likely")
        yield from _of_target(node, place, gone)


def _of_target(node: Node, place: Place, gone: _Gone) -> Iterator[Use]:
    name = (plain_text(node.target) or "").rpartition("/")[2]
    if name in gone:
        yield use_at(gone[name], _at(place, node.line), f"loads a component into {name}", "likely")


def _below(name: str | None) -> str:
    """The node that an absolute private name hangs below: `/ns/arm/state` -> `arm`; empty for none."""
    parts = (name or "").split("/")
    return parts[-2] if len(parts) > 2 and not parts[0] else ""


def _listed(value: object) -> Iterator[str]:
    """Texts of a list of a launch file; each is a template."""
    for item in value if isinstance(value, list) else ():
        text = plain_text(item) if isinstance(item, tuple) else None
        if text:
            yield text.strip("/")


def _of_files(workspace: Workspace, facts: PackageFacts, gone: _Gone) -> Iterator[Use]:
    wanted = (".yaml", ".yml", ".xml")
    paths = [
        entry.path
        for entry in facts.root.files
        if entry.path.endswith(wanted) and not is_test_path(entry.path, facts.root.path)
    ]
    for path, data in workspace.tree.read_many(sorted(paths)):
        if len(data) > MAX_BYTES:
            continue
        place = Place(facts.name, path, 1)
        yield from _of_policy(data, place, gone) if path.endswith(".xml") else _of_yaml(data, place, gone)


def _of_yaml(data: bytes, place: Place, gone: _Gone) -> Iterator[Use]:
    for key in node_keys(data):
        located = gone.get(key.name)
        if located is not None:
            yield use_at(located, _at(place, key.line), f"sets parameters of {key.name}")
    for entry in parse_parameter_yaml(data).facts.sets:
        names = entry.value if entry.name.endswith(_LISTS) and isinstance(entry.value, list) else ()
        for name in names:
            if isinstance(name, str) and name.strip("/") in gone:
                yield use_at(gone[name.strip("/")], _at(place, entry.line), f"manages {name}")


def _of_policy(data: bytes, place: Place, gone: _Gone) -> Iterator[Use]:
    seen = set()
    for grant in parse_policy(data).facts if is_policy(data) else ():
        name = grant.node.rpartition("/")[2]
        if name in gone and name not in seen:
            seen.add(name)
            yield use_at(gone[name], _at(place, grant.line), f"gives permissions to {name}")


def _at(place: Place, line: int) -> Place:
    return Place(place.package, place.path, line)
