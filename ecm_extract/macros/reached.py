"""Which macros of its headers a file may come to: those that it names, and those that their bodies name.

A workspace has thousands of macros and of files, and most files name few: only these are put in.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Sequence, Set
from typing import Final

from ecm_parsers.source.cpp_macro_definitions import HINT, is_calling
from ecm_parsers.source.facts import Replacement

_WORD: Final = re.compile(rb"[A-Za-z_]\w*")
_JOINS: Final = b"##"


class Reached:
    """Tells them; what the body of a macro says is looked at once for all files."""

    def __init__(self) -> None:
        self._words: dict[Replacement, Set[bytes]] = {}
        self._calling: dict[Replacement, bool] = {}

    def by(self, data: bytes, macros: Sequence[Replacement]) -> Sequence[Replacement]:
        """Return those that a file may come to, where one of them calls something or may be given what does.

        Where words are joined to others (`##`), these are all.
        """
        reached = self._reached(frozenset(_WORD.findall(data)), macros)
        if not reached or not (any(map(self._is_calling, reached)) or HINT.search(data) is not None):
            return ()
        return macros if _JOINS in data or any(_JOINS in each.body for each in reached) else reached

    def _reached(self, words: Set[bytes], macros: Sequence[Replacement]) -> Sequence[Replacement]:
        named: dict[bytes, list[Replacement]] = defaultdict(list)
        for each in macros:
            named[each.name].append(each)
        found = named.keys() & words
        pending = list(found)
        while pending:
            for each in named[pending.pop()]:
                more = (named.keys() & self._words_of(each)) - found
                found |= more
                pending += more
        return [each for each in macros if each.name in found]

    def _is_calling(self, macro: Replacement) -> bool:
        known = self._calling.get(macro)
        if known is None:
            known = self._calling[macro] = is_calling(macro)
        return known

    def _words_of(self, macro: Replacement) -> Set[bytes]:
        known = self._words.get(macro)
        if known is None:
            known = self._words[macro] = frozenset(_WORD.findall(macro.body))
        return known
