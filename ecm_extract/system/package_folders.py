"""Where packages lie: what launch files and descriptions find files by."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
from ecm_checker.hub.package import Package
from ecm_checker.hub.running import CopiedPath

from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.installed import copied_paths


class PackageFolder(msgspec.Struct, frozen=True):
    """The folder of a package.

    Attributes:
        name: of the package. path: of the folder in the tree, empty for its root. ros: 1 or 2; None when not known.
        copied: what its share folder has from elsewhere.
    """

    name: str
    path: str
    ros: int | None
    copied: tuple[CopiedPath, ...] = ()


def folders_read(packages: Iterable[PackageFacts]) -> tuple[PackageFolder, ...]:
    """Return the folders of packages that were read."""
    return tuple(
        PackageFolder(facts.name, facts.root.path, facts.ros, tuple(copied_paths(facts))) for facts in packages
    )


def folders_stored(packages: Iterable[Package]) -> tuple[PackageFolder, ...]:
    """Return the folders of packages by their documents."""
    return tuple(_folder(package) for package in packages)


def _folder(package: Package) -> PackageFolder:
    path = "" if package.path == "." else package.path
    copied = package.running.copied if package.running else ()
    return PackageFolder(package.name, path, package.ros, copied)
