"""What calls of the standard library of a language do to variables, by table: see calls.toml."""

from __future__ import annotations

from collections.abc import Set
from dataclasses import dataclass
from functools import cache
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Template, Text

from ecm_extract.shipped import shipped

_ROWS: Final = (
    "changing",
    "reading",
    "reading_methods",
    "reading_paths",
    "logging_methods",
    "loggers",
    "built_in",
    "iterators",
    "calm",
    "writing",
    "searching",
    "fluent",
    "calling",
    "giving",
)


@dataclass(frozen=True, slots=True)
class Calls:
    """What calls of the standard library of a language do; see calls.toml."""

    changing: Set[str]
    reading: Set[str]
    reading_methods: Set[str]
    reading_paths: Set[str]
    logging_methods: Set[str]
    loggers: Set[str]
    built_in: Set[str]
    iterators: Set[str]
    waiting: Set[str]
    calm: Set[str]
    writing: Set[str]
    searching: Set[str]
    fluent: Set[str]
    calling: Set[str]
    giving: Set[str]

    def waits(self, call: Call) -> bool:
        """Tell whether a call may let callbacks of the program run; what joins texts or paths does not."""
        callee = call.callee
        if isinstance(callee, Member):
            return callee.name in self.waiting and not _is_text_or_path(callee.base)
        return isinstance(callee, Name) and callee.id.rsplit("::", 1)[-1] in self.waiting


@cache
def calls_of(language: str) -> Calls:
    """Return the table of a language."""
    table = shipped("infer/calls.toml")
    own = {name: frozenset(table[language].get(name, ())) for name in _ROWS}
    return Calls(**own, waiting=frozenset(table["waiting"]["names"]))


def _is_text_or_path(expr: Expr) -> bool:
    named = isinstance(expr, Member) and expr.name == "path"
    return isinstance(expr, Text | Template) or named
