"""What others may have set: packages that are found, and CMake itself."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

_OWN: Final = ("CMAKE_", "ENV_", "CACHE_")


class Outside:
    """The packages that were looked for; each may set variables that begin with its name."""

    def __init__(self) -> None:
        self._prefixes: tuple[str, ...] = ()
        self._assigned: set[str] = set()

    @property
    def has_any(self) -> bool:
        """Whether anything from outside of the tree has run."""
        return bool(self._prefixes)

    def add(self, names: Iterable[str]) -> None:
        """Remember packages or components."""
        self._prefixes += tuple(f"{name.lower()}_" for name in names)

    def assign(self, names: Iterable[str]) -> None:
        """Remember variables that files of the tree set somewhere."""
        self._assigned.update(names)

    def leaves_empty(self, name: str) -> bool:
        """Tell whether a variable that nothing has set so far is for the tree alone to set."""
        return name in self._assigned and not self.may_set(name)

    def may_set(self, name: str) -> bool:
        """Tell whether a variable may be set by what is not read."""
        return name.startswith(_OWN) or name.lower().startswith(self._prefixes)
