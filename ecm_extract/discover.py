"""Which folders of a tree are packages, and which files belong to each."""

from collections.abc import Collection, Iterable

import msgspec

from ecm_extract.exclusion import Exclusion
from ecm_extract.tree import Entry, FileDiagnostic, Tree, Unread, can_declare, printable

MANIFESTS = ("package.xml", "manifest.xml")
"""Package manifests: REP 149 and its predecessors, then rosbuild's (until ROS Fuerte)."""

IGNORE_MARKERS = ("COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE")
"""Files that hide their folder from the build tool of the same name."""


class PackageRoot(msgspec.Struct, frozen=True):
    """A folder that is a package.

    Attributes:
        path: of the folder, relative to the root of the tree; empty for the root itself.
        manifest: path of `package.xml` or `manifest.xml`; None of the pseudo package of a tree without any.
        files: of the package, sorted by path, without those of packages inside it.
        top: name of the tree's own folder, which no path in the tree tells.
    """

    path: str
    manifest: str | None
    files: tuple[Entry, ...]
    top: str = ""

    @property
    def folder(self) -> str:
        """The name of its folder; empty where nothing tells it."""
        return self.path.rpartition("/")[2] or self.top

    @property
    def rosbuild(self) -> bool:
        """Whether it is a package of the time before catkin (ROS Fuerte and older)."""
        return self.manifest is not None and self.manifest.endswith("manifest.xml")


def discover(tree: Tree, exclude: Exclusion | None = None) -> tuple[PackageRoot, ...]:
    """Packages of a tree, sorted by path; what was left out is reported to the tree.

    Raises:
        TreeError: the tree cannot be listed.
    """
    kept = _not_marked(tree, exclude.kept(tree) if exclude is not None else tree.files())
    manifests = _manifests(kept)
    if not manifests:
        tree.report(_no_package(tree))
        return (PackageRoot("", None, kept),)
    return _packages(manifests, kept, tree.folder)


def _not_marked(tree: Tree, entries: tuple[Entry, ...]) -> tuple[Entry, ...]:
    """Files outside of the folders that a marker hides; the hidden folders are reported."""
    marked = {_folder(entry.path) for entry in entries if _name(entry.path) in IGNORE_MARKERS}
    ignored = marked - {""}  # who gives a folder by name means it
    manifests = {_folder(entry.path) for entry in entries if _name(entry.path) in MANIFESTS}
    hidden = [entry.path for entry in entries if _is_hidden(entry.path, ignored, manifests)]
    outer = sorted(folder for folder in ignored if not _is_under(folder, ignored - {folder}))
    for folder in outer:
        below = [path for path in hidden if _is_under(path, {folder})]
        if below:
            tree.report(_ignored_note(folder, below))
    left_out = frozenset(hidden)
    return tuple(entry for entry in entries if entry.path not in left_out)


def _is_hidden(path: str, ignored: set[str], manifests: set[str]) -> bool:
    """Whether no build reads a file: a marker hides packages, and nothing that the build of one outside of it names."""
    if not _is_under(path, ignored):
        return False
    owner = _owner(path, manifests)
    return owner is None or owner in ignored or _is_under(owner, ignored)


def _manifests(entries: Collection[Entry]) -> dict[str, str]:
    """Manifest path by folder; a `manifest.xml` in or below a `package.xml` package is only data."""
    modern, rosbuild = (
        {_folder(entry.path): entry.path for entry in entries if _name(entry.path) == name} for name in MANIFESTS
    )
    old = {folder: path for folder, path in rosbuild.items() if _owner(path, modern) is None}
    return old | modern


def _packages(manifests: dict[str, str], entries: Iterable[Entry], top: str) -> tuple[PackageRoot, ...]:
    files: dict[str, list[Entry]] = {folder: [] for folder in manifests}
    for entry in entries:
        owner = _owner(entry.path, files)
        if owner is not None:
            files[owner].append(entry)
    return tuple(PackageRoot(folder, manifests[folder], tuple(files[folder]), top) for folder in sorted(files))


def _owner(path: str, roots: Collection[str]) -> str | None:
    """The innermost package folder that holds `path`; None for files outside any package."""
    return next((folder for folder in _folders(path) if folder in roots), None)


def _is_under(path: str, folders: set[str]) -> bool:
    return bool(folders) and any(folder in folders for folder in _folders(path))


def _folders(path: str) -> Iterable[str]:
    """The folders that hold `path`, innermost first, the root (empty) last."""
    while path:
        path = _folder(path)
        yield path


def _folder(path: str) -> str:
    return path.rpartition("/")[0]


def _name(path: str) -> str:
    return path.rpartition("/")[2]


def _ignored_note(folder: str, files: Collection[str]) -> FileDiagnostic:
    message = (
        f"The folder and its {len(files)} file(s) are left out, as the build tool does. "
        f"Remove {', '.join(IGNORE_MARKERS[:-1])} or {IGNORE_MARKERS[-1]} there to read them."
    )
    shown = printable(folder)
    return FileDiagnostic("info", "ignored-folder", shown, 0, message, Unread(shown, "ignored", _any_declares(files)))


def _any_declares(files: Iterable[str]) -> bool:
    return any(can_declare(path) for path in files if _name(path) not in IGNORE_MARKERS)


def _no_package(tree: Tree) -> FileDiagnostic:
    message = (
        f"{tree.label} holds no package.xml, so it is read as one package without name and version. "
        "Give the folder of a package or workspace."
    )
    return FileDiagnostic("warning", "no-package", ".", 0, message)
