"""What both kinds of tree share: a listing made once, links put in their place, diagnostics kept once."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath

import msgspec
from ecm_parsers.result import Severity

from ecm_extract.errors import TreeError, TreeReadError
from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, FileDiagnostic, blob_id, printable
from ecm_extract.tree.links import LinkProblem, resolve
from ecm_extract.tree.unread import Reason, Unread, can_declare

MAX_FILES = 250_000
"""Most files in one tree; the largest public robot workspaces have some ten thousand."""

_REASONS: Mapping[str, Reason] = {"missing-blob": "missing", "too-large": "too-large", "unreadable": "unreadable"}
"""Why a file was not read, by the code of its error; a file that is in no tree was not missed."""

_LINK_MESSAGES: dict[LinkProblem, str] = {
    "symlink-outside": "The link leads out of the tree and is not followed. Extract the tree of its target.",
    "symlink-loop": "The link leads in a circle. Point it at a file.",
    "symlink-directory": "The link leads to a folder of this tree, whose files are read in their own place.",
    "symlink-broken": "The link leads to no file of this tree. Remove it or point it at a file.",
}


class Listing(msgspec.Struct, frozen=True):
    """The raw content of a tree: regular files, and the text of each link by its path."""

    entries: tuple[Entry, ...]
    links: dict[str, str]
    diagnostics: tuple[FileDiagnostic, ...] = ()


class ListedTree(ABC):
    """A tree that is listed at first use; see `ecm_extract.tree.base.Tree` for what each member means."""

    def __init__(self, label: str, commit: str | None, repository: str | None) -> None:
        self.label = label
        self.commit = commit
        self.repository = repository
        self.folder = ""
        self.checkout: Path | None = None
        self._entries: dict[str, Entry] | None = None
        self._log: dict[FileDiagnostic, None] = {}

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """What could not be listed or read so far."""
        return tuple(self._log)

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path."""
        return tuple(self._by_path().values())

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given."""
        for path in paths:
            try:
                yield path, self.read(path)
            except TreeReadError as error:
                self._report_error(error)

    def identity(self, path: str) -> str:
        """Git blob id of a file's content."""
        return self._entry(path).identity or blob_id(self.read(path))

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add to `diagnostics`, once."""
        self._log.setdefault(diagnostic)

    @abstractmethod
    def read(self, path: str) -> bytes:
        """Content of one file."""

    @abstractmethod
    def _list(self) -> Listing:
        """List the tree; called once."""

    def _by_path(self) -> dict[str, Entry]:
        if self._entries is None:
            listing = self._list()
            for diagnostic in (*listing.diagnostics, *_link_diagnostics(listing)):
                self.report(diagnostic)
            entries = (*listing.entries, *_linked(listing))
            self._entries = {entry.path: entry for entry in sorted(entries, key=lambda entry: entry.path)}
        return self._entries

    def _entry(self, path: str) -> Entry:
        entry = self._by_path().get(path)
        if entry is None:
            shown = printable(path)
            raise TreeReadError(shown, "not-in-tree", f"{shown} is not a file of {self.label}.")
        return entry

    def _report_error(self, error: TreeReadError) -> None:
        message = f"{error.message} {error.hint}".rstrip()
        reason = _REASONS.get(error.code)
        unread = Unread(error.path, reason, can_declare(error.path)) if reason is not None else None
        self.report(FileDiagnostic("warning", error.code, error.path, 0, message, unread))


def too_large(path: str, size: int) -> TreeReadError:
    """The error for a file above the bound on what is parsed."""
    shown = printable(path)
    message = f"{shown} has {size} bytes, more than the {MAX_FILE_BYTES} that are read for parsing."
    return TreeReadError(shown, "too-large", message, "Split it, or exclude it in ecm.toml ([extract] exclude).")


def too_many(label: str) -> TreeError:
    """The error for a tree above the bound on its number of files."""
    message = f"{label} has more than {MAX_FILES} files or folders too deep to list."
    return TreeError(message, "Give the folder of the packages, e.g. the `src` of the workspace.")


def _linked(listing: Listing) -> Iterator[Entry]:
    files = {entry.path: entry for entry in listing.entries}
    for path in listing.links:
        target = resolve(path, listing.links, files, ()).target
        if target is not None:
            yield msgspec.structs.replace(files[target], path=path, target=target)


def _link_diagnostics(listing: Listing) -> Iterator[FileDiagnostic]:
    if not listing.links:
        return
    files = {entry.path for entry in listing.entries}
    folders = _folders(files)
    for path in sorted(listing.links):
        problem = resolve(path, listing.links, files, folders).problem
        if problem is not None:
            severity: Severity = "info" if problem == "symlink-directory" else "warning"
            shown = printable(path)
            unread = Unread(shown, "link", can_declare(path)) if problem == "symlink-outside" else None
            yield FileDiagnostic(severity, problem, shown, 0, _LINK_MESSAGES[problem], unread)


def _folders(files: Iterable[str]) -> set[str]:
    parents = {path.rpartition("/")[0] for path in files}
    return {str(folder) for path in parents for folder in (PurePosixPath(path), *PurePosixPath(path).parents)}
