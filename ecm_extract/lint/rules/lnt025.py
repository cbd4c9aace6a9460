"""LNT025: a robot description names a mesh that is not in its package."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.package import Package

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT025",
    name="mesh_missing",
    dimension="resources",
    severity="error",
    who="config",
    consequence="the robot has no shape there: it is not drawn, and collisions with it are not seen",
    resolution="correct the path, or add the file",
)
Missing = dict[str, list[Evidence]]
"""Lines by the path that they name."""


def tell(known: Known) -> Iterator[Finding]:
    """Report meshes of packages that have such files at all; what is missing with its folder is one finding."""
    single: dict[tuple[str, str, str], list[Evidence]] = {}
    folders: dict[tuple[str, str, str], Missing] = {}
    for asked in known.asked("shows_mesh"):
        wanted, owner = asked.requirement, known.packages.by_name.get(asked.requirement.package or "")
        if owner is None or not _is_missing(asked, owner):
            continue
        folder = wanted.name.rpartition("/")[0]
        if folder in known.files_of(owner.name) or not folder:
            single.setdefault((asked.consumer.name, owner.name, wanted.name), []).extend(wanted.evidence)
        else:
            names = folders.setdefault((asked.consumer.name, owner.name, folder), {})
            names.setdefault(wanted.name, []).extend(wanted.evidence)
    for (package, owner_name, name), places in single.items():
        yield RULE.finding(f"{owner_name} has no {name}", Entity("file", f"{owner_name}/{name}"), package, places)
    yield from (_of_folder(*key, names) for key, names in folders.items())


def _is_missing(asked: Asked, owner: Package) -> bool:
    """Tell whether a mesh is not there while others are; a package without any may get them from elsewhere."""
    suffix = f".{asked.requirement.name.rpartition('.')[2].lower()}"
    return asked.match.state == "dangling" and any(path.lower().endswith(suffix) for path in owner.files)


def _of_folder(package: str, owner: str, folder: str, names: Missing) -> Finding:
    """One finding for all that is missing with its folder, or the file when it is one."""
    (first, *others), evidence = names, [place for places in names.values() for place in places]
    text = (
        f"{owner} has no folder {folder}, where {len(names)} meshes should be" if others else f"{owner} has no {first}"
    )
    return RULE.finding(text, Entity("file", f"{owner}/{folder if others else first}"), package, evidence)
