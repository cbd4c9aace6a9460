"""What moved together with the only file that declares it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair

_ALONE = 0.75
_MOST = 0.5
_LEAST_FILES = 3


def alone_in_moved_files(
    kind: str, removed: Iterable[Provision], added: Iterable[Provision], files: Mapping[str, str]
) -> Iterator[Pair]:
    """Yield the pairs of a kind that stand alone in a file that moved, under whatever name.

    A package is what moved when most of the files that left its folder went to the folder of a new package, and the one
    whose manifest names it anew where it lies.
    """
    gone, came = _by_place(kind, removed), _by_place(kind, added)
    for place, before in gone.items():
        if kinds()[kind].released:
            target, where = _package_moved(place, files, came)
        else:
            target, where = files.get(place), "git sees that its file moves, and declares no other"
        after = came.get(target, []) if target is not None else []
        if len(before) == 1 and len(after) == 1 and before[0].name != after[0].name:
            yield Pair(before[0], after[0], "renamed", _ALONE, f"gone and new; {where}")


def with_their_files(
    removed: Iterable[Provision], added: Iterable[Provision], files: Mapping[str, str]
) -> Iterator[Pair]:
    """Yield what a file that moved still has, of parts whose owner is that file: arguments of descriptions."""
    came = {(entity.kind, entity.path, entity.name): entity for entity in added if _is_of_its_file(entity)}
    for entity in removed:
        target = files.get(entity.path)
        found = came.get((entity.kind, target, entity.name)) if target is not None else None
        if found is not None and _is_of_its_file(entity):
            yield Pair(entity, found)


def _is_of_its_file(entity: Provision) -> bool:
    return entity.row.part and bool(entity.owner) and f"/{entity.path}".endswith(f"/{entity.owner}")


def _package_moved(
    folder: str, files: Mapping[str, str], came: Mapping[str, Sequence[Provision]]
) -> tuple[str | None, str]:
    """The folder of the package that one became, and by what that is seen."""
    if len(came.get(folder, ())) == 1:
        return folder, "the manifest in its folder names it so"
    return folder_moved(folder, files), "git sees that its files move there"


def _by_place(kind: str, entities: Iterable[Provision]) -> dict[str, list[Provision]]:
    found: dict[str, list[Provision]] = defaultdict(list)
    for entity in entities:
        if entity.kind == kind:
            found[_folder(entity.path) if kinds()[kind].released else entity.path].append(entity)
    return found


def _folder(path: str) -> str:
    return path.rpartition("/")[0]


def folder_moved(folder: str, files: Mapping[str, str]) -> str | None:
    """The folder with a manifest or sources that most files of a folder moved to; None when they scattered."""
    targets: dict[str, int] = defaultdict(int)
    total = 0
    for old, new in files.items():
        if old.startswith(f"{folder}/"):
            total += 1
            parts = new.split("/")
            for depth in range(1, len(parts)):
                targets["/".join(parts[:depth])] += 1
    depth = folder.count("/")
    likely = [name for name, count in targets.items() if name.count("/") == depth and count > total * _MOST]
    return likely[0] if total >= _LEAST_FILES and likely else None
