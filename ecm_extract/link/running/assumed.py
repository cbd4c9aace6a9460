"""Questions whose answers depend on each other: yes, unless something that is known says no."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

Asked = TypeVar("Asked", bound=Hashable)


class Assumed(Generic[Asked]):
    """Answers yes-or-no questions, each once: what is asked meanwhile counts as yes until that is refuted.

    Args:
        holds: answers a question by asking others of here; the more of these hold, the rather does it. What it
            raises is passed on, and nothing that was assumed meanwhile is kept.
    """

    def __init__(self, holds: Callable[[Asked], bool]) -> None:
        self._holds = holds
        self._known: dict[Asked, bool] = {}
        self._assumed: list[Asked] = []
        self._pending: list[Asked] = []
        self._askers = defaultdict[Asked, dict[Asked, None]](dict)
        self._at: Asked | None = None

    def of(self, asked: Asked) -> bool:
        """Answer a question; one that is asked while another is answered counts as answered with what is assumed."""
        known = self._known.get(asked)
        if known is None:
            self._known[asked] = True
            self._assumed.append(asked)
            self._pending.append(asked)
        if self._at is None and known is None:
            self._settle()
        elif self._at is not None and known is not False:
            self._askers[asked][self._at] = None
        return self._known[asked]

    def _settle(self) -> None:
        """Find out what of all that is assumed holds."""
        try:
            self._refute()
        except BaseException:
            for asked in self._assumed:
                del self._known[asked]
            raise
        finally:
            self._at = None
            self._assumed.clear()
            self._pending.clear()
            self._askers.clear()

    def _refute(self) -> None:
        """Ask all that is assumed until nothing more is refuted."""
        while self._pending:
            asked = self._at = self._pending.pop()
            if self._known[asked] and not self._holds(asked):
                self._known[asked] = False
                self._pending += self._askers.pop(asked, ())
