"""Which class a C++ function is a member of, where it is defined outside of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_extract.link.code.units import Cls, File
from ecm_extract.resolve.cpp_classes import CppClasses
from ecm_extract.resolve.outcome import External


class CppOwners:
    """Looks up the class in front of the name of a member.

    Args:
        lookup: of classes.
        classes: by their qualified names.
        aliases: last names of what may stand for a class.
    """

    def __init__(self, lookup: CppClasses, classes: Mapping[str, Sequence[Cls]], aliases: frozenset[str]) -> None:
        self._lookup = lookup
        self._classes = classes
        self._last_names = aliases.union(name.rpartition("::")[2] for name in classes)

    def find(self, scope: str, file: File) -> Cls | None:
        """Return the class that the scope of a function is; None of a namespace and where several are meant.

        With `using` the scope is a part of the name of the class, inside a namespace it may repeat it; it may be what a
        file calls the class: `using Self = Robot; void Self::start() {}`.
        """
        if scope.rpartition("::")[2] not in self._last_names:
            return None
        for written in _endings(scope):
            found = self._lookup.seen(f"::{written}", file)
            if not isinstance(found, External):
                return found if isinstance(found, Cls) else None
        inside = [cls for cls in self._classes.get(scope, ()) if cls.file.package == file.package]
        return inside[0] if len(inside) == 1 else None


def _endings(scope: str) -> Iterator[str]:
    parts = scope.split("::")
    return ("::".join(parts[at:]) for at in range(len(parts)))
