"""`cmake_parse_arguments` and `separate_arguments`."""

from __future__ import annotations

import shlex
from collections.abc import Sequence

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import is_known

MAX_ARGUMENTS = 10_000


def parse_arguments(args: list[str], look: Look) -> Sequence[Change]:
    """`cmake_parse_arguments(PREFIX options one multi args...)` or `(PARSE_ARGV n PREFIX options one multi)`."""
    if args[:1] == ["PARSE_ARGV"]:
        words, args = _from(args[1] if len(args) > 1 else "", look), args[2:]
    else:
        words = args[4:]
    if len(args) < 4:
        return []
    prefix = args[0]
    keywords = _Keywords(args[1], args[2], args[3])
    return [Change(f"{prefix}_{name}", text) for name, text in keywords.parse(words).items()]


def _from(text: str, look: Look) -> list[str]:
    """The arguments of the function from a number on."""
    count = look.get("ARGC") or ""
    if not text.isdigit() or not count.isdigit():
        return []
    return [look.get(f"ARGV{at}") or "" for at in range(int(text), min(int(count), MAX_ARGUMENTS))]


class _Keywords:
    """The keywords of a function."""

    def __init__(self, options: str, single: str, several: str) -> None:
        self._options = items(options)
        self._single = items(single)
        self._several = items(several)

    def parse(self, words: list[str]) -> dict[str, str | None]:
        """Return the variables that the arguments set; those of keywords that are not given are unset."""
        found: dict[str, str | None] = dict.fromkeys(self._options, "FALSE")
        found |= dict.fromkeys((*self._single, *self._several, "UNPARSED_ARGUMENTS", "KEYWORDS_MISSING_VALUES"))
        current, given = "", set[str]()
        for word in words:
            if word in self._options:
                found[word], current = "TRUE", ""
            elif word in self._single or word in self._several:
                current = word
                given.add(word)
            elif current in self._single:
                found[current], current = word, ""
            else:
                _add(found, current or "UNPARSED_ARGUMENTS", word)
        missing = [word for word in (*self._single, *self._several) if word in given and found[word] is None]
        found["KEYWORDS_MISSING_VALUES"] = ";".join(missing) or None
        return found


def _add(found: dict[str, str | None], name: str, word: str) -> None:
    held = found.get(name)
    found[name] = word if held is None else f"{held};{word}"


def separate_arguments(args: list[str], look: Look) -> Sequence[Change]:
    """`separate_arguments(NAME)` and `separate_arguments(NAME UNIX_COMMAND text)`."""
    if not args:
        return []
    if len(args) == 1:
        text = look.built_up(args[0])
        return [Change(args[0], text.replace(" ", ";"))] if is_known(text) else not_known(args[0])
    if len(args) == 3 and args[1] in {"UNIX_COMMAND", "NATIVE_COMMAND"} and is_known(args[2]):
        try:
            return [Change(args[0], ";".join(shlex.split(args[2])))]
        except ValueError:
            return not_known(args[0])
    return not_known(args[0])
