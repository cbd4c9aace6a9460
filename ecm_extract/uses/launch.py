"""What launch files say about names: parameters and executables in XML, remaps in XML and Python.

Only what stands there literally is read; a substitution is a part that fits anything.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec
from ecm_parsers.xml_tree import line_of, local_name, parse_xml
from lxml import etree

from ecm_extract.diff.model import Located
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at
from ecm_extract.uses.names import graph_name_matches, parameter_name_matches

MAX_BYTES = 1_000_000
_XML = (".launch", ".launch.xml", ".launch.in", ".test")
_PYTHON = ".launch.py"
_REMAPPINGS = re.compile(r"remappings\s*=\s*[\[(](.{0,4000}?)[\])]\s*[,)]", re.DOTALL)
_PAIR = re.compile(r"\(\s*[\"']([^\"']{1,200})[\"']\s*,\s*[\"']([^\"']{1,200})[\"']\s*,?\s*\)")
_SUBSTITUTION = re.compile(r"\$\([^()]*\)")


class Remap(msgspec.Struct, frozen=True):
    """One `from` name that a launch file gives another name."""

    source: str
    target: str


def launch_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines of XML launch files that set parameters or start executables that are gone."""
    if not index.of_kind("parameter") and not index.of_kind("executable"):
        return
    for package, path, data in _files(workspace, _XML):
        root = parse_xml(data).root
        for element in root.iter() if root is not None else ():
            if isinstance(element.tag, str):
                yield from _of_element(element, Place(package, path, line_of(element)), index)


def _of_element(element: etree._Element, place: Place, index: ChangeIndex) -> Iterator[Use]:
    if local_name(element) == "param" and element.get("name"):
        yield from _parameters(str(element.get("name")), place, index)
    elif local_name(element) == "node":
        package, name = element.get("pkg"), element.get("type") or element.get("exec")
        for located in index.named("executable", str(name)):
            entity = located.pair.old
            if entity is not None and entity.package == package and located.change.change in GONE:
                yield use_at(located, place, f"starts {name} of {package}")


def _parameters(name: str, place: Place, index: ChangeIndex) -> Iterator[Use]:
    for located in index.of_kind("parameter"):
        entity = located.pair.old
        if entity is None or located.change.change == "type_changed":
            continue
        if parameter_name_matches(entity.name, name) and not _declared(name, located, index):
            yield use_at(located, place, f"sets {name}", "likely")


def _declared(name: str, located: Located, index: ChangeIndex) -> bool:
    if located.change.change == "deprecated":
        return False
    return any(parameter_name_matches(entity.name, name) for entity in index.offered("parameter", ""))


def remaps_of(workspace: Workspace) -> list[Remap]:
    """Return the remaps of all launch files of a workspace."""
    found = [remap for _, _, data in _files(workspace, _XML) for remap in _xml_remaps(data)]
    for _, _, data in _files(workspace, (_PYTHON,)):
        for listed in _REMAPPINGS.findall(data.decode("utf-8", "replace")):
            found += [Remap(source, target) for source, target in _PAIR.findall(listed)]
    return [entry for entry in found if entry.source and entry.target]


def _xml_remaps(data: bytes) -> list[Remap]:
    root = parse_xml(data).root
    elements = root.iter("remap") if root is not None else ()
    return [Remap(_plain(element.get("from")), _plain(element.get("to"))) for element in elements]


def is_kept_alive(use: Use, remaps: list[Remap]) -> bool:
    """Whether a remap joins the old and the new name of the topic or service that a use needs."""
    change = use.located.change
    if change.kind not in {"topic", "service", "action"} or not change.old or not change.new:
        return False
    names = (change.old, change.new)
    return any(
        _joins(names, remap.source, remap.target) or _joins(names, remap.target, remap.source) for remap in remaps
    )


def _joins(names: tuple[str, str], one: str, other: str) -> bool:
    return all(_means(offered, used) for offered, used in zip(names, (one, other), strict=True))


def _means(offered: str, used: str) -> bool:
    return offered.lstrip("~/") == used.lstrip("~/") or graph_name_matches(offered, used)


def _plain(text: object) -> str:
    return _SUBSTITUTION.sub("{}", str(text or ""))


def _files(workspace: Workspace, suffixes: tuple[str, ...]) -> Iterator[tuple[str, str, bytes]]:
    owners = {
        entry.path: package.name
        for package in workspace.packages
        for entry in package.root.files
        if entry.path.endswith(suffixes)
    }
    for path, data in workspace.tree.read_many(sorted(owners)):
        if len(data) <= MAX_BYTES:
            yield owners[path], path, data
