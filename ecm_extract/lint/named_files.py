"""Files that launch files name in the share folder of a package of the tree, and that nothing puts there."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from ecm_checker.contract import Evidence
from ecm_parsers.xml_tree import line_of, local_name, parse_xml

from ecm_extract.discover import is_test_path
from ecm_extract.lint.install_rules import install_rules, place_of
from ecm_extract.lint.rules.lnt043 import is_open
from ecm_extract.lint.submodules import submodules
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.files import TREE

_FILES = (".launch", ".launch.xml")
_IN_SHARE = re.compile(
    r"\$\(find(?:-pkg-share)?\s+(\w+)\s*\)/+"
    r"([\w./-]+\.(?:ya?ml|rviz|launch|xml|urdf|xacro|srdf|world|pgm|png|jpe?g|stl|dae|lua|json|perspective))"
    r"(?![\w$({.])"
)
_MAKING = frozenset({"add_custom_command", "configure_file"})
_EVALUATED = frozenset({"include", "rosparam"})
"""What the evaluation of launch files looks for already."""


class NamedFile(msgspec.Struct, frozen=True):
    """A file that is named and is not there.

    Attributes:
        package, path: as it is named. place: the line that names it.
        near: the one of that name elsewhere in its package, or empty.
        is_url: it is named as `file://`, as calibrations of cameras are.
    """

    package: str
    path: str
    near: str
    place: Evidence
    is_url: bool


def absent_files(workspace: Workspace) -> Iterator[NamedFile]:
    """Yield what attributes of launch files of XML name; packages whose build may make files are left out."""
    closed: dict[str, bool] = {}
    outside = tuple(f"{folder}/" for folder in submodules(workspace))
    for owner in workspace.packages:
        for entry in owner.root.files:
            is_read = entry.path.endswith(_FILES) and "template" not in entry.path
            if is_read and not is_test_path(entry.path, owner.root.path):
                for name, path, place, is_url in _named(entry.path, workspace):
                    package = workspace.by_name.get(name)
                    if package is None or not closed.setdefault(name, _is_closed(package, workspace)):
                        continue
                    near = _elsewhere(path, package, workspace)
                    if near is not None and not f"{package.root.path}/{path}".lstrip("/").startswith(outside):
                        yield NamedFile(name, path, near, place, is_url)


def _named(path: str, workspace: Workspace) -> Iterator[tuple[str, str, Evidence, bool]]:
    tree = workspace.files.parsed(path, parse_xml)
    for root in tree.roots if tree is not None else ():
        for element in root.iter():
            if isinstance(element.tag, str) and local_name(element) not in _EVALUATED:
                for attribute in ("value", "default", "args"):
                    text = element.get(attribute) or ""
                    for match in _IN_SHARE.finditer(text):
                        is_url = text[: match.start()].endswith("file://")
                        yield match[1], match[2].replace("//", "/"), Evidence(path, line_of(element)), is_url


def _is_closed(package: PackageFacts, workspace: Workspace) -> bool:
    """Tell whether the files of a package are those of its tree: none is generated, all install rules are known."""
    commands = [command for file in package.cmake.values() for command in file.commands]
    makes = any(command.name in _MAKING or "DOWNLOAD" in command.args for command in commands)
    return bool(package.cmake) and not makes and (package.root.rosbuild or not is_open(package))


def _elsewhere(path: str, package: PackageFacts, workspace: Workspace) -> str | None:
    """Where a file lies that is neither at its path nor put there; empty for nowhere, None where all is right."""
    root = f"{package.root.path}/" if package.root.path else ""
    there = {entry.path for entry in package.root.files}
    marked = f"{TREE}{root}{path}"
    if f"{root}{path}" in there or ".." in path or workspace.files.is_elsewhere(marked):
        return None
    found = workspace.files.find(marked) or ""
    rules = list(install_rules(package)) if found else []
    wanted = f"share/{package.name}/{path}"
    return None if any(place_of(found, rule) == wanted for rule in rules) else found.removeprefix(root)
