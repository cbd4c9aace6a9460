"""Files in the share folder of a package that others name by it: meshes of descriptions, maps, configurations."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.package_references import parse_references
from ecm_parsers.share_files import parse_share_files

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, Reader, required
from ecm_extract.test_code import is_test_path

URL: Final = "file://"
"""Said of a file that is named as an address, as calibrations of cameras are."""
_DESCRIPTIONS: Final = (".urdf", ".xacro", ".sdf")
_LAUNCH: Final = (".launch", ".launch.xml")
_MESHES: Final = (".stl", ".dae", ".obj", ".STL", ".DAE", ".OBJ")
_BURIED: Final = "template"
_OUTSIDE: Final = ".."


def share_file_requirements(read: Reader, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield the files of packages that the descriptions and launch files of a package name; those of tests are not."""
    own = [entry.path for entry in facts.root.files if not is_test_path(entry.path, facts.root.path)]
    for path, data in read([each for each in own if each.endswith(_DESCRIPTIONS)]):
        yield from _of_description(path, data)
    for path, data in read([each for each in own if each.endswith(_LAUNCH) and _BURIED not in each]):
        yield from _of_launch(path, data)


def _of_description(path: str, data: bytes) -> Iterator[Requirement]:
    """Meshes, each once for a file with all its lines."""
    lines: dict[tuple[str, str], list[int]] = defaultdict(list)
    for named in parse_references(data).facts:
        if named.form == "uri" and named.path.endswith(_MESHES):
            lines[named.package, named.path].append(named.line)
    for (package, name), found in lines.items():
        place = Place(path, found[0], f"description {path.rpartition('/')[2]}")
        evidence = tuple(Evidence(path, line) for line in found)
        yield required("shows_mesh", name, place, package=package, evidence=evidence)


def _of_launch(path: str, data: bytes) -> Iterator[Requirement]:
    for named in parse_share_files(data).facts:
        if _OUTSIDE not in named.path:
            place = Place(path, named.line, f"launch_file {path.rpartition('/')[2]}")
            said = URL if named.is_url else ""
            yield required("names_file", named.path, place, "likely", package=named.package, said=said)
