"""What of a release was not read: kept beside it, so that nobody takes what is known of it for the whole."""

from __future__ import annotations

from typing import Any, Final

from ecm_checker.hub.package import Package

from ecm_extract.registry.parts import clipped

_ELSEWHERE: Final = "submodule"
"""Reason of what another repository holds: its files are sources of the package all the same."""


def gaps_of(package: Package) -> list[dict[str, Any]]:
    """Return the rows of what could use or declare names and was not read."""
    unread = [each for each in package.unread if each.is_gap or (each.carries and each.reason == _ELSEWHERE)]
    reasons = {clipped(each.path): each.reason for each in unread}
    return [{"path": path, "reason": reason} for path, reason in sorted(reasons.items())]
