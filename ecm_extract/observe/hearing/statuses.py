"""The worst level that each diagnostic task reported."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from ecm_extract.observe.model import Level, Status

_LEVELS: Final[tuple[Level, ...]] = ("ok", "warn", "error", "stale")
_MOST_TASKS: Final = 10_000


class Statuses:
    """Collects diagnostics; the number of tasks is bounded, and `full` tells when some were left out."""

    def __init__(self) -> None:
        self._worst: dict[str, tuple[int, str, str]] = {}
        self.full = False

    def add(self, message: Any) -> None:
        """Take a message with `status`."""
        for each in message.status:
            level = min(_number(each.level), len(_LEVELS) - 1)
            before = self._worst.get(each.name)
            if before is None and len(self._worst) >= _MOST_TASKS:
                self.full = True
            elif before is None or level > before[0]:
                self._worst[each.name] = (level, each.message, each.hardware_id)

    def found(self) -> Iterator[Status]:
        """Yield each task."""
        for name, (level, message, hardware) in sorted(self._worst.items()):
            yield Status(name, _LEVELS[level], message, hardware)


def _number(level: int | bytes) -> int:
    return level[0] if isinstance(level, bytes) else int(level)
