"""What XML launch files say about names of parameters and executables, as far as it stands there."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.xml_tree import line_of, local_name, parse_xml
from lxml import etree

from ecm_extract.diff.model import Located
from ecm_extract.entities.side import Workspace
from ecm_extract.uses.index import GONE, ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at
from ecm_extract.uses.names import parameter_name_matches

MAX_BYTES = 1_000_000
_XML = (".launch", ".launch.xml", ".launch.in", ".test")


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
