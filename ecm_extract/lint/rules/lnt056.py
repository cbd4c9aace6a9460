"""LNT056: a launch file uses an argument that it does not have, or includes a file with other arguments than it has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_parsers.parameter_yaml import parse_parameter_yaml

from ecm_extract.lint.launch_arguments import Handed, Interface, Reach, interfaces
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT056",
    name="launch_argument_unknown",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the launch stops there",
    resolution="declare the argument, or use the name that is declared",
)
_TEMPLATES = ("/templates/", "/template/")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report arguments of ROS 1 that roslaunch refuses, and of ROS 2 those that no file of a launch can have.

    Not asked of the engine: which launch file an include means, and what it reads, is told by evaluation.
    """
    files = {path: entry for path, entry in interfaces(workspace).items() if not _is_template(path)}
    callers = _callers(files)
    reach = Reach(files)
    for path, entry in files.items():
        if entry.ros == 1 and not any(call.passes_all for _, call in callers.get(path, ())):
            yield from _undeclared(path, entry, path in callers, workspace)
        for call in entry.includes:
            target = files.get(call.target or "")
            if target is not None and target.ros == entry.ros == 1 and not call.passes_all:
                yield from _refused(path, call, target, workspace)
                yield from _unset(path, call, target, workspace)
            elif target is not None and target.ros == entry.ros == 2:
                yield from _idle(path, call, target, reach, workspace)
                yield from _not_handed(path, call, target, workspace)


def _is_template(path: str) -> bool:
    return any(part in f"/{path}" for part in _TEMPLATES)


def _callers(files: Mapping[str, Interface]) -> dict[str, list[tuple[str, Handed]]]:
    """The includes of each file, with the files that they stand in."""
    found: dict[str, list[tuple[str, Handed]]] = {}
    for path, entry in files.items():
        for call in entry.includes:
            if call.target is not None:
                found.setdefault(call.target, []).append((path, call))
    return found


def _undeclared(path: str, entry: Interface, is_included: bool, workspace: Workspace) -> Iterator[Finding]:
    """An include cannot give what is not declared; a person who starts the file can, on the command line."""
    for name, line in entry.used.items():
        if name not in entry.declared:
            near = nearest(name, entry.declared)
            text = f"$(arg {name}) is used and {path} declares no such argument" + (f"; it has {near}" if near else "")
            if is_included or near:
                yield _finding(text, name, near, Evidence(path, line), workspace, "proved")
            else:
                yield _info(text, name, Evidence(path, line), workspace)


def _refused(path: str, call: Handed, target: Interface, workspace: Workspace) -> Iterator[Finding]:
    """What roslaunch calls an unused argument of an include."""
    for name in call.names:
        if name not in target.declared:
            near = nearest(name, target.declared - set(call.names))
            text = f"{call.target} is given {name}, which it does not declare" + (f"; it has {near}" if near else "")
            yield _finding(text, name, near, Evidence(path, call.line), workspace, "proved")


def _unset(path: str, call: Handed, target: Interface, workspace: Workspace) -> Iterator[Finding]:
    """An argument without a value stops roslaunch where it is substituted; one that is only declared never does."""
    for name in _left_out(call, target):
        if name in target.used:
            text = f"{call.target} substitutes $(arg {name}) and this include gives {name} no value"
            places = _places(path, call, target.required[name], target.used[name])
            yield _missing(text, name, places, workspace, "proved" if name in target.always else "likely")


def _not_handed(path: str, call: Handed, target: Interface, workspace: Workspace) -> Iterator[Finding]:
    """Launch looks at what the include itself hands over; what is set elsewhere, even by a person, does not help."""
    below = {name for inner in target.includes for name in inner.names}
    for name in _left_out(call, target):
        if name not in below:
            text = f"{call.target} declares {name} without a default and this include does not give it"
            yield _missing(text, name, _places(path, call, target.required[name]), workspace, "proved")


def _places(path: str, call: Handed, *lines: int) -> list[Evidence]:
    """The include, then lines of the file that it names."""
    return [Evidence(path, call.line), *(Evidence(call.target or "", line) for line in dict.fromkeys(lines))]


def _left_out(call: Handed, target: Interface) -> list[str]:
    """Required arguments that an include does not give, also not by a name that is a slip for them."""
    slips = {nearest(name, target.declared - set(call.names)) for name in call.names if name not in target.declared}
    return sorted(target.required.keys() - set(call.names) - slips)


def _idle(path: str, call: Handed, target: Interface, reach: Reach, workspace: Workspace) -> Iterator[Finding]:
    place = Evidence(path, call.line)
    read = reach.read(call.target or "")
    for name in call.names:
        if read is not None and name not in read and not _is_filled_in(name, call.target or "", workspace):
            near = nearest(name, target.declared - set(call.names))
            text = f"{call.target} is given {name}, which nothing reads" + (f"; it has {near}" if near else "")
            yield _unread(text, name, near, place, workspace)


def _is_filled_in(name: str, path: str, workspace: Workspace) -> bool:
    """Tell whether a parameter file of the package of a launch file reads a value where it is loaded."""
    package = workspace.by_name.get(workspace.package_of(path))
    files = (entry.path for entry in package.root.files) if package is not None else ()
    wanted = f"$(var {name})"
    read = (workspace.files.parsed(each, parse_parameter_yaml) for each in files if each.endswith((".yaml", ".yml")))
    return any(
        wanted in f"{entry.name} {entry.value}" for file in read if file is not None for entry in file.facts.sets
    )


def _finding(
    text: str, name: str, near: str | None, place: Evidence, workspace: Workspace, certainty: Certainty = "likely"
) -> Finding:
    entity = Entity("launch_argument", name, near or "")
    return RULE.finding(text, entity, workspace.package_of(place.path), [place], certainty=certainty)


def _unread(text: str, name: str, near: str | None, place: Evidence, workspace: Workspace) -> Finding:
    return RULE.finding(
        text,
        Entity("launch_argument", name, near or ""),
        workspace.package_of(place.path),
        [place],
        certainty="likely",
        consequence="the launch goes on without the value that was meant",
        resolution="use the name that is declared" if near else "leave it out, or declare it where it is meant",
    )


def _missing(text: str, name: str, places: list[Evidence], workspace: Workspace, certainty: Certainty) -> Finding:
    return RULE.finding(
        text,
        Entity("launch_argument", name, ""),
        workspace.package_of(places[0].path),
        places,
        certainty=certainty,
        resolution=f"give {name} in the include, or a default where it is declared",
    )


def _info(text: str, name: str, place: Evidence, workspace: Workspace) -> Finding:
    return RULE.finding(
        text,
        Entity("launch_argument", name, ""),
        workspace.package_of(place.path),
        [place],
        certainty="likely",
        severity="info",
        consequence="the launch stops unless whoever starts it gives the value",
        resolution="declare the argument, so that it is listed with the others",
    )
