"""Findings as the comment of a pull request."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.finding import Finding

MAX_ROWS = 100


def render(findings: Sequence[Finding]) -> str:
    """Return a table, most severe first; one sentence when there is nothing."""
    if not findings:
        return "ecm-extract found nothing to say.\n"
    return "\n".join(_lines(findings)) + "\n"


def _lines(findings: Sequence[Finding]) -> Iterator[str]:
    counts = {level: sum(1 for each in findings if each.severity == level) for level in ("error", "warning", "info")}
    yield "**ecm-extract**: " + ", ".join(f"{count} {level}" for level, count in counts.items() if count)
    yield ""
    yield "| | where | what | what to do |"
    yield "|---|---|---|---|"
    for finding in findings[:MAX_ROWS]:
        place = finding.evidence[0] if finding.evidence else None
        where = f"`{_cell(place.path)}:{place.line}`" if place else ""
        what = f"{finding.rule} {_cell(finding.message)}"
        yield f"| {finding.severity} | {where} | {what} | {_cell(finding.resolution)} |"
    if len(findings) > MAX_ROWS:
        yield f"| | | and {len(findings) - MAX_ROWS} more | |"


def _cell(text: str) -> str:
    plain = "".join(char for char in text if char.isprintable())
    return (
        plain.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;").replace("`", "'").replace("@", "@\u200b")
    )
