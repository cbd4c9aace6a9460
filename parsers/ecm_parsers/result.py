"""What every parser returns: facts, and diagnostics with a line."""

from collections.abc import Sequence
from typing import Generic, Literal, TypeVar

import msgspec

Facts = TypeVar("Facts")
Severity = Literal["error", "warning", "info"]


class Diagnostic(msgspec.Struct, frozen=True):
    """Something in one artefact that could not be read, and what to do about it.

    Attributes:
        severity: `error` when facts were lost, `warning` when they are doubtful, `info` otherwise.
        code: stable kebab-case name of the problem, e.g. `msg-bad-field`.
        line: 1-based line in the artefact; 0 when it concerns the file as a whole.
        message: what is wrong and what to do, one sentence each.
        wrong, advice: the two apart, without a full stop, where a rule tells them in its own frame; else empty.
        cut: whether the artefact, or the rest of it, was not read because of a bound of ours.
    """

    severity: Severity
    code: str
    line: int
    message: str
    cut: bool = False
    wrong: str = ""
    advice: str = ""


def diagnostic(severity: Severity, code: str, line: int, wrong: str, advice: str) -> Diagnostic:
    """Return a diagnostic of two sentences, each given without its full stop."""
    return Diagnostic(severity, code, line, f"{wrong}. {advice}.", wrong=wrong, advice=advice)


class Parsed(msgspec.Struct, Generic[Facts], frozen=True):
    """The facts of one artefact beside what could not be read of it."""

    facts: Facts
    diagnostics: tuple[Diagnostic, ...] = ()


def shortened(diagnostics: Sequence[Diagnostic], limit: int) -> tuple[Diagnostic, ...]:
    """Return the first diagnostics, and behind them those that tell of something unread."""
    return (*diagnostics[:limit], *(each for each in diagnostics[limit:] if each.cut))
