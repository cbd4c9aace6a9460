"""The standard streams of a run: what is said when one of them is closed, full or unable to show a letter."""

from __future__ import annotations

import errno
import io
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from ecm_extract.errors import InputError, ToolError

_CANNOT_WRITE: Final = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EROFS})
"""Errors of a device, whoever writes to it."""


def open_streams() -> None:
    """Make the three streams usable: closed ones are opened on the null device, so that no file takes their number.

    Raises:
        InputError: standard output is closed, so that nobody could read the result.
    """
    closed = sys.stdout is None
    for number in range(3):
        _open_if_closed(number)
    sys.stdin = sys.stdin or open(0)  # noqa: SIM115 - the stream of the process
    sys.stdout = sys.stdout or open(1, "w")  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    if closed:
        message = "standard output is closed"
        raise InputError(message, "give it a file, or /dev/null if only the exit status matters")


def _open_if_closed(number: int) -> None:
    try:
        os.fstat(number)
    except OSError:
        opened = os.open(os.devnull, os.O_RDWR)
        if opened != number:
            os.dup2(opened, number)
            os.close(opened)


def write_failure(error: OSError) -> ToolError | None:
    """What a full or broken device means to a person; None for an error of another kind."""
    if error.errno not in _CANNOT_WRITE:
        return None
    where = f" {error.filename}" if error.filename else ""
    return ToolError(f"cannot write{where}: {error.strerror}", "make room, or write to another place")


def abandon_output() -> None:
    """Send what is still buffered to the null device: who reads standard output has left, or its disk is full."""
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)


def flush_streams() -> None:
    """Write out what is buffered; what cannot be written has been told already, or nobody is there to be told."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
