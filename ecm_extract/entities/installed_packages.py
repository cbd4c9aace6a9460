"""Which import packages the build files of a package name: what lies beside them is run, or is the maintainers' own."""

from __future__ import annotations

from typing import Final

from ecm_extract.entities.paths import inside
from ecm_extract.read.facts import PackageFacts

_SEARCHED: Final = frozenset("*${")
"""What stands in the name of a package that is searched for or not known."""


class InstalledPackages:
    """What setup files and CMake install to be imported; where one searches, each folder with an `__init__.py`."""

    def __init__(self, facts: PackageFacts) -> None:
        named = {name for setup in facts.setups.values() for name in setup.packages}
        named |= {entry.path.rpartition("/")[2] for file in facts.cmake.values() for entry in file.python_packages}
        named.discard(".")
        self._own = facts.name
        self._named = {name.replace("/", ".").partition(".")[0] for name in named if not _SEARCHED & set(name)}
        self._is_searched = any(_SEARCHED & set(name) for name in named) or not named
        self._begun = {inside(path, facts.root.path) for path in facts.sources if path.endswith("/__init__.py")}

    def have(self, root: str, top: str) -> bool:
        """Whether a package or module directly below a folder of packages is installed."""
        if top in self._named:
            return True
        return (self._is_searched or top == self._own) and f"{root}{top}/__init__.py" in self._begun
