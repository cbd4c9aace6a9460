"""What a finding says, and what to do about it, as one text of sentences."""

from __future__ import annotations

from ecm_checker.finding import Finding


def sentences(finding: Finding) -> str:
    """Message and resolution, each with one full stop."""
    return " ".join(_ended(text) for text in (finding.message, finding.resolution) if text)


def _ended(text: str) -> str:
    return text if text.endswith((".", "!", "?", "…")) else f"{text}."
