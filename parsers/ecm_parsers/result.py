"""What every parser returns: facts, and diagnostics with a line."""

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
    """

    severity: Severity
    code: str
    line: int
    message: str
    wrong: str = ""
    advice: str = ""


def diagnostic(severity: Severity, code: str, line: int, wrong: str, advice: str) -> Diagnostic:
    """Return a diagnostic of two sentences, each given without its full stop."""
    return Diagnostic(severity, code, line, f"{wrong}. {advice}.", wrong, advice)


class Parsed(msgspec.Struct, Generic[Facts], frozen=True):
    """The facts of one artefact beside what could not be read of it."""

    facts: Facts
    diagnostics: tuple[Diagnostic, ...] = ()
