"""Who is told what a file does while it is read."""

from __future__ import annotations

import ast

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.values import Value


class Watcher:
    """Takes note of nothing; a reader that looks for mistakes takes note of what it needs."""

    def bound(self, node: ast.Assign, value: Value) -> None:
        """Hear what an assignment binds."""

    def tested(self, value: Value, line: int) -> None:
        """Hear of a value that is asked whether it holds."""

    def unread(self, path: str, given: Arguments) -> None:
        """Hear of a call of a function that nothing is known of, by its dotted name."""

    def compared(self, kind: ast.cmpop, left: Value, right: Value, line: int) -> None:
        """Hear of a comparison."""
