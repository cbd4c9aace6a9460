"""What an extraction gives and what it may be told: records that the core, the reports and the command share.

The core fills these (`ecm_extract.extraction.extract`); reports render them; nothing here does any work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal

import msgspec
from ecm_checker.contract import Contract

from ecm_extract.tree.unread import Unread

Severity = Literal["error", "warning", "info"]
Progress = Callable[[int, int], None]


class LocatedDiagnostic(msgspec.Struct, frozen=True):
    """Something that could not be read, and where.

    Attributes:
        severity: `error` when facts were lost, `warning` when they are doubtful, `info` otherwise.
        code: stable kebab-case name of the problem; the summary groups by it.
        path: relative to the root of the tree, `/` separated.
        line: 1-based; 0 when it concerns the file as a whole.
        message: what is wrong and what to do.
    """

    severity: Severity
    code: str
    path: str
    line: int
    message: str


def sorted_diagnostics(found: Iterable[LocatedDiagnostic]) -> tuple[LocatedDiagnostic, ...]:
    """Return diagnostics in the order in which documents hold them, each once."""
    return tuple(sorted(set(found), key=lambda entry: (entry.path, entry.line, entry.code, entry.message)))


class PackageContracts(msgspec.Struct, frozen=True):
    """One ROS package and the contracts of its modules.

    Attributes:
        name: as in `package.xml`.
        version: as in `package.xml`; None when it declares none.
        path: of its folder, relative to the root of the tree; `.` for the root itself.
        ros: 1 or 2; None when no artefact tells.
        modules: in a stable order (by module id).
        hub: what it provides and requires, as canonical JSON (`ecm_checker.hub.package.Hub`); empty when not asked for.
    """

    name: str
    version: str | None
    path: str
    ros: Literal[1, 2] | None
    modules: tuple[Contract, ...]
    hub: bytes = b""


class Counts(msgspec.Struct, frozen=True):
    """How much was read: files, and their bytes."""

    files: int = 0
    bytes: int = 0


class Extraction(msgspec.Struct, frozen=True):
    """The contracts of a tree beside what could not be read of it.

    Attributes:
        path: label of the source as the user gave it (`path` or `path@ref`).
        commit: full commit id of a git ref; None for files that are in no commit.
        packages: in a stable order (by path).
        diagnostics: in a stable order (by path, line, code).
        elapsed: seconds from opening the tree to the last contract.
        counts: files and bytes read.
        unread: what of the tree was not read.
    """

    path: str
    commit: str | None
    packages: tuple[PackageContracts, ...]
    diagnostics: tuple[LocatedDiagnostic, ...] = ()
    elapsed: float = 0.0
    counts: Counts = Counts()
    unread: tuple[Unread, ...] = ()


class Options(msgspec.Struct, frozen=True):
    """What a person may choose about an extraction.

    Attributes:
        include_tests: also read test folders.
        config: path of an `ecm.toml`; None looks for one at the root of the tree.
        jobs: worker processes; None takes one per core.
        progress: called with (files done, files in all) now and then; must be cheap.
        cache: take from the user's cache what was read before, and add to it.
        hub: also read what packages provide and require.
    """

    include_tests: bool = False
    config: str | None = None
    jobs: int | None = None
    progress: Progress | None = None
    cache: bool = True
    hub: bool = False
