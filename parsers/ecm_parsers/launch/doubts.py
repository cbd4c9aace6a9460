"""Tests of a Python launch file that cannot come out as they are meant, noted while it is read.

A `LaunchConfiguration` is an object: it always holds and equals no text. The text that it gives holds whenever it is
not empty, `"false"` too.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any, Final

from ecm_parsers.launch.model import Tested
from ecm_parsers.launch.templates import plain_text
from ecm_parsers.python.values import Text, Unknown, Value
from ecm_parsers.python.watching import Watcher
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution

OBJECT_TESTED: Final = "launch-object-tested"


class Doubts(Watcher):
    """What one file does.

    Attributes:
        made: what each assignment that was read binds.
    """

    def __init__(self) -> None:
        self.made: dict[ast.stmt, Value] = {}
        self._objects: dict[int, str] = {}
        self._texts: dict[int, str] = {}

    def bound(self, node: ast.Assign, value: Value) -> None:
        """Keep what an assignment binds."""
        self.made[node] = value

    def tested(self, value: Value, line: int) -> None:
        """Note a value that is asked whether it holds."""
        name = _configuration(value)
        if name is None:
            return
        if not value.is_str:
            self._objects.setdefault(line, f"`{name}` is tested as an object, which always holds")
        elif value.is_performed:
            self._texts.setdefault(line, name)

    def compared(self, kind: ast.cmpop, left: Value, right: Value, line: int) -> None:
        """Note a comparison of an object with what it never equals, or of a text with no text."""
        if not isinstance(kind, ast.Eq | ast.NotEq) or isinstance(left, Unknown) or isinstance(right, Unknown):
            return
        for one, other in ((left, right), (right, left)):
            name = _configuration(one)
            if name is None:
                continue
            if not one.is_str and isinstance(other, str | bool | int | float):
                self._objects.setdefault(line, f"`{name}` is compared as an object, which never equals {other!r}")
            elif one.is_performed and isinstance(other, bool):
                self._objects.setdefault(line, f"the text of `{name}` is compared with {other!r}, which it never is")

    def told(self) -> Iterator[Diagnostic]:
        """Yield the problems."""
        advice = "Compare the text that `perform(context)` gives with a text"
        for line, wrong in self._objects.items():
            yield Diagnostic("warning", OBJECT_TESTED, line, f"{wrong}. {advice}.", wrong=wrong, advice=advice)

    @property
    def texts(self) -> tuple[Tested, ...]:
        """Arguments whose text is asked whether it holds."""
        return tuple(Tested(name, line) for line, name in self._texts.items())


def _configuration(value: Any) -> str | None:
    """The name of the launch argument that a value is, None for any other."""
    if not isinstance(value, Text) or len(value.parts) != 1:
        return None
    part = value.parts[0]
    return plain_text(part.args[0]) if isinstance(part, Substitution) and part.kind == "arg" and part.args else None
