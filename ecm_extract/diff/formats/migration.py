"""The section that a maintainer pastes into a migration guide: entity, old, new, what to write instead."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.release import Change

from ecm_extract.diff.formats.phrases import by_package, incomplete, instead
from ecm_extract.diff.model import Comparison
from ecm_extract.report.terminal import one_line

_WORTH = frozenset({"deprecated"})


def render(comparison: Comparison) -> str:
    """Return the section as Markdown; compatible changes are left out, deprecations are not."""
    return "\n".join(_lines(comparison)) + "\n"


def _lines(comparison: Comparison) -> Iterator[str]:
    yield f"## Migration from {_code(comparison.old.ref)} to {_code(comparison.new.ref)}"
    yield ""
    gap = incomplete(comparison)
    if gap:
        yield f"{escape(gap[0].upper() + gap[1:])}."
        yield ""
    told = False
    for package, changes in by_package(comparison.changes):
        rows = [change for change in changes if change.breaking or change.change in _WORTH]
        if not rows:
            continue
        told = True
        yield f"### {one_line(package)}"
        yield ""
        yield "| what | old | new | what to write instead |"
        yield "|---|---|---|---|"
        for change in rows:
            yield _row(change)
        yield ""
    if not told and not gap:
        yield "Nothing has to be changed."


def _row(change: Change) -> str:
    what = f"{change.kind.replace('_', ' ')} {change.change.replace('_', ' ')}"
    owner = f" of {_code(change.owner)}" if change.owner else ""
    cells = (f"{what}{owner}", _code(change.old), _code(change.new), escape(instead(change)))
    return f"| {' | '.join(cells)} |"


def _code(text: str | None) -> str:
    return f"`{one_line(text).replace('`', '').replace('|', chr(92) + '|')}`" if text else ""


def escape(text: str) -> str:
    """Text that stays in its cell and makes no markup."""
    return one_line(text, 400).replace("|", "\\|").replace("<", "&lt;")
