"""The tree under lint with the files that only documents tell of, each below `document:PACKAGE/`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import groupby

import msgspec
from ecm_checker.hub.package import Package
from ecm_checker.hub.running import CopiedPath
from ecm_parsers.launch.model import LaunchFile

from ecm_extract.report.places import FOREIGN
from ecm_extract.system.files import Files
from ecm_extract.system.launch_files import is_aside, is_launch_file, read_launch
from ecm_extract.system.package_folders import PackageFolder, folders_stored
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import Entry, FileDiagnostic, Tree, Unread
from ecm_extract.tree.joined import JoinedTree
from ecm_extract.tree.stored import StoredTree


class Beside:
    """What documents tell of files: the tree with them, its files by package, and those that may concern the tree.

    Args:
        tree: under lint. files: of it. folders: of its packages.
        documents: of packages that lie beside it.
    """

    def __init__(
        self, tree: Tree, files: Files, folders: Sequence[PackageFolder], documents: Sequence[Package]
    ) -> None:
        self._documents = documents
        self._own = frozenset(each.name for each in folders)
        self.tree: Tree = BesideTree(tree, documents) if documents else tree
        self.files = Files(self.tree, (*folders, *folders_beside(documents))) if documents else files

    @cached_property
    def launches(self) -> Mapping[str, LaunchFile]:
        """Launch files that documents keep, by path; those of tests, and those that are put aside, are left out."""
        found: dict[str, LaunchFile] = {}
        for path, package in self._texts.items():
            if is_launch_file(path) and not is_aside(path):
                read = read_launch(path, self.files.read(path) or b"", package.ros)
                found |= {path: read.facts} if read.facts is not None else {}
        return found

    @cached_property
    def descriptions(self) -> Sequence[str]:
        """Paths of the robot descriptions that documents keep; those of tests are left out."""
        return [path for path in self._texts if is_description(path)]

    def ending(self, *ends: str) -> Iterator[str]:
        """Yield the paths with some endings of the files that documents keep; those of tests are left out."""
        return (path for path in self._texts if path.endswith(ends))

    def reaching(self, paths: Iterable[str]) -> Iterator[str]:
        """Yield the files whose package asks for names of the tree, or of packages that do."""
        return (path for path in paths if self.files.package_of(path) in self._reaching)

    @cached_property
    def _reaching(self) -> frozenset[str]:
        asked = {each.name: {row.package or row.name for row in each.requires} for each in self._documents}
        found: set[str] = set()
        while more := {name for name in asked.keys() - found if not asked[name].isdisjoint(found | self._own)}:
            found |= more
        return frozenset(found)

    @cached_property
    def _texts(self) -> Mapping[str, Package]:
        """The packages by the paths of their own files whose content is kept."""
        return {
            f"{FOREIGN}{each.name}/{path}": each
            for each in self._documents
            for path in (each.running.texts if each.running else ())
            if each.holds(path) and not is_test_path(path, each.path)
        }


class BesideTree:
    """A tree and documents; see `Tree` for its members.

    What is said of files that only documents tell of is of another tree, apart from those whose content is not kept.
    """

    def __init__(self, tree: Tree, documents: Iterable[Package]) -> None:
        self.label, self.commit, self.repository = tree.label, tree.commit, tree.repository
        self.folder, self.checkout = tree.folder, tree.checkout
        self._tree = tree
        self._others = JoinedTree({f"{FOREIGN}{each.name}": _tree_of(each) for each in documents})

    @property
    def diagnostics(self) -> tuple[FileDiagnostic, ...]:
        """Those of the tree."""
        return self._tree.diagnostics

    def files(self) -> tuple[Entry, ...]:
        """All files, sorted by path."""
        return tuple(sorted((*self._tree.files(), *self._others.files()), key=lambda entry: entry.path))

    def read(self, path: str) -> bytes:
        """Content of one file."""
        return self._of(path).read(path)

    def read_many(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        """Content of many files in the order given."""
        for foreign, group in groupby(paths, _is_foreign):
            together = list(group)
            yield from self._kept(together) if foreign else self._tree.read_many(together)

    def identity(self, path: str) -> str:
        """Git blob id of a file's content."""
        return self._of(path).identity(path)

    def report(self, diagnostic: FileDiagnostic) -> None:
        """Add what is said of a file of the tree to its diagnostics."""
        if not _is_foreign(diagnostic.path):
            self._tree.report(diagnostic)

    def _of(self, path: str) -> Tree:
        return self._others if _is_foreign(path) else self._tree

    def _kept(self, paths: Iterable[str]) -> Iterator[tuple[str, bytes]]:
        for path in paths:
            found = dict(self._others.read_many([path]))
            if path not in found:
                self._tell_not_kept(path)
            yield from found.items()

    def _tell_not_kept(self, path: str) -> None:
        message = (
            "The document of its package keeps no content of it, so that what it starts or describes is not known."
        )
        self._tree.report(FileDiagnostic("warning", "text-not-kept", path, 0, message, Unread(path, "unjudged")))


def folders_beside(documents: Iterable[Package]) -> Iterator[PackageFolder]:
    """Yield the folders of packages in such a tree."""
    for each in documents:
        mark = f"{FOREIGN}{each.name}"
        for folder in folders_stored([each]):
            copied = (_marked(row, mark) for row in folder.copied)
            yield msgspec.structs.replace(folder, path=f"{mark}/{folder.path}".rstrip("/"), copied=tuple(copied))


def is_description(path: str) -> bool:
    """Tell by its name whether a file is a robot description, or a part of one."""
    return path.endswith((".urdf", ".xacro"))


def _marked(row: CopiedPath, mark: str) -> CopiedPath:
    return msgspec.structs.replace(row, named=f"{mark}/{row.named}", source=f"{mark}/{row.source}")


def _tree_of(package: Package) -> StoredTree:
    texts = package.running.texts if package.running else {}
    return StoredTree(package.name, None, None, frozenset(package.files), texts)


def _is_foreign(path: str) -> bool:
    return path.startswith(FOREIGN)
