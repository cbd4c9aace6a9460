"""A report of the checker as one HTML page."""

from __future__ import annotations

from ecm_checker.outcome import Report
from lxml.html import builder as tag

from ecm_extract.report.findings.html import findings_parts
from ecm_extract.report.html_page import chip, page, words
from ecm_extract.report.unread_text import unread_lines
from ecm_extract.tree.unread import unread_in


def report_html(report: Report) -> str:
    """Return the page: the outcome with its conditions, then the findings."""
    title = f"ecm-extract check: {report.operation}"
    conditions = [tag.LI(words(text)) for text in report.conditions]
    asked = f"Dimensions: {', '.join(report.dimensions)}. Checker {report.checker[:12]}."
    return page(
        title,
        tag.H1(words(title), " ", chip(report.outcome)),
        *([tag.H2("Conditions"), tag.UL(*conditions)] if conditions else ()),
        tag.P(tag.CLASS("note"), words(" ".join([asked, *(f"Not asked: {text}." for text in report.not_asked)]))),
        *(tag.P(words(f"Not read: {text}.")) for text in unread_lines(unread_in(report.unread))),
        *findings_parts(report.findings),
    )
