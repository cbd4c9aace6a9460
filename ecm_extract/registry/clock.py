"""Times as the registry writes them, and a clock that never goes back."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import Final

from ecm_extract.errors import InputError

_FORM: Final = "%Y-%m-%dT%H:%M:%S.%fZ"
_TOLERANCE: Final = timedelta(minutes=5)
"""How far the clocks of machines that share a registry may be apart."""


def now() -> datetime:
    """Return the time."""
    return datetime.now(UTC)


def written(time: datetime) -> str:
    """Return a time as it is stored; it sorts as text."""
    return time.astimezone(UTC).strftime(_FORM)


def read(text: str) -> datetime:
    """Return a time that was stored."""
    return datetime.strptime(text, _FORM).replace(tzinfo=UTC)


def is_to_come(time: datetime) -> bool:
    """Whether a time is later than now by more than clocks differ."""
    return time - now() > _TOLERANCE


def after(newest: str, present: datetime) -> str:
    """Return the time of the next entry of a log.

    Args:
        newest: time of the entry before; empty when there is none.
        present: what the clock says.

    Raises:
        InputError: the clock is behind the log by more than clocks differ.
    """
    if not newest or written(present) >= newest:
        return written(present)
    if read(newest) - present > _TOLERANCE:
        message = f"the clock of this machine says {written(present)}, and the newest entry is of {newest}"
        raise InputError(message, "set the clock; nothing was changed")
    return newest
