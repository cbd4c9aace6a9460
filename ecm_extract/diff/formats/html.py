"""One HTML page of a comparison: the verdict, who breaks, and every change by package."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from typing import Final

from ecm_checker.release import Change, fingerprint_of
from lxml import html
from lxml.html import builder as tag

from ecm_extract.diff.formats.phrases import by_package, incomplete, left_out, place, subject
from ecm_extract.diff.model import Comparison, PackageVerdict, RefInfo
from ecm_extract.diff.verdict import needed
from ecm_extract.report.findings.html import findings_parts
from ecm_extract.report.html_page import chip, page, words

MAX_UNFOLDED: Final = 100
"""Of more changes, the packages are shown and what changed in them is folded."""


def render(comparison: Comparison) -> str:
    """Return the page."""
    title = f"{comparison.repo}: {comparison.old.ref} to {comparison.new.ref}"
    breaking = sum(change.breaking for change in comparison.changes)
    return page(
        title,
        tag.H1(words(title), " ", chip(comparison.verdict.compatibility_class)),
        tag.P(words(_verdict(comparison))),
        *(tag.P(tag.CLASS("note"), words(f"Not read: {line}")) for line in left_out(comparison)),
        tag.P(tag.CLASS("note"), words(f"{_shown(comparison.old)} to {_shown(comparison.new)}")),
        tag.H2(f"Who breaks ({len(comparison.findings)})"),
        *findings_parts(comparison.findings),
        tag.H2(f"Changes ({len(comparison.changes)}, {breaking} breaking)"),
        *_packages(comparison),
    )


def _verdict(comparison: Comparison) -> str:
    verdict = comparison.verdict
    gap = incomplete(comparison)
    told = f" {gap[0].upper() + gap[1:]}." if gap else ""
    return f"Needs {needed(verdict)}, declares {verdict.declared_bump or 'unknown'}.{told}"


def _shown(info: RefInfo) -> str:
    return f"{info.ref} ({info.commit[:12] if info.commit else 'files in no commit'})"


def _packages(comparison: Comparison) -> Iterator[html.HtmlElement]:
    verdicts = {entry.package: entry for entry in comparison.packages}
    unfolded = {"open": "open"} if len(comparison.changes) <= MAX_UNFOLDED else {}
    for package, changes in by_package(comparison.changes):
        verdict = verdicts.get(package)
        head = tag.SUMMARY(tag.B(words(package)), " ", *(_versions(verdict) if verdict is not None else ()))
        yield tag.DETAILS(head, _table(changes, comparison.accepted), **unfolded)


def _versions(entry: PackageVerdict) -> tuple[html.HtmlElement, html.HtmlElement]:
    needs, declares = needed(entry.verdict), entry.verdict.declared_bump or "unknown"
    versions = f"{entry.old_version or '?'} to {entry.new_version or '?'}, needs {needs}, declares {declares}"
    return chip(entry.verdict.compatibility_class), tag.SPAN(tag.CLASS("note"), words(versions))


def _table(changes: Sequence[Change], accepted: Container[str]) -> html.HtmlElement:
    head = tag.TR(tag.TH("change"), tag.TH("what"), tag.TH("why"))
    return tag.TABLE(head, *(_row(change, accepted) for change in changes))


def _row(change: Change, accepted: Container[str]) -> html.HtmlElement:
    where = tag.DIV(tag.CLASS("note"), tag.CODE(words(place(change))), _answer(change, accepted))
    return tag.TR(
        tag.TD(tag.CLASS("change"), words(change.change.replace("_", " ")), " ", _mark(change)),
        tag.TD(tag.CODE(words(subject(change))), where),
        tag.TD(tag.CLASS("why"), words(change.reason)),
    )


def _answer(change: Change, accepted: Container[str]) -> str:
    """What a breaking change is accepted by, or that it is."""
    fingerprint = fingerprint_of(change)
    if fingerprint in accepted:
        return " accepted"
    return f" {fingerprint}" if change.breaking else ""


def _mark(change: Change) -> html.HtmlElement | str:
    return chip("breaking") if change.breaking else ""
