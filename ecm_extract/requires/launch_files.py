"""Launch files: the programs that they start, what they include and give, set, remap and load.

The parsed actions are read, not the text, so that XML, YAML and Python say the same things. A name with a substitution
in it is nobody's until the launch is evaluated: its parts that are known only at launch are holes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.condition import Condition
from ecm_checker.hub.requirement import Given, Requirement
from ecm_parsers.launch.model import (
    Action,
    Group,
    Include,
    LaunchFile,
    Node,
    ParameterFile,
    ParameterSource,
    ParameterValue,
    Remap,
)
from ecm_parsers.launch.templates import holed, plain_text, written
from ecm_parsers.template import Template

from ecm_extract.entities.launch import launch_files
from ecm_extract.entities.launch_conditions import conditions_of, together
from ecm_extract.entities.launch_targets import FOUND, OUTSIDE, included_file
from ecm_extract.entities.paths import inside
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.launch_values import value_requirements
from ecm_extract.requires.name_lines import line_of_name
from ecm_extract.requires.place import Place, required
from ecm_extract.requires.xacro_commands import given_to_descriptions

_STARTS: Final = "starts"
_ROS_2: Final = 2
MANAGED: Final = "node_names"
"""Parameter by which a lifecycle manager is told its nodes (nav2_lifecycle_manager, nav2_util)."""
_BELOW_NODE: Final = 2


class _Scope(msgspec.Struct, frozen=True):
    """Where an action stands: its file, in which package and by which path from there, and the conditions around it.

    `conditions` are as they are written, `when` by what they test.
    """

    path: str
    package: str = ""
    own: str = ""
    ros: int | None = None
    conditions: tuple[str, ...] = ()
    when: tuple[Condition, ...] = ()

    def place(self, line: int) -> Place:
        return Place(self.path, line, f"launch_file {PurePosixPath(self.path).name}")

    def inside(self, condition: Template | None) -> _Scope | None:
        """Return what is below a condition; None where it never holds."""
        own = conditions_of(condition)
        if own is None:
            return None
        told = (written(condition),) if condition is not None and own else ()
        conditions = (*self.conditions, *told)
        return msgspec.structs.replace(self, conditions=conditions, when=together(self.when, own))

    def under(self, found: Requirement) -> Requirement:
        """Return a requirement with the conditions that are known here."""
        return msgspec.structs.replace(found, conditions=self.conditions, when=self.when) if self.conditions else found


def launch_requirements(texts: SideTexts, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the launch files of a package require."""
    for path, file in launch_files(texts, facts):
        lines = next((data.splitlines() for _, data in texts.read_many([path])), [])
        yield from requirements_of_file(facts, path, file, lines)


def requirements_of_file(
    facts: PackageFacts, path: str, file: LaunchFile, lines: Sequence[bytes]
) -> Iterator[Requirement]:
    """Yield what one launch file requires; `lines` are its content, by which the line of a program's name is told."""
    yield from value_requirements(facts, path, file)
    for found in _of_actions(file.actions, _Scope(path, facts.name, inside(path, facts.root.path), file.ros)):
        if found.use == _STARTS:
            at = found.evidence[0]
            evidence = (Evidence(path, line_of_name(lines, at.line, found.name)),)
            yield msgspec.structs.replace(found, ros=file.ros, evidence=evidence)
        else:
            yield msgspec.structs.replace(found, ros=file.ros)


def _of_actions(actions: Iterable[Action], scope: _Scope) -> Iterator[Requirement]:
    for action in actions:
        inner = scope.inside(action.condition)
        for found in _of_action(action, inner) if inner is not None else ():
            yield inner.under(found) if inner is not None and not found.conditions else found


def _of_action(action: Action, scope: _Scope) -> Iterator[Requirement]:
    match action:
        case Group():
            yield from _of_actions(action.actions, scope)
        case Include():
            yield from _of_include(action, scope)
        case Node():
            yield from _of_node(action, scope)
        case Remap():
            yield _remap(action, scope, None)
        case ParameterValue():
            yield from _of_parameter(action, scope.place(action.line), None)
        case ParameterFile():
            yield from _of_file(action.path, scope.place(action.line))


def _of_include(action: Include, scope: _Scope) -> Iterator[Requirement]:
    place = scope.place(action.line)
    given = Given(names=tuple(name for name, _ in action.arguments), forwarded=action.pass_all)
    target = included_file(action.path, scope.package, scope.own)
    if target is None:
        yield required("includes_launch", holed(action.path), place, "unknown", given=given)
        return
    package, path = target
    file = PurePosixPath(path).name
    yield required("includes_launch", file, place, package=package, given=given, target=path)
    for name in given.names if scope.ros == _ROS_2 or not action.pass_all else ():  # in ROS 2 all is always passed
        yield required("hands_argument", name, place, package=package, owner=path)
    lines = action.argument_lines or (action.line,) * len(action.arguments)
    conditions = action.argument_conditions or (None,) * len(action.arguments)
    for (name, _), line, condition in zip(action.arguments, lines, conditions, strict=True):
        inner = scope.inside(condition)
        if inner is not None:
            yield inner.under(required("gives_argument", name, scope.place(line), package=package, owner=file))


def _of_node(action: Node, scope: _Scope) -> Iterator[Requirement]:
    package, executable = plain(action.package), plain(action.executable)
    place = scope.place(action.line)
    if package and executable:
        yield required(_STARTS, executable, place, package=package)
    plugin = plain(action.plugin)
    if plugin:
        yield required("loads_plugin", plugin, place)
    yield from _names(action, place)
    for part in (*action.remaps, *action.sources):
        inner = scope.inside(part.condition)
        for each in _of_part(action, part, scope) if inner is not None else ():
            yield inner.under(each) if inner is not None else each
    yield from _of_actions(action.components, scope)


def _of_part(action: Node, part: Remap | ParameterSource, scope: _Scope) -> Iterator[Requirement]:
    """What a remap or parameter of a node requires."""
    place, home = scope.place(part.line or action.line), _home(action)
    match part:
        case Remap():
            yield _below_node(_remap(part, scope, home), plain(action.name or ()))
            yield from _reached(part, scope.place(part.line))
        case ParameterFile():
            yield from _of_file(part.path, place)
        case ParameterValue():
            yield from _of_parameter(part, place, home)


def _home(action: Node) -> str:
    """The package of what runs: a program that loads a class, as `nodelet`, runs what is of the package of that."""
    package, plugin = plain(action.package), plain(action.plugin)
    loaded = plugin.replace("::", "/").partition("/")[0]
    return loaded if loaded and (action.executable or not package) else package


def _below_node(remap: Requirement, node: str) -> Requirement:
    """A name that begins with the node's own is its private one: `arm/state` of `arm` is `~/state`."""
    if node and remap.name.startswith(f"{node}/"):
        return msgspec.structs.replace(remap, name=f"~{remap.name.removeprefix(node)}")
    return remap


def _names(action: Node, place: Place) -> Iterator[Requirement]:
    """The name that a node is given, and the container that it is loaded into."""
    name = plain(action.name or ())
    if name:
        yield required("names_node", name, place)
    target = plain(action.target or ())
    if target.rpartition("/")[2]:
        yield required("loads_into", target.rpartition("/")[2], place, "likely", target=target)


def _reached(remap: Remap, place: Place) -> Iterator[Requirement]:
    """The nodes that absolute private names hang below: `/ns/arm/state` -> `arm`."""
    for name in (plain(remap.source), plain(remap.target)):
        parts = name.split("/")
        if len(parts) > _BELOW_NODE and not parts[0]:
            yield required("reaches_node", parts[-2], place, "likely", said=name)


def _remap(action: Remap, scope: _Scope, package: str | None) -> Requirement:
    source, target = holed(action.source), holed(action.target)
    return required("remaps", source, scope.place(action.line), "likely", target=target, package=package or None)


def _of_parameter(action: ParameterValue, place: Place, package: str | None) -> Iterator[Requirement]:
    name = plain(action.name)
    if name:
        yield required("gives_parameter", name, place, "likely", package=package or None)
    yield from given_to_descriptions(action.value, place)
    for managed in _listed(action.value) if name == MANAGED else ():
        yield required("manages", managed, place, "likely")


def _listed(value: object) -> Iterator[str]:
    """Texts of a list of a launch file; each is a template."""
    for item in value if isinstance(value, list) else ():
        text = plain(item) if isinstance(item, tuple) else ""
        if text:
            yield text.strip("/")


def _of_file(path: Template, place: Place) -> Iterator[Requirement]:
    found = FOUND.search(written(path))
    if found is not None and OUTSIDE not in found[2]:
        name = f"{found[2].lstrip('/')}{found[3]}"
        yield required("reads_file", name, place, package=found[1])


def plain(template: Template) -> str:
    """Return a template without substitutions as text; empty for any other."""
    return plain_text(template) or ""
