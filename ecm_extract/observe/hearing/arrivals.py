"""When messages of one stream arrived, in a bounded amount of memory."""

from __future__ import annotations

from collections import Counter
from typing import Final

_DIGITS: Final = 6
_NS: Final = 1e-9


class Arrivals:
    """Counts messages and remembers the spread of the gaps between them, each by its first binary digits."""

    __slots__ = ("_gaps", "_longest", "count", "first_ns", "last_ns", "size")

    def __init__(self) -> None:
        self.count = 0
        self.size = 0
        self.first_ns = 0
        self.last_ns = 0
        self._longest = 0
        self._gaps: Counter[int] = Counter()

    def add(self, time_ns: int, size: int) -> None:
        """Count a message of so many bytes; times may come out of order."""
        self.count += 1
        self.size += size
        if self.count == 1:
            self.first_ns = self.last_ns = time_ns
            return
        gap = time_ns - self.last_ns
        if gap > 0:
            shift = gap.bit_length() - _DIGITS
            self._gaps[gap >> shift << shift if shift > 0 else gap] += 1
            if gap > self._longest:
                self._longest = gap
            self.last_ns = time_ns

    @property
    def hz(self) -> float | None:
        """Mean rate in hertz."""
        span = self.last_ns - self.first_ns
        return (self.count - 1) / (span * _NS) if span > 0 else None

    @property
    def longest_gap_s(self) -> float | None:
        """Longest gap in seconds."""
        return self._longest * _NS if self._gaps else None

    @property
    def typical_gap_s(self) -> float | None:
        """Median gap in seconds, within two percent."""
        half, passed = self._gaps.total() / 2, 0
        for bucket in sorted(self._gaps):
            passed += self._gaps[bucket]
            if passed >= half:
                return (bucket + _half_width(bucket)) * _NS
        return None


def _half_width(bucket: int) -> int:
    return (1 << max(bucket.bit_length() - _DIGITS, 0)) >> 1
