"""A tree that is a folder on disk: a work tree, a workspace or an unpacked archive."""

import os
import stat
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from ecm_parsers.result import Severity

from ecm_extract.errors import TreeError, TreeReadError
from ecm_extract.tree.base import MAX_FILE_BYTES, Entry, FileDiagnostic, printable
from ecm_extract.tree.listing import MAX_FILES, ListedTree, Listing, too_large, too_many
from ecm_extract.tree.submodules import submodule_unread
from ecm_extract.tree.unread import Unread

_NEVER = frozenset({".git", ".hg", ".svn", ".bzr", ".venv", "node_modules", "__pycache__", ".tox"})
# A file of these in a folder of that name shows that a build tool wrote it (colcon, catkin, CMake).
_GENERATED = {
    "build": frozenset({"COLCON_IGNORE", "CATKIN_IGNORE", "CMakeCache.txt", ".built_by"}),
    "install": frozenset({"COLCON_IGNORE", ".colcon_install_layout", ".catkin", "local_setup.bash"}),
    "log": frozenset({"COLCON_IGNORE", "latest_build"}),
    "devel": frozenset({"COLCON_IGNORE", ".catkin", "local_setup.bash"}),
}
_OPEN_FLAGS = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)


class DirectoryTree(ListedTree):
    """The files of one folder; see `Tree` for its members.

    Args:
        root: the folder.
        label: how the user named it.
        commit: HEAD of the repository around it, None outside any.
        repository: public name of that repository.
        submodules: commit of each submodule below the folder that HEAD names, by its path in the folder.
    """

    def __init__(
        self,
        root: Path,
        *,
        label: str,
        commit: str | None,
        repository: str | None,
        submodules: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(label, commit, repository)
        self.root = root
        self.folder = printable(root.name)
        self.checkout = root if commit is not None else None
        self._submodules = submodules or {}

    def read(self, path: str) -> bytes:
        """Content of one file."""
        entry = self._entry(path)
        try:
            return _read(self.root / (entry.target or entry.path), path)
        except OSError as error:
            shown = printable(path)
            message = f"{shown} cannot be read: {error.strerror}."
            raise TreeReadError(shown, "unreadable", message, "Check its permissions.") from error

    def _list(self) -> Listing:
        walk = _Walk(self.label)
        walk.folder(self.root, "")
        while walk.todo:
            path = walk.todo.pop()
            walk.folder(self.root / path, path)
        diagnostics = (*walk.diagnostics, *self._not_checked_out(walk.entries))
        return Listing(tuple(walk.entries), walk.links, diagnostics)

    def _not_checked_out(self, entries: Sequence[Entry]) -> Iterator[FileDiagnostic]:
        """Submodules whose folder is empty: `git submodule update` has not run."""
        for path, commit in self._submodules.items():
            if not any(entry.path.startswith(f"{path}/") for entry in entries):
                yield submodule_unread(path, commit)


class _Walk:
    """The state of one walk over a folder; uses the type that the folder tells, so no call a file."""

    def __init__(self, label: str) -> None:
        self.label = label
        self.todo: list[str] = []
        self.entries: list[Entry] = []
        self.links: dict[str, str] = {}
        self.diagnostics: list[FileDiagnostic] = []

    def folder(self, folder: Path, path: str) -> None:
        """List one folder into the state; `path` is relative to the root, empty for the root."""
        try:
            with os.scandir(folder) as found:
                items = sorted(found, key=lambda item: item.name)
        except OSError as error:
            self._unreadable(path, error)
            return
        if path and _is_generated(folder.name, {item.name for item in items}):
            self._note("info", "generated-folder", path, "A build tool wrote this folder; it is not read.")
            return
        for item in items:
            self._item(item, f"{path}/{item.name}" if path else item.name)
        if len(self.entries) + len(self.links) > MAX_FILES:
            raise too_many(self.label)

    def _item(self, item: os.DirEntry[str], path: str) -> None:
        if item.is_symlink():
            self._link(item, path)
        elif item.is_dir(follow_symlinks=False):
            if item.name not in _NEVER:
                self.todo.append(path)
        elif item.is_file(follow_symlinks=False):
            self.entries.append(Entry(path, executable=_may_run(item)))
        elif item.name not in _NEVER:
            self._note("info", "special-file", path, "A device, socket or pipe is not read.")

    def _link(self, item: os.DirEntry[str], path: str) -> None:
        try:
            self.links[path] = os.readlink(item.path)  # noqa: PTH115 - a Path would tidy the text
        except OSError as error:
            self._not_read(path, f"The link cannot be read: {error.strerror}.")

    def _unreadable(self, path: str, error: OSError) -> None:
        if not path:
            message = f"The folder {self.label} cannot be listed: {error.strerror}."
            raise TreeError(message, "Check the path and its permissions.") from error
        message = f"The folder cannot be listed: {error.strerror}. Check its permissions."
        self._not_read(path, message)

    def _not_read(self, path: str, message: str) -> None:
        shown = printable(path)
        self.diagnostics.append(FileDiagnostic("warning", "unreadable", shown, 0, message, Unread(shown, "unreadable")))

    def _note(self, severity: Severity, code: str, path: str, message: str) -> None:
        self.diagnostics.append(FileDiagnostic(severity, code, printable(path), 0, message))


def _may_run(item: os.DirEntry[str]) -> bool | None:
    """Whether a file has the x bit; asked only of names without a dot, since each question is a system call."""
    if "." in item.name:
        return None
    try:
        return bool(item.stat(follow_symlinks=False).st_mode & 0o111) or None
    except OSError:
        return None


def _is_generated(name: str, content: set[str]) -> bool:
    markers = _GENERATED.get(name, frozenset())
    return "pyvenv.cfg" in content or not markers.isdisjoint(content)


def _read(file: Path, path: str) -> bytes:
    """Read a regular file; a pipe or a link put in its place meanwhile is neither waited for nor followed."""
    with os.fdopen(os.open(file, _OPEN_FLAGS), "rb") as stream:
        status = os.fstat(stream.fileno())
        if not stat.S_ISREG(status.st_mode):
            shown = printable(path)
            message = f"{shown} is no longer a regular file."
            raise TreeReadError(shown, "unreadable", message, "Run again.")
        if status.st_size > MAX_FILE_BYTES:
            raise too_large(path, status.st_size)
        return stream.read(MAX_FILE_BYTES)
