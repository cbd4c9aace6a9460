"""`--output FORMAT=FILE`: the same report into files, in other formats, beside what goes to standard output."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from ecm_extract.errors import InputError

if TYPE_CHECKING:
    from ecm_checker.finding import Finding

    from ecm_extract.report.places import Places
    from ecm_extract.tree import Unread

INCOMPLETE: Final = 2
"""Status of a result without findings of an input that could not be read as a whole: no change of code mends it."""

FINDING_FORMATS: Final = ("sarif", "github", "junit", "markdown", "html")
"""Formats that show findings alike, whichever command found them."""


def findings_as(form: str, findings: Sequence[Finding], places: Places, color: bool = False) -> str:
    """Return findings in one of `FINDING_FORMATS`, or as `text`, with the paths that its readers need."""
    if form == "text":
        from ecm_extract.report.findings.text import render, styled

        return styled(findings, places) if color else render(findings, places)
    from ecm_extract.report.places import placed_for

    text: str = import_module(f"ecm_extract.report.findings.{form}").render(placed_for(form, findings, places))
    return text


def statistics_as(form: str, findings: Sequence[Finding], is_fixable: Callable[[Finding], bool]) -> str:
    """Return how many findings each rule has, as `text` or `json`."""
    from ecm_extract.report.findings.statistics import statistics, statistics_json, statistics_text

    rows = statistics(findings, is_fixable)
    return statistics_json(rows) if form == "json" else statistics_text(rows)


def refuse_statistics_as(form: str, wanted: bool) -> None:
    """Say so before any work when `--statistics` is asked for in a format that is for findings only.

    Raises:
        click.UsageError: it is.
    """
    if wanted and form not in ("text", "json"):
        message = f"--statistics is shown as text or json, not as {form}"
        raise click.UsageError(message, click.get_current_context())


def echo_report(text: str) -> None:
    """Write a report to standard output; its colors are for terminals only, and not where NO_COLOR is set."""
    click.echo(text, nl=False, color=False if "NO_COLOR" in os.environ else None)


def write_outputs(entries: Sequence[str], formats: Sequence[str], rendered: Callable[[str], str]) -> None:
    """Write each `FORMAT=FILE`.

    Raises:
        click.UsageError: an entry is not of that form.
        InputError: a file cannot be written.
    """
    for entry in entries:
        form, separator, name = entry.partition("=")
        if form not in formats or not separator or not name:
            message = f"--output {entry} is not FORMAT=FILE with one of {', '.join(formats)}"
            raise click.UsageError(message, click.get_current_context())
        try:
            Path(name).write_text(rendered(form), "utf-8")
        except OSError as error:
            message = f"{name} cannot be written: {error.strerror}"
            raise InputError(message, "name a file in a folder that is there") from None


def tell_unread(unread: Iterable[Unread]) -> int:
    """Say what could not be read of a tree, and return the status: its contracts lack what nobody can see in them."""
    from ecm_extract.report.unread_text import unread_lines
    from ecm_extract.tree.unread import is_gap

    gaps = [each for each in unread if is_gap(each)]
    for line in unread_lines(gaps):
        click.echo(f"not read: {line}", err=True)
    return INCOMPLETE if gaps else 0
