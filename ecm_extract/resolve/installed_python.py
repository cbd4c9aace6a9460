"""Which Python packages and modules a build installs, and where in the tree they lie.

Source: setuptools, keywords `packages`, `py_modules`, `package_dir`; ament_cmake_python,
`ament_python_install_package`; catkin, `catkin_python_setup`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from posixpath import basename, dirname, join
from typing import Final, NamedTuple

from ecm_extract.read.facts import PackageFacts
from ecm_extract.resolve.paths import tree_path

_ANY: Final = "**"
"""Stands for `find_packages()`."""


class Installed(NamedTuple):
    """A module by the name under which it is imported, and its path in the tree, without `.py`."""

    name: str
    path: str


def installed_modules(package: PackageFacts) -> Mapping[str, str]:
    """Return name -> path of what the build of a package puts on the Python path, outermost packages only."""
    found = (*_of_setups(package), *_of_cmake(package))
    return {each.name: each.path for each in sorted(found)}


def _of_setups(package: PackageFacts) -> Iterator[Installed]:
    for path, setup in package.setups.items():
        for name in setup.packages:
            if name.endswith(_ANY):
                place = name.removesuffix(_ANY) or setup.package_dir.get("", "")
                yield from _searched(package, tree_path(dirname(path), place))
            elif "{" not in name:
                known = name if name in setup.package_dir else name.partition(".")[0]
                yield Installed(known, tree_path(dirname(path), _folder(known, setup.package_dir)))


def _folder(name: str, package_dir: Mapping[str, str]) -> str:
    own = package_dir.get(name)
    return own if own is not None else join(package_dir.get("", ""), name)


def _searched(package: PackageFacts, folder: str) -> Iterator[Installed]:
    """What `find_packages()` finds: folders with an `__init__.py`."""
    for path in package.sources:
        if basename(path) == "__init__.py" and dirname(dirname(path)) == folder:
            yield Installed(basename(dirname(path)), dirname(path))


def _of_cmake(package: PackageFacts) -> Iterator[Installed]:
    for path, file in package.cmake.items():
        for entry in file.python_packages:
            if entry.path != ".":
                folder = tree_path(dirname(path), entry.path)
                yield Installed(basename(folder), folder)
