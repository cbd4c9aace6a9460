"""Files that launch files name in the share folder of a package that is known, and that nothing puts there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

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
    """

    consumer: str
    package: str
    path: str
    near: str
    place: Evidence
    is_url: bool


def absent_files(known: Known) -> Iterator[NamedFile]:
    """Yield what attributes of launch files of XML name; packages whose build may make files are left out."""
    for asked in known.asked("names_file"):
        wanted = asked.requirement
        owner = known.packages.by_name.get(wanted.package or "")
        if owner is None or asked.match.state != "dangling" or owner.makes_files:
            continue
        named = known.named_like(owner.name, wanted.name, TEMPLATES)
        if all(PurePosixPath(path).name == PurePosixPath(wanted.name).name for path in named):
            yield _absent(asked, owner.name, named)


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
