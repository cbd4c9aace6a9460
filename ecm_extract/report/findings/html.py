"""Findings as one HTML page that needs nothing besides itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.finding import SEVERITIES, Finding
from lxml import html
from lxml.html import builder as tag

from ecm_extract.report.html_page import chip, page, words

_MOST_LINES = 40


def render(findings: Sequence[Finding], title: str = "ecm-extract lint") -> str:
    """Return the page, most severe findings first."""
    return page(title, tag.H1(words(title)), *findings_parts(findings))


def findings_parts(findings: Sequence[Finding]) -> list[html.HtmlElement]:
    """Return the parts of a page that show findings: what to show of them, and one after the other."""
    if not findings:
        return [tag.P("Nothing found.")]
    ordered = sorted(findings, key=lambda finding: SEVERITIES.index(finding.severity))
    return [_choices(findings), *(_finding(finding) for finding in ordered)]


def _choices(findings: Sequence[Finding]) -> html.HtmlElement:
    """A box for each severity, which shows or hides its findings without a script."""
    boxes: list[html.HtmlElement] = []
    for level in SEVERITIES:
        count = sum(finding.severity == level for finding in findings)
        if count:
            box = tag.INPUT(type="checkbox", checked="checked", id=f"show-{level}")
            boxes.append(tag.LABEL(box, f" {count} ", chip(level)))
    return tag.P(tag.CLASS("choices"), *boxes)


def _finding(finding: Finding) -> html.HtmlElement:
    doubt = "" if finding.certainty == "proved" else f", {finding.certainty}"
    place = finding.evidence[0] if finding.evidence else None
    head = tag.SUMMARY(
        chip(finding.severity),
        tag.CODE(words(f"{place.path}:{place.line}")) if place else "",
        tag.SPAN(tag.CLASS("rule"), words(f"{finding.rule} {finding.name}{doubt}")),
        tag.P(words(finding.message)),
    )
    return tag.DETAILS(tag.CLASS(f"finding {finding.severity}"), head, *_more(finding))


def _more(finding: Finding) -> Iterator[html.HtmlElement]:
    yield tag.P(tag.B("fix "), words(finding.resolution))
    others = finding.evidence[1:]
    if others:
        lines = [tag.LI(tag.CODE(words(f"{other.path}:{other.line}"))) for other in others[:_MOST_LINES]]
        if len(others) > _MOST_LINES:
            lines.append(tag.LI(f"and {len(others) - _MOST_LINES} more lines"))
        yield tag.P(tag.B("see"))
        yield tag.UL(*lines)
    yield tag.P(
        tag.CLASS("note"), f"dimension {finding.dimension}, breaks {finding.who}; accept with ", _accept(finding)
    )


def _accept(finding: Finding) -> html.HtmlElement:
    return tag.CODE(f"ecm-extract accept {finding.fingerprint} --reason ...")
