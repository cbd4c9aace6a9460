"""A consumer: what one package requires, with what its files say around each requirement."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Final

from ecm_checker.hub.requirement import Requirement

HEADER: Final = "header"
SYMBOL: Final = "symbol"
_MODULE: Final = "module"


class Consumer:
    """The requirements of a package.

    Attributes:
        package: its name. requirements: all of them.
        ros: 1 or 2; None when nothing tells.
    """

    def __init__(self, package: str, requirements: Sequence[Requirement], ros: int | None = None) -> None:
        self.package, self.requirements, self.ros = package, requirements, ros

    def headers_of(self, path: str) -> frozenset[str]:
        """Return what a C++ file includes, as written."""
        return self._said(HEADER).get(path, frozenset())

    def modules_of(self, path: str) -> frozenset[str]:
        """Return the first part of what a Python file imports."""
        return self._tops.get(path, frozenset())

    def symbols_of(self, path: str) -> frozenset[str]:
        """Return the names with a namespace that a C++ file has."""
        return self._said(SYMBOL).get(path, frozenset())

    @cached_property
    def _by_word(self) -> Mapping[str, Mapping[str, frozenset[str]]]:
        found: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
        for entry in self.requirements:
            tells = entry.row.tells
            if tells:
                found[tells][entry.evidence[0].path].add(entry.name)
        return {word: {path: frozenset(names) for path, names in paths.items()} for word, paths in found.items()}

    def _said(self, word: str) -> Mapping[str, frozenset[str]]:
        return self._by_word.get(word, {})

    @cached_property
    def _tops(self) -> Mapping[str, frozenset[str]]:
        imports = self._said(_MODULE)
        return {path: frozenset(name.partition(".")[0] for name in names) for path, names in imports.items()}
