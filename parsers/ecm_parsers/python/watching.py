"""Who is told what a file does while it is read."""

from __future__ import annotations

import ast

from ecm_parsers.python.values import Value


class Watcher:
    """Takes note of nothing; a reader that looks for mistakes takes note of what it needs."""

    def bound(self, node: ast.Assign, value: Value) -> None:
        """Hear what an assignment binds."""

    def tested(self, value: Value, line: int) -> None:
        """Hear of a value that is asked whether it holds."""

    def compared(self, kind: ast.cmpop, left: Value, right: Value, line: int) -> None:
        """Hear of a comparison."""
