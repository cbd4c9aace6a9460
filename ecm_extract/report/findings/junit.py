"""Findings as a JUnit file, which `colcon test-result` and most CI servers collect."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_checker.finding import Finding
from lxml import etree

from ecm_extract.report.findings.sentence import sentences


def render(findings: Sequence[Finding]) -> str:
    """Return one suite; a finding below error is a test that passed and said something."""
    errors = sum(1 for finding in findings if finding.severity == "error")
    count = str(max(len(findings), 1))
    suite = etree.Element("testsuite", name="ecm-extract", tests=count, failures=str(errors), errors="0", skipped="0")
    for finding in findings:
        _case(suite, finding)
    if not findings:
        etree.SubElement(suite, "testcase", classname="ecm-extract", name="lint")
    text: str = etree.tostring(suite, encoding="unicode", pretty_print=True)
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text}'


def _case(suite: etree._Element, finding: Finding) -> None:
    place = finding.evidence[0] if finding.evidence else None
    column = f":{place.column}" if place and place.column else ""
    where = f"{place.path}:{place.line}{column}" if place else ""
    case = etree.SubElement(
        suite, "testcase", classname=f"ecm-extract.{finding.rule}", name=_plain(f"{finding.name} {where}")
    )
    text = _plain(f"{where}: {sentences(finding)}")
    if finding.severity == "error":
        etree.SubElement(case, "failure", message=text).text = text
    else:
        etree.SubElement(case, "system-out").text = f"{finding.severity}: {text}"


def _plain(text: str) -> str:
    """XML 1.0 holds no control characters."""
    return "".join(char for char in text if char.isprintable() or char in "\n\t")
