"""Questions that lead to each other on many ways: each is answered once for the first of them."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TYPE_CHECKING

from ecm_extract.link.running.env import Bound

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class AskedOnce:
    """Keeps answers as long as the first question is open; who asks in a circle gets none."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._found: dict[Hashable, Bound | None] = {}
        self._open: set[Hashable] = set()

    def answer(self, asked: Hashable, find: Callable[[], Bound | None]) -> Bound | None:
        """Return what is found for a question, which is looked for once."""
        if asked in self._found:
            return self._found[asked]
        if asked in self._open:
            self.folder.cuts += 1
            return None
        self._open.add(asked)
        try:
            found = self._found[asked] = find()
        finally:
            self._open.remove(asked)
            if not self._open:
                self._found.clear()
        return found
