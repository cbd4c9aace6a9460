"""Findings as text: a paragraph for what breaks somebody, a line for what may be known already."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final

import click
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding, Severity

from ecm_extract.report.places import Places
from ecm_extract.report.terminal import one_line

_WIDEST = 2000
_WIDEST_SOURCE = 160
_MOST_LINES = 6
_COLORS: Final[Mapping[Severity, str]] = MappingProxyType({"error": "red", "warning": "yellow", "info": "cyan"})
_AS_READ: Final = Places()


def render(findings: Sequence[Finding], places: Places = _AS_READ, answerable: bool = True) -> str:
    """Return the text; empty when there are no findings.

    Args:
        findings: to show.
        places: how paths are written.
        answerable: whether a person can accept them; of what was seen of a running robot nobody can.
    """
    return click.unstyle(styled(findings, places, answerable))


def styled(findings: Sequence[Finding], places: Places = _AS_READ, answerable: bool = True) -> str:
    """Return the text with colors for a terminal, and paths as they are opened from here; see `render`."""
    return "".join(f"{line}\n" for finding in findings for line in _lines(finding, places, answerable))


def _lines(finding: Finding, places: Places, answerable: bool) -> Iterator[str]:
    if finding.severity == "info" and answerable:
        yield f"{_head(finding, places)} [{finding.fingerprint}]"
        return
    yield _head(finding, places)
    if finding.evidence:
        yield from _source(finding.evidence[0], places)
    yield one_line(f"    fix: {finding.resolution}", _WIDEST)
    for other in finding.evidence[1:_MOST_LINES]:
        yield one_line(f"    see {_position(other, places)}", _WIDEST)
    if len(finding.evidence) > _MOST_LINES:
        yield f"    and {len(finding.evidence) - _MOST_LINES} more lines"
    if answerable:
        yield f"    accept: ecm-extract accept {finding.fingerprint} --reason ..."


def _head(finding: Finding, places: Places) -> str:
    place = finding.evidence[0] if finding.evidence else None
    where = click.style(f"{_position(place, places)}:", bold=True) + " " if place else ""
    doubt = "" if finding.certainty == "proved" else f" ({finding.certainty})"
    severity = click.style(finding.severity, fg=_COLORS[finding.severity], bold=True)
    told = one_line(f"{doubt} {finding.rule} {finding.name}: {finding.message}", _WIDEST)
    return f"{where}{severity}{told}"


def _position(place: Evidence, places: Places) -> str:
    """`file:line`, with the column where it is known: what editors and terminals open."""
    column = f":{place.column}" if place.column else ""
    return one_line(f"{places.from_here(place).path}:{place.line}{column}", _WIDEST)


def _source(place: Evidence, places: Places) -> Iterator[str]:
    """The line that causes it, with a mark below the column where that is known."""
    text = places.line(place)
    if text is None or not text.strip():
        return
    number = str(place.line)
    yield click.style(f"    {number} | ", dim=True) + one_line(text.expandtabs(), _WIDEST_SOURCE)
    if place.column and place.column <= _WIDEST_SOURCE:
        before = len(text[: place.column - 1].expandtabs())
        yield click.style(f"    {' ' * len(number)} | ", dim=True) + " " * before + click.style("^", bold=True)
