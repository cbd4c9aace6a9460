"""Files that launch files name in the share folder of a package that is known, and that nothing puts there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Final

import msgspec
from ecm_checker.contract import Evidence

from ecm_extract.lint.known import Asked, Known
from ecm_extract.requires.share_files import URL
from ecm_extract.system.files import TEMPLATES


class NamedFile(msgspec.Struct, frozen=True):
    """A file that is named and is not there.

    Attributes:
        consumer: the package that names it. package, path: as it is named. place: the line that names it.
        near: the one of that name elsewhere in its package, or empty.
        is_url: it is named as `file://`, as calibrations of cameras are.
        archive: one in the folder where it should be, which may hold it; or empty.
    """

    consumer: str
    package: str
    path: str
    near: str
    place: Evidence
    is_url: bool
    archive: str = ""


_ARCHIVES: Final = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz", ".7z", ".rar")


def absent_files(known: Known) -> Iterator[NamedFile]:
    """Yield what attributes of launch files of XML name; packages whose build may make files are left out."""
    for asked in known.asked("names_file"):
        wanted = asked.requirement
        owner = known.packages.by_name.get(wanted.package or "")
        if owner is None or asked.match.state != "dangling" or owner.makes_files:
            continue
        named = known.named_like(owner.name, wanted.name, TEMPLATES)
        if all(PurePosixPath(path).name == PurePosixPath(wanted.name).name for path in named):
            yield msgspec.structs.replace(
                _absent(asked, owner.name, named), archive=_archive_beside(known.files_of(owner.name), wanted.name)
            )


def _absent(asked: Asked, owner: str, named: Sequence[str]) -> NamedFile:
    wanted = asked.requirement
    near = _meant(PurePosixPath(wanted.name), named)
    return NamedFile(asked.consumer.name, owner, wanted.name, near, wanted.evidence[0], wanted.said == URL)


def _meant(path: PurePosixPath, named: Sequence[str]) -> str:
    """The only file of that name, or the only one in a folder of the same name; empty for none."""
    beside = (
        named if len(named) == 1 else [each for each in named if PurePosixPath(each).parent.name == path.parent.name]
    )
    return beside[0] if len(beside) == 1 else ""


def _archive_beside(files: Iterable[str], path: str) -> str:
    """The first archive in the folder of a path; empty for none."""
    folder = PurePosixPath(path).parent
    return min(
        (each for each in files if each.endswith(_ARCHIVES) and PurePosixPath(each).parent == folder), default=""
    )
