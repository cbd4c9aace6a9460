"""One run of the command line: every way in which it can end, as an exit status and a message.

| status | meaning |
|---|---|
| 0 | done; nothing at or above the threshold |
| 1 | findings |
| 2 | the input or the command line is wrong |
| 3 | the tool itself failed |
| 130, 141, 143 | interrupted; whoever read the output left; asked to stop |
"""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
import traceback
from collections.abc import Sequence
from contextlib import suppress
from typing import Final, NamedTuple

import click

from ecm_extract.cli.app import PROGRAM, OutputClosedError, app
from ecm_extract.cli.streams import abandon_output, open_streams, write_failure
from ecm_extract.errors import EcmError

DEBUG_VARIABLE: Final = "ECM_DEBUG"
ISSUES: Final = "the issue tracker of ecm-extract"

_USAGE, _FAILED, _INTERRUPTED, _PIPE_CLOSED, _TERMINATED = 2, 3, 130, 141, 143
_SHOWN: Final = 60
"""Characters of a name that is too long."""


class TerminatedError(KeyboardInterrupt):
    """Somebody asked the process to stop (SIGTERM): it unwinds like after Ctrl-C."""


class _End(NamedTuple):
    """How a run ends: its exit status and what is said about it."""

    status: int
    message: str = ""
    hint: str = ""


def run(arguments: Sequence[str]) -> int:
    """Run a command line.

    Args:
        arguments: without the name of the program.

    Returns:
        The exit status. Errors are told on standard error, with a traceback only when ECM_DEBUG is set.
    """
    _end_on_termination()
    try:
        open_streams()
        status = app.main(list(arguments), prog_name=PROGRAM, standalone_mode=False)
        sys.stdout.flush()
    except (BrokenPipeError, OutputClosedError):
        abandon_output()
        _clean_up()
        return _PIPE_CLOSED
    except click.exceptions.NoArgsIsHelpError as help_page:
        help_page.show()
        return _USAGE
    except Exception as error:
        end = _end_of(error)
    except KeyboardInterrupt as stop:
        end = _stopped(stop)
    else:
        return status if isinstance(status, int) else 0
    _clean_up()
    return _told(end)


def _clean_up() -> None:
    """After an error; only what was imported can have forked, and help need not import it."""
    if "multiprocessing" in sys.modules:
        from ecm_extract.processes import close_generators, end_forks

        end_forks()
        close_generators()


def _end_of(error: Exception) -> _End:
    if isinstance(error, EcmError):
        return _End(error.exit_status, error.message, error.hint)
    if isinstance(error, click.exceptions.Abort):
        return _stopped(error.__cause__)
    if isinstance(error, click.ClickException):
        context = getattr(error, "ctx", None)
        return _End(_USAGE, error.format_message(), f"{context.command_path} --help" if context else "")
    full = write_failure(error) if isinstance(error, OSError) else None
    if full is not None:
        abandon_output()
        return _End(full.exit_status, full.message, full.hint)
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        return _End(_USAGE, f"no file, folder or ref has a name of that length: {str(error.filename)[:_SHOWN]}...")
    if os.environ.get(DEBUG_VARIABLE):
        traceback.print_exception(error)
    return _End(
        _FAILED,
        f"ecm-extract failed: {type(error).__name__}: {error}",
        f"this is a bug: please run again with {DEBUG_VARIABLE}=1 and report the output to {ISSUES}",
    )


def _stopped(cause: BaseException | None) -> _End:
    """By Ctrl-C or by SIGTERM; click makes an error of its own of either."""
    asked = isinstance(cause, TerminatedError)
    return _End(_TERMINATED, "asked to stop") if asked else _End(_INTERRUPTED, "interrupted")


def _told(end: _End) -> int:
    """Say how a run ended and return its status, which also those see who cannot be told."""
    for label, text in (("error", end.message), ("hint", end.hint)):
        with suppress(OSError):
            if text:
                click.echo(f"{label}: {_plain(text)}", err=True)
    return end.status


def _plain(text: str) -> str:
    """Errors quote names from other people's files: nothing in them may act on the terminal."""
    from ecm_extract.report.terminal import one_line

    return one_line(text, 1000)


def _end_on_termination() -> None:
    """Who is asked to stop unwinds, so that temporary folders go; the default action would leave them behind."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, _terminated)


def _terminated(_signal: int, _frame: object) -> None:
    raise TerminatedError
