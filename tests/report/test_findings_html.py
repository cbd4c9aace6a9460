"""HTML reports: what stands in a file never becomes markup, and nothing is fetched."""

from __future__ import annotations

from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding, Severity
from hypothesis import given
from hypothesis import strategies as st
from lxml import html as reader

from ecm_extract.report.findings.html import render


def _finding(text: str, severity: Severity = "error") -> Finding:
    return Finding(
        rule="X001",
        name="name",
        dimension="signature",
        severity=severity,
        message=text,
        resolution=text,
        subjects=(),
        evidence=(Evidence(text or "a", 1), Evidence("b", 2)),
        fingerprint="0" * 16,
        who="config",
        certainty="proved",
    )


@given(st.text())
def test_text_stays_text(text: str) -> None:
    """Names of other people's files are no elements, no scripts and no errors."""
    page = reader.fromstring(render([_finding(text)]))
    assert [str(each.tag) for each in page.iter("script", "link", "img", "iframe")] == []
    assert len(page.xpath("//details")) == 1


def test_worst_first_with_a_choice_of_severities() -> None:
    """Errors stand above infos, and each severity that is there can be hidden."""
    page = reader.fromstring(render([_finding("late", "info"), _finding("early", "error")]))
    assert [each.get("class") for each in page.xpath("//details")] == ["finding error", "finding info"]
    assert [each.get("id") for each in page.xpath("//input")] == ["show-error", "show-info"]


def test_nothing_found_is_said() -> None:
    """An empty page would look like a failure of the tool."""
    assert "Nothing found." in render([])


def test_nothing_is_fetched() -> None:
    """The page is one file: no address of anything outside."""
    assert "http" not in render([_finding("text")])
