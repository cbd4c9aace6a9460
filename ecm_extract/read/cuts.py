"""What parsers did not read of a file because of a bound, as something unread of the tree."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_parsers.result import Diagnostic

from ecm_extract.tree import FileDiagnostic, Tree, Unread, can_declare, printable


def report_cuts(tree: Tree, path: str, diagnostics: Iterable[Diagnostic]) -> None:
    """Tell the tree of each diagnostic by which a file, or the rest of it, was not read."""
    for entry in diagnostics:
        if entry.cut:
            tree.report(located(path, entry))


def located(path: str, entry: Diagnostic) -> FileDiagnostic:
    """Return a diagnostic of a parser with its file, and with what is unread because of it."""
    shown = printable(path)
    unread = Unread(shown, "too-large", can_declare(path)) if entry.cut else None
    told = entry.severity, entry.code, shown, entry.line, entry.message, unread
    return FileDiagnostic(*told, wrong=entry.wrong, advice=entry.advice)
