"""LNT025: a robot description names a mesh that is not in its package."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.package_references import parse_references

from ecm_extract.discover import is_test_path
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT025",
    name="mesh_missing",
    dimension="resources",
    severity="error",
    who="config",
    consequence="the robot has no shape there: it is not drawn, and collisions with it are not seen",
    resolution="correct the path, or add the file",
)
_MESHES = (".stl", ".dae", ".obj", ".STL", ".DAE", ".OBJ")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report paths without substitutions into packages of the tree that have such files at all."""
    for package in workspace.packages:
        folders: dict[tuple[str, str], dict[str, list[Evidence]]] = {}
        single: dict[str, list[Evidence]] = {}
        for entry in package.root.files:
            if entry.path.endswith((".urdf", ".xacro", ".sdf")) and not is_test_path(entry.path, package.root.path):
                for (owner, name), lines in _named(entry.path, workspace).items():
                    if _is_missing(owner, name, workspace):
                        evidence = [Evidence(entry.path, line) for line in lines]
                        if _has_folder(owner, name, workspace):
                            single.setdefault(f"{owner}/{name}", []).extend(evidence)
                        else:
                            names = folders.setdefault((owner, name.rpartition("/")[0]), {})
                            names.setdefault(name, []).extend(evidence)
        for file, places in single.items():
            text = f"{file.partition('/')[0]} has no {file.partition('/')[2]}"
            yield RULE.finding(text, Entity("file", file), package.name, places)
        yield from (_of_folder(*key, names, package.name) for key, names in folders.items())


def _of_folder(owner: str, folder: str, names: dict[str, list[Evidence]], package: str) -> Finding:
    """One finding for all that is missing with its folder, or the file when it is one."""
    (first, *others), evidence = names, [place for places in names.values() for place in places]
    text = (
        f"{owner} has no folder {folder}, where {len(names)} meshes should be" if others else f"{owner} has no {first}"
    )
    return RULE.finding(text, Entity("file", f"{owner}/{folder if others else first}"), package, evidence)


def _has_folder(owner: str, name: str, workspace: Workspace) -> bool:
    root = workspace.by_name[owner].root
    folder = f"{root.path}/{name}".lstrip("/").rpartition("/")[0]
    return any(entry.path.startswith(f"{folder}/") for entry in root.files)


def _named(path: str, workspace: Workspace) -> dict[tuple[str, str], list[int]]:
    """Return the lines of each mesh, by package and path, that a file names outside of comments."""
    found: dict[tuple[str, str], list[int]] = {}
    read = workspace.files.parsed(path, parse_references)
    for named in read.facts if read is not None else ():
        if named.form == "uri" and named.path.endswith(_MESHES):
            found.setdefault((named.package, named.path), []).append(named.line)
    return found


def _is_missing(owner: str, name: str, workspace: Workspace) -> bool:
    package = workspace.by_name.get(owner)
    if package is None:
        return False
    root = f"{package.root.path}/" if package.root.path else ""
    listed = {entry.path for entry in package.root.files}
    suffix = name.rpartition(".")[2].lower()
    gone = f"{root}{name}" not in listed and not workspace.files.is_left_out(f"{root}{name}")
    return gone and any(path.lower().endswith(f".{suffix}") for path in listed)
