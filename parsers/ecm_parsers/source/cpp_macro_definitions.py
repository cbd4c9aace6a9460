"""Macros of C++ that stand for code, and which of them a place in a file can mean.

Source: [cpp.replace], [cpp.scope] of the C++ standard: a definition holds until it is undefined.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Final, NamedTuple

from ecm_parsers.source.cpp_directives import Directive
from ecm_parsers.source.cpp_logging import is_printing
from ecm_parsers.source.facts import Replacement

_TEXT: Final = re.compile(rb'"(?:[^"\\]|\\.)*"')
_BESIDE: Final = re.compile(rb'\w[ \t]*""|""[ \t]*(?:#[ \t]*)?\w')
"""A name beside a text, or one that begins where a text ends: `"camera/" name`."""
HINT: Final = re.compile(
    rb"\#[ \t]*define[ \t]+\w+(?:\(|[ \t]+(?:\\\r?\n[ \t]*|/\*(?:[^*]|\*(?!/))*\*/[ \t]*)*[A-Za-z_]\w*[ \t]*\("
    rb"|[ \t][^\n\"']*(?:->|[A-Za-z_]\.[A-Za-z_]|\w[ \t]*<))"
)
"""What a file has that defines a macro with parameters, a list of their calls, or what is called."""
_DEFINED: Final = re.compile(rb"(?P<name>\w+)(?:\((?P<params>[^()]*)\))?(?P<body>.*)", re.DOTALL)
_NAME: Final = re.compile(rb"\w+")
_WORD: Final = re.compile(rb"[A-Za-z_]\w*")
_METHOD: Final = re.compile(rb"(?:->|\.|::)\s*+(?:template\s++)?+[A-Za-z_]\w*+(?:\s*+\#\#\s*+\w++)*+\s*+[(<]")
_FUNCTION: Final = re.compile(
    rb"\b(?P<name>[A-Za-z_]\w*+)(?:\s*+\#\#\s*+\w++)*+\s*+(?:<[^;{}()]{0,200}>\s*+)?+\(",
)
_WORDS: Final = frozenset(
    b"""alignas alignof asm assert case catch const_cast decltype defined delete do dynamic_cast else explicit for if
    new noexcept operator reinterpret_cast requires return sizeof static_assert static_cast switch throw typeid
    while
    auto bool char char8_t char16_t char32_t double float int long short signed unsigned void wchar_t
    __attribute__ __declspec _Pragma""".split()
)
"""What stands before parentheses and calls no function. Source: [lex.key] of the C++ standard, GCC's attributes."""
_ROWS: Final = re.compile(rb"[A-Za-z_]\w*\s*\(.*\)\s*;?", re.DOTALL)
"""What may be calls of macros one behind the other."""
_ALONE: Final = re.compile(rb"(?:\A|[{};])\s*(\w+)\s+(?=[\w}])")
"""A word where a statement stands, with the next one behind it."""
_CALLED: Final = re.compile(
    rb"[^;{}()\"]*(?:->|\.)\s*(?:template\s+)?[A-Za-z_]\w*(?:\s*<[^;{}()]*>)?|[A-Za-z_]\w*\s*<[^;{}()]*>"
)
MAX_BODY = 40_000
"""A longer definition, in bytes, is left as it is."""
MAX_PATH = 40
"""Conditionals around a definition that are told apart."""
MAX_HELD = 8
"""Definitions of a name that are kept: with more of them it is not known which one holds."""
_Path = tuple[tuple[int, int], ...]
"""The conditionals around a directive, each with which of its branches."""


class _Held(NamedTuple):
    definition: Replacement | None
    path: _Path


def replacement(rest: bytes) -> Replacement | None:
    """Return what a `#define` says of its name; None for a text that is too long to follow.

    Args:
        rest: what stands behind `#define`, without comments.
    """
    match = _DEFINED.fullmatch(rest) if len(rest) <= MAX_BODY else None
    if match is None:
        return None
    written = match["params"]
    params = tuple([each.strip() for each in written.split(b",")]) if written and written.strip() else ()
    return Replacement(match["name"], None if written is None else params, match["body"].strip())


def is_cut_off(rest: bytes) -> bool:
    """Tell whether what stands behind `#define` may call something, but is too long to be followed."""
    return len(rest) > MAX_BODY and calls_any(rest.partition(b")")[2])


def is_calling(definition: Replacement) -> bool:
    """Tell whether a macro calls something, is itself called (`node->open<T>`), or puts texts side by side.

    One that is called as those which print is taken for what it stands for, whatever that is.
    """
    if definition.params is None:
        return _CALLED.fullmatch(definition.body) is not None
    if is_printing(definition.name.decode("utf-8", "replace")):
        return True
    return calls_any(definition.body) or _BESIDE.search(_TEXT.sub(b'""', definition.body)) is not None


def calls_any(body: bytes) -> bool:
    """Tell whether a text calls a function, or a method of something."""
    called = (match["name"] for match in _FUNCTION.finditer(body))
    return _METHOD.search(body) is not None or any(name not in _WORDS for name in called)


class Definitions:
    """The macros that hold at a place: directives are taken in their order.

    Args:
        brought: those of headers, which hold from the beginning; of a name there may be several.
    """

    def __init__(self, brought: Iterable[Replacement] = ()) -> None:
        self._held: dict[bytes, list[_Held]] = {}
        for each in brought:
            self._held.setdefault(each.name, []).append(_Held(each, ()))
        self._path: list[tuple[int, int]] = []
        self._groups = 0

    def take(self, directive: Directive) -> None:
        """Go past a directive."""
        word = directive.word
        if word.startswith(b"if"):
            self._groups += 1
            self._path.append((self._groups, 0))
        elif word.startswith(b"el") and self._path:
            group, branch = self._path[-1]
            self._path[-1] = (group, branch + 1)
        elif word == b"endif" and self._path:
            self._path.pop()
        elif word in {b"define", b"undef"}:
            self._change(word, directive.rest)

    def _change(self, word: bytes, rest: bytes) -> None:
        name = _NAME.match(rest)
        if name is None:
            return
        path = tuple(self._path[:MAX_PATH])
        before = self._held.get(name.group(), [])[:MAX_HELD]
        if word == b"undef":
            self._held[name.group()] = [each for each in before if each.path[: len(path)] != path]
        else:
            self._held[name.group()] = [*before, _Held(replacement(rest), path)]

    def of(self, name: bytes) -> Replacement | None:
        """Return what a name surely stands for; None for no macro, and for one that has several definitions."""
        held = self._held.get(name, ())
        first = held[0].definition if held else None
        return first if all(each.definition == first for each in held) else None

    def is_open(self, name: bytes) -> bool:
        """Tell whether a name stands for something here of which it is not known what that is."""
        return bool(self._held.get(name)) and self.of(name) is None

    def alternatives(self, name: bytes) -> Iterator[Replacement]:
        """Yield what a name may stand for here."""
        return (each.definition for each in self._held.get(name, ()) if each.definition is not None)

    def all(self) -> Iterator[Replacement]:
        """Yield what may hold here."""
        return (each for name in self._held for each in self.alternatives(name))


def exported(definitions: Definitions) -> tuple[Replacement, ...]:
    """Return the macros by which files that include this one may call something, by name; all that may hold.

    With them are lists of rows, whose row each file defines for itself, and what puts a list where statements stand.
    """
    held = sorted(set(definitions.all()), key=order)
    names = leading({each.name for each in held if is_calling(each)}, held)
    rows = leading({each.name for each in held if _is_rows(each)}, held)
    return tuple([each for each in held if each.name in names | rows or (names and _takes_rows(each))])


def order(definition: Replacement) -> tuple[bytes, tuple[bytes, ...], bytes]:
    """Return what definitions are sorted by."""
    return definition.name, definition.params or (), definition.body


def _is_rows(definition: Replacement) -> bool:
    return definition.params is None and _ROWS.fullmatch(definition.body) is not None


def _takes_rows(definition: Replacement) -> bool:
    return any(each[1] in (definition.params or ()) for each in _ALONE.finditer(definition.body))


def leading(wanted: Iterable[bytes], definitions: Sequence[Replacement]) -> set[bytes]:
    """Return the wanted names, and those whose bodies name one of them, in any number of steps."""
    naming: dict[bytes, list[bytes]] = defaultdict(list)
    for each in definitions:
        for word in set(_WORD.findall(each.body)):
            naming[word].append(each.name)
    found = set(wanted)
    pending = list(found)
    while pending:
        more = [name for name in naming.get(pending.pop(), ()) if name not in found]
        found.update(more)
        pending += more
    return found
