"""Python files that declare something where they are run: `setup.py`, `.cfg`.

What a branch that is not decided may change is open behind it; nothing is told that may be otherwise.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.calls import Returned
from ecm_parsers.python.expressions import TooLongError
from ecm_parsers.python.interpreter import Interpreter
from ecm_parsers.python.library import CONSTANTS, LIBRARY, TABLES
from ecm_parsers.python.methods import READING, call_method
from ecm_parsers.python.models import Models
from ecm_parsers.python.places import placed
from ecm_parsers.python.spelling import source_of
from ecm_parsers.python.syntax import of_either_python
from ecm_parsers.python.values import Many, Reference, Text, Unknown, Value, shown
from ecm_parsers.python.watching import Watcher
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution, Template

MAX_BYTES: Final = 1_000_000
MAX_TEXT: Final = 4_000
_TOO_LONG: Final = "The file has too many statements; the rest is not read. Split it."
_TOO_DEEP: Final = "Expressions nest too deeply to be read; the rest is not read. Flatten them."


class Declarations(Interpreter):
    """Reads one file, of Python 2 or 3."""

    IS_STRICT = True

    def read(self, text: str) -> tuple[bool, list[Diagnostic]]:
        """Read a file; whether all of it is valid Python, and at which bound it was left."""
        syntax = of_either_python(text)
        try:
            self.run(syntax.module.body, self.module)
        except TooLongError as error:
            return syntax.is_whole, [Diagnostic("error", "python-too-long", error.line, _TOO_LONG, cut=True)]
        except RecursionError:
            return syntax.is_whole, [Diagnostic("error", "python-too-deep", self.line, _TOO_DEEP, cut=True)]
        return syntax.is_whole, []

    def kept(self, found: Value, node: ast.expr) -> Value:
        """Return a value with its line."""
        return placed(found, node)

    def chosen(self, holds: Template, first: Value, second: Value, name: str) -> Value:
        """Return what two values have in common: the elements with which both lists begin."""
        if type(first) is type(second) and first == second:
            return first
        if isinstance(first, list) and isinstance(second, list):
            less, more = sorted((first, second), key=len)
            if more[: len(less)] == less:
                return [*less, Many(Unknown(name))]
        return Unknown(name)

    def returned(self, found: Returned, line: int) -> Value:
        """Return what a function gives if all that it may give is the same."""
        if not found:
            return None
        value = found[0][1]
        for guard, other in zip((guard for guard, _ in found), (other for _, other in found[1:]), strict=False):
            value = value if guard is None else self.chosen((), value, other, "")
        return value

    def method(self, owner: Value, name: str, given: Arguments, written: ast.expr) -> Value:
        """Return what a method gives; a list or map that it changes in a way that is not followed is open."""
        if not isinstance(owner, list | dict) or name in READING:
            return call_method(owner, name, given)
        of = Unknown(source_of(written.value if isinstance(written, ast.Attribute | ast.Subscript) else written))
        found = (
            call_method(owner, name, given) if self._guard is None else self._perhaps_changed(owner, name, given, of)
        )
        if isinstance(found, Unknown):
            _open(owner, of)
        return found

    def _perhaps_changed(self, owner: Value, name: str, given: Arguments, of: Unknown) -> Value:
        """What a method leaves that is called in a branch which is not decided."""
        if isinstance(owner, list) and name in {"append", "extend"}:
            return owner.append(Many(of))
        changed = owner.copy()
        found = call_method(changed, name, given)
        if isinstance(owner, dict) and name in {"update", "__setitem__"} and not isinstance(found, Unknown):
            for key, value in changed.items():
                self._perhaps_put(owner, key, value, of)
            return None
        return Unknown(name)

    def _perhaps_put(self, owner: dict[Value, Value], key: Value, value: Value, of: Unknown) -> None:
        """Set an entry that may be set: one that was not there may not be there."""
        at = key if key in owner or isinstance(key, Many) else Many(key)
        owner[at] = self.chosen((), value, owner.get(at, value), of.text)


def _open(owner: Value, of: Unknown) -> None:
    owner.clear()
    if isinstance(owner, list):
        owner.append(Many(of))
    else:
        owner[Many(of)] = of


def declarations(
    calls: Mapping[str, Constructor], names: Mapping[str, Value] = MappingProxyType({}), watcher: Watcher | None = None
) -> Declarations:
    """Return a reader of a file that is run as a program.

    Args:
        calls: what calls make that only such a file knows.
        names: what is known before its first statement.
        watcher: who is told what it does.
    """
    models = Models({**LIBRARY, **calls}, TABLES, constants=CONSTANTS)
    return Declarations(models, {"__name__": "__main__", **names}, watcher=watcher)


def pattern_of(value: Value) -> str:
    """Return a value as text; what is not known of it is `{expression}`."""
    if isinstance(value, Many):
        is_open = isinstance(value.each, Unknown | Reference)
        return _hole(f"*{shown(value.each)}") if is_open else pattern_of(value.each)
    if isinstance(value, Text):
        return "".join(part if isinstance(part, str) else _part(part) for part in value.parts)[:MAX_TEXT]
    if isinstance(value, Unknown | Reference):
        return _hole(shown(value))
    return str(value)[:MAX_TEXT] if isinstance(value, str | int | float) else "{}"


def _part(part: Substitution) -> str:
    inner = pattern_of(Text(part.args[0])) if part.args else ""
    return inner if part.kind == "files" else _hole(inner)


def _hole(text: str) -> str:
    return f"{{{text.replace('{', '').replace('}', '')}}}"
