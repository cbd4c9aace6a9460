"""Where the paths of findings lie: for who reads them here, and for a code host.

A finding names files relative to the tree that was read. A terminal needs the path from where one stands, as it was
typed; a code host needs the path from the root of the repository.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path, PurePosixPath
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding

from ecm_extract.tree.git_repo import find_repo

FROM_REPOSITORY: Final = frozenset({"sarif", "github", "junit", "markdown", "html"})
"""Formats that are read beside a repository; `json` keeps to the tree, `text` to where one stands."""

FOREIGN: Final = "document:"
"""Begins the path of a line that only a stored document tells: `document:PACKAGE/PATH`."""

Line = Callable[[Evidence], str | None]
"""Gives the text of a line that was read, None where it is not known."""


class Places(msgspec.Struct, frozen=True):
    """Turns places of a tree into places that others can open.

    Attributes:
        folder: that the paths of the tree begin in, as it was typed.
        homes: the folder of places that lie in another tree.
        line: gives the text of a line.
    """

    folder: str = "."
    homes: Mapping[Evidence, str] = {}
    line: Line = lambda _place: None

    def from_here(self, place: Evidence) -> Evidence:
        """The place as a terminal opens it; one that only a document tells as it is."""
        if is_foreign(place):
            return place
        return msgspec.structs.replace(place, path=str(PurePosixPath(self._home(place)) / place.path))

    def from_repository(self, place: Evidence) -> Evidence:
        """The place from the root of the repository around the folder; as it is where it is in none, or outside."""
        root = self.root()
        path = Path(self._home(place)).resolve() / place.path
        if root is None or is_foreign(place) or not path.is_relative_to(root):
            return place
        return msgspec.structs.replace(place, path=path.relative_to(root).as_posix())

    def root(self) -> Path | None:
        """The root of the work tree around the folder; None where there is none."""
        start = Path(self.folder)
        repo = find_repo(start) if start.is_dir() else None
        return repo.work_tree if repo is not None else None

    def _home(self, place: Evidence) -> str:
        return self.homes.get(place, self.folder)


def is_foreign(place: Evidence) -> bool:
    """Tell whether a line is of a tree that only a stored document tells of, so that nobody can open it here."""
    return place.path.startswith(FOREIGN)


def in_tree(path: str) -> str:
    """Return a path as it is in its own tree, also of a file that only a document tells of."""
    return path.removeprefix(FOREIGN).partition("/")[2] if path.startswith(FOREIGN) else path


def typed_folder(spec: str) -> str:
    """The folder that the paths of a tree begin in: of `DIR`, `DIR@REF` or `DIR@REF:subdir`."""
    if Path(spec).exists():
        return spec
    folder, _, ref = spec.rpartition("@")
    return str(PurePosixPath(folder or spec) / ref.partition(":")[2]) if folder else spec


def placed_for(form: str, findings: Iterable[Finding], places: Places) -> list[Finding]:
    """Findings with the paths that a format needs; a code host is told no line that it cannot open."""
    if form not in FROM_REPOSITORY:
        return list(findings)
    return [placed(_opened(finding), places.from_repository) for finding in findings]


def _opened(finding: Finding) -> Finding:
    return msgspec.structs.replace(finding, evidence=tuple(at for at in finding.evidence if not is_foreign(at)))


def placed(finding: Finding, where: Callable[[Evidence], Evidence]) -> Finding:
    """A finding with other paths."""
    return msgspec.structs.replace(finding, evidence=tuple(map(where, finding.evidence)))
