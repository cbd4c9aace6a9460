"""What a tree is: the files of a folder or of a git ref, listed once and read by path."""

import hashlib
import unicodedata
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Protocol

import msgspec
from ecm_parsers.result import Severity

from ecm_extract.tree.unread import Unread

MAX_FILE_BYTES = 8 * 1024 * 1024
"""Largest file that is read for parsing; generated solvers of half a megabyte are the largest seen in use."""


class Entry(msgspec.Struct, frozen=True):
    """One file of a tree.

    Attributes:
        path: relative to the root, `/` between parts; undecodable bytes are surrogate escapes.
        size: in bytes; None where knowing it would cost a system call, or the blob is missing.
        identity: git blob id; None in a folder until read (`Tree.identity`).
        target: of a symbolic link, the file of this tree that it leads to.
        executable: has the x bit; None where not looked at, and in a folder for no x bit: not all file systems have it.
    """

    path: str
    size: int | None = None
    identity: str | None = None
    target: str | None = None
    executable: bool | None = None

    @property
    def symlink(self) -> bool:
        """Whether the file is a symbolic link to another file of the tree."""
        return self.target is not None


class FileDiagnostic(msgspec.Struct, frozen=True):
    """A diagnostic with its file, in the wire form of `diagnostics[]` (DESIGN §6); `path` is printable.

    Attributes:
        unread: set where it tells of something that was not read.
        about: the name that was looked for, or the module that it is about; empty for none.
        wrong, advice: the sentences of the message apart, see `ecm_parsers.result.Diagnostic`.
    """

    severity: Severity
    code: str
    path: str
    line: int
    message: str
    unread: Unread | None = None
    about: str = ""
    wrong: str = ""
    advice: str = ""


class Tree(Protocol):
    """Files of a folder or of a git ref.

    A tree holds no process and no open file: it may be pickled or forked, and each worker reads by
    itself. A worker's diagnostics stay in the worker's copy, so it must hand them back.
    """

    label: str
    """How the user named it, e.g. `src/nav` or `nav@1.2.0`."""
    commit: str | None
    """Commit id: of the ref, or of HEAD around a folder; None outside a repository."""
    repository: str | None
    """Remote URL without credentials, or the name of the repository's folder."""
    folder: str
    """Name of the folder whose files these are, or were; empty where there is no single one."""
    checkout: Path | None
    """The folder whose files these are, where it is one of a repository; None for a ref and outside any."""

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """What could not be listed or read so far, in order, without repetition."""

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path.

        Raises:
            TreeError: the tree cannot be listed.
        """

    def read(self, path: str) -> bytes:
        """Content of one file, links followed inside the tree.

        Raises:
            TreeReadError: not in the tree, missing, too large or unreadable.
        """

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given; what cannot be read is skipped and reported."""

    def identity(self, path: str) -> str:
        """Git blob id of a file's content.

        Raises:
            TreeReadError: it is not known and the file cannot be read.
        """

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add to `diagnostics`, once."""


def unread_of(diagnostics: Iterable[FileDiagnostic]) -> tuple[Unread, ...]:
    """What diagnostics say was not read, sorted by path and reason."""
    found = {each.unread for each in diagnostics if each.unread is not None}
    return tuple(sorted(found, key=lambda each: (each.path, each.reason, each.commit)))


def blob_id(data: bytes) -> str:
    """Git's SHA-1 name of a file with this content."""
    return hashlib.sha1(b"blob %d\0" % len(data) + data, usedforsecurity=False).hexdigest()


def printable(text: str) -> str:
    r"""Text that is safe to print and to encode: undecodable bytes and control characters as `\xNN`."""
    decoded = text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
    if decoded.isprintable():
        return decoded
    return "".join(_shown(char) for char in decoded)


def _shown(char: str) -> str:
    if char.isprintable() or unicodedata.category(char) == "Zs":
        return char
    return char.encode("unicode_escape").decode("ascii")
