"""Files that call macros of which nobody knows which definition holds: what these declare is not told."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import Final

from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.facts import PackageFacts
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable

_CALLED: Final = re.compile(rb"\b([A-Za-z_]\w*+)\s*+(?:<[^;]{0,200}>\s*+)?\(\s*+[^\s)]")
"""A call that is given something, as what declares an interface is given its name; nothing is tried twice."""
MAX_NAMES: Final = 5
"""Macros that are named."""


def report_undecided(packages: Sequence[PackageFacts], tree: Tree, callees: Collection[str]) -> None:
    """Tell the tree of each file that calls such a macro, where one of its definitions may declare something.

    Args:
        packages: what was read.
        tree: which is told.
        callees: last names of what declares interfaces, by the rows of forms or by the functions of the tree.
    """
    for package in packages:
        for path, facts in package.sources.items():
            names = declaring_macros(facts, callees)
            if names:
                shown = printable(path)
                message = (
                    f"Which definition of these macros holds is not known: {', '.join(names[:MAX_NAMES])}. What they "
                    "declare is not told. Declare it without a macro, or define that in one way."
                )
                tree.report(FileDiagnostic("warning", "cpp-macros", shown, 0, message, Unread(shown, "undecided")))


def declaring_macros(facts: SourceFile, callees: Collection[str]) -> list[str]:
    """Return the names of the undecided macros of a file that may declare something."""
    found = (
        macro for macro in facts.undecided if any(each.decode() in callees for each in _CALLED.findall(macro.body))
    )
    return sorted({macro.name.decode(errors="replace") for macro in found})
