"""LNT056: a launch file uses an argument that it does not have, or includes a file with other arguments than it has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding

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
    consequence="the launch stops there, or goes on without the value that was meant",
    resolution="declare the argument, or use the name that is declared",
)
_TEMPLATES = ("/templates/", "/template/")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report arguments of ROS 1 that roslaunch refuses, and of ROS 2 those that no file of a launch can have."""
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
            elif target is not None and target.ros == entry.ros == 2:
                yield from _idle(path, call, target, reach, workspace)


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
    place = Evidence(path, call.line)
    left_out = target.required - set(call.names)
    for name in call.names:
        if name not in target.declared:
            near = nearest(name, target.declared - set(call.names))
            left_out -= {near or name}
            text = f"{call.target} is given {name}, which it does not declare" + (f"; it has {near}" if near else "")
            yield _finding(text, name, near, place, workspace, "proved")
    for name in sorted(left_out):
        yield _finding(f"{call.target} needs {name} and is not given it", name, None, place, workspace, "proved")


def _idle(path: str, call: Handed, target: Interface, reach: Reach, workspace: Workspace) -> Iterator[Finding]:
    place = Evidence(path, call.line)
    read = reach.read(call.target or "")
    for name in call.names:
        if read is not None and name not in read and not _is_filled_in(name, call.target or "", workspace):
            near = nearest(name, target.declared - set(call.names))
            text = f"{call.target} is given {name}, which nothing reads" + (f"; it has {near}" if near else "")
            yield _finding(text, name, near, place, workspace)
    visible = reach.visible(path)
    for name in sorted(target.required - set(call.names)):
        if visible is not None and name not in visible:
            yield _finding(f"{call.target} needs {name} and is not given it", name, None, place, workspace)


def _is_filled_in(name: str, path: str, workspace: Workspace) -> bool:
    """Tell whether a parameter file of the package of a launch file reads a value where it is loaded."""
    package = workspace.by_name.get(workspace.package_of(path))
    files = (entry.path for entry in package.root.files) if package is not None else ()
    wanted = f"$(var {name})".encode()
    return any(wanted in (workspace.files.read(each) or b"") for each in files if each.endswith((".yaml", ".yml")))


def _finding(
    text: str, name: str, near: str | None, place: Evidence, workspace: Workspace, certainty: Certainty = "likely"
) -> Finding:
    entity = Entity("launch_argument", name, near or "")
    return RULE.finding(text, entity, workspace.package_of(place.path), [place], certainty=certainty)


def _info(text: str, name: str, place: Evidence, workspace: Workspace) -> Finding:
    return RULE.finding(
        f"{text}, so that whoever starts it must give it",
        Entity("launch_argument", name, ""),
        workspace.package_of(place.path),
        [place],
        certainty="likely",
        severity="info",
        resolution="declare the argument, so that it is listed with the others",
    )
