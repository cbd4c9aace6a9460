"""Conditions of `if`, `elseif` and `while` (cmake-commands(7), "if"): true, false, or not known."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Final, Protocol

import msgspec
from ecm_parsers.cmake_tokens import Argument

from ecm_extract.cmake import patterns
from ecm_extract.cmake.comparisons import COMPARISONS, NUMBER
from ecm_extract.cmake.lists import items
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.policies import is_known_to_all
from ecm_extract.cmake.state import both, either, opposite
from ecm_extract.cmake.text import values
from ecm_extract.cmake.values import is_known, unknown

_TRUE: Final = frozenset({"1", "ON", "YES", "TRUE", "Y"})
_FALSE: Final = frozenset({"0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND", ""})
_VERSION: Final = frozenset({"CMAKE_VERSION", unknown("CMAKE_VERSION")})
_FROM_THERE: Final = frozenset(f"VERSION_{how}" for how in ("LESS", "GREATER", "LESS_EQUAL", "GREATER_EQUAL"))
_ENDLESS: Final = "999999"
"""A version that is newer than all."""


class World(Protocol):
    """What conditions ask of the build beside its variables; None is not known."""

    def is_target(self, name: str) -> bool | None:
        """Tell whether a target is there."""

    def is_command(self, name: str) -> bool | None:
        """Tell whether a command is there."""

    def exists(self, path: str) -> bool | None:
        """Tell whether a file or folder is there."""

    def is_directory(self, path: str) -> bool | None:
        """Tell whether a folder is there."""

    def oldest_cmake(self) -> str | None:
        """Return the oldest version of CMake that takes the files."""


class Judged(msgspec.Struct, frozen=True):
    """Whether a condition holds, and what its last match leaves in variables; None is not known."""

    verdict: bool | None
    matched: tuple[tuple[str, str], ...] | None = ()


class _Word(msgspec.Struct, frozen=True):
    """A word of a condition, or what a part of it came to; `is_name` tells that it is written there as it is."""

    text: str
    quoted: bool = False
    is_name: bool = False
    verdict: bool | None = None
    decided: bool = False


def holds(header: Sequence[Argument], look: Look, world: World) -> bool | None:
    """Tell whether a condition holds in one reading of the variables; None where that is not known."""
    return judged(header, look, world).verdict


def judged(header: Sequence[Argument], look: Look, world: World) -> Judged:
    """Judge a condition in one reading of the variables."""
    words = [word for argument in header for word in _words(argument, look)]
    condition = _Condition(look, world)
    verdict = condition.value(words)
    return Judged(verdict, condition.matched)


def _words(argument: Argument, look: Look) -> Iterator[_Word]:
    is_name = argument.form == "plain" and "$" not in argument.text
    is_quoted = argument.form in {"quoted", "bracket"}
    yield from (_Word(text, is_quoted, is_name) for text in values(argument, look.get))


def _done(verdict: bool | None) -> _Word:
    return _Word("", True, verdict=verdict, decided=True)


class _Condition:
    """Reduces the words of a condition: parentheses, tests of one word, of two, NOT, then AND and OR from the left."""

    def __init__(self, look: Look, world: World) -> None:
        self._look = look
        self._world = world
        self.matched: tuple[tuple[str, str], ...] | None = ()

    def value(self, words: list[_Word]) -> bool | None:
        words = self._binary(self._unary(self._inner(words)))
        words = self._negated(words)
        if not words:
            return False
        verdict = self._truth(words[0])
        for at in range(1, len(words) - 1, 2):
            other = self._truth(words[at + 1])
            if words[at].text not in {"AND", "OR"}:
                return None
            verdict = both(verdict, other) if words[at].text == "AND" else either(verdict, other)
        return verdict if len(words) % 2 else None

    def _inner(self, words: list[_Word]) -> list[_Word]:
        """Replace what stands between parentheses by its value."""
        stack: list[list[_Word]] = [[]]
        for word in words:
            if word.text == "(" and not word.quoted:
                stack.append([])
            elif word.text == ")" and not word.quoted and len(stack) > 1:
                inside = stack.pop()
                stack[-1].append(_done(self.value(inside)))
            else:
                stack[-1].append(word)
        return [word for level in stack for word in level]

    def _unary(self, words: list[_Word]) -> list[_Word]:
        found: list[_Word] = []
        at = 0
        while at < len(words):
            test = _UNARY.get(words[at].text) if not words[at].quoted else None
            if test is not None and at + 1 < len(words):
                found.append(_done(test(self, words[at + 1])))
                at += 2
            else:
                found.append(words[at])
                at += 1
        return found

    def _binary(self, words: list[_Word]) -> list[_Word]:
        found: list[_Word] = []
        at = 0
        while at < len(words):
            word = words[at]
            if word.text in COMPARISONS and not word.quoted and found and at + 1 < len(words):
                found.append(_done(self._compared(found.pop(), word.text, words[at + 1])))
                at += 2
            else:
                found.append(word)
                at += 1
        return found

    def _negated(self, words: list[_Word]) -> list[_Word]:
        found: list[_Word] = []
        for word in reversed(words):
            if word.text == "NOT" and not word.quoted and found:
                found.append(_done(opposite(self._truth(found.pop()))))
            else:
                found.append(word)
        return found[::-1]

    def _truth(self, word: _Word) -> bool | None:
        """What a word alone means: a constant, or whether the variable of that name holds something."""
        if word.decided:
            return word.verdict
        if not is_known(word.text):
            return None
        constant = _constant(word.text)
        if constant is not None or word.quoted:
            return bool(constant)
        text = self._look.get(word.text)
        return False if text is None else _is_something(text)

    def _text(self, word: _Word) -> str | None:
        """The text of a side: a word that names a variable stands for it."""
        if not is_known(word.text):
            return None
        if word.quoted or word.decided:
            return word.text
        if not self._look.has(word.text):
            return self._of_unset(word)
        held = self._look.get(word.text)
        return word.text if held is None else held if is_known(held) else None

    def _of_unset(self, word: _Word) -> str | None:
        """A word that names nothing the tree sets stands for itself, unless a build is told a variable of that name."""
        is_open = self._look.outside(word.text) or (word.is_name and self._look.is_told(word.text))
        return None if is_open else word.text

    def _compared(self, left: _Word, how: str, right: _Word) -> bool | None:
        is_name = left.is_name and left.text.isidentifier() and how != "IN_LIST"
        one = self._text(msgspec.structs.replace(left, is_name=is_name))
        if how == "IN_LIST":
            held = self._look.get(right.text)
            return None if one is None or not is_known(held or "") else one in items(held or "")
        if how == "MATCHES":
            return self._matches(one, right.text)
        other = self._text(msgspec.structs.replace(right, is_name=False))
        if left.text in _VERSION and other is not None:
            return self._of_version(how, other)
        return None if one is None or other is None else COMPARISONS[how](one, other)

    def _matches(self, text: str | None, expression: str) -> bool | None:
        self.matched = None
        compiled = patterns.pattern(expression) if text is not None and is_known(expression) else None
        if compiled is None or text is None or not patterns.is_cheap(compiled, text):
            return None
        match = compiled.search(text)
        self.matched = tuple(patterns.match_variables(match).items())
        return match is not None

    def _of_version(self, how: str, other: str) -> bool | None:
        """CMake itself is at least what the file asks for: what holds from there on is decided."""
        oldest = self._world.oldest_cmake()
        if oldest is None or how not in _FROM_THERE:
            return None
        first, last = COMPARISONS[how](oldest, other), COMPARISONS[how](_ENDLESS, other)
        return first if first == last else None

    # -- tests of one word

    def exists(self, word: _Word) -> bool | None:
        return self._world.exists(word.text) if is_known(word.text) else None

    def is_directory(self, word: _Word) -> bool | None:
        return self._world.is_directory(word.text) if is_known(word.text) else None

    def is_target(self, word: _Word) -> bool | None:
        return self._world.is_target(word.text) if is_known(word.text) else None

    def is_command(self, word: _Word) -> bool | None:
        return self._world.is_command(word.text) if is_known(word.text) else None

    def is_defined(self, word: _Word) -> bool | None:
        if not is_known(word.text):
            return None
        if self._look.has(word.text):
            return self._look.get(word.text) is not None
        return None if self._look.outside(word.text) or self._look.is_told(word.text) else False

    def is_absolute(self, word: _Word) -> bool | None:
        text = self._text(word)
        return None if text is None else text.startswith(("/", "~"))

    def is_link(self, word: _Word) -> bool | None:
        """A folder that has files in the tree is none."""
        return False if is_known(word.text) and self._world.is_directory(word.text) else None

    def is_policy(self, word: _Word) -> bool | None:
        return is_known_to_all(word.text) or None

    def is_unknown(self, word: _Word) -> bool | None:
        del word
        return None


def _constant(text: str) -> bool | None:
    upper = text.upper()
    if upper in _TRUE:
        return True
    if upper in _FALSE or upper.endswith("-NOTFOUND"):
        return False
    return float(text) != 0 if NUMBER.fullmatch(text) else None


def _is_something(text: str) -> bool | None:
    """Whether a variable with this text is true: everything is but the false constants."""
    return None if not is_known(text) else _constant(text) is not False


_UNARY: Final[dict[str, Callable[[_Condition, _Word], bool | None]]] = {
    "EXISTS": _Condition.exists,
    "IS_DIRECTORY": _Condition.is_directory,
    "IS_ABSOLUTE": _Condition.is_absolute,
    "TARGET": _Condition.is_target,
    "COMMAND": _Condition.is_command,
    "DEFINED": _Condition.is_defined,
    "POLICY": _Condition.is_policy,
    "TEST": _Condition.is_unknown,
    "IS_SYMLINK": _Condition.is_link,
    "IS_READABLE": _Condition.is_unknown,
    "IS_WRITABLE": _Condition.is_unknown,
    "IS_EXECUTABLE": _Condition.is_unknown,
}
