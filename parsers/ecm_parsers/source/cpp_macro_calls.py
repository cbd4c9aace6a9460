"""Calls of macros that stand for code: what is there for the compiler.

`#define PUB(var, type, name) var = node->create_publisher<type>(name, 10)` declares what each `PUB(...)` declares, and
a list of rows `#define ROWS ROW(a, 1) ROW(b, 2)` what its row declares where it is used. Put in are macros that call
something, and those that lead to one; where several definitions may hold, the text
stays as it is written. Lines stay as they were. Source: [cpp.replace], [cpp.subst] with `__VA_OPT__`, [cpp.stringize],
[cpp.concat], [cpp.rescan] of the C++ standard.
"""

import re
from collections.abc import Mapping, Sequence, Set
from typing import Final, NamedTuple

from ecm_parsers.source.cpp_directives import directives
from ecm_parsers.source.cpp_macro_definitions import (
    HINT,
    Definitions,
    exported,
    is_calling,
    is_cut_off,
    leading,
    order,
    replacement,
)
from ecm_parsers.source.facts import Replacement

_SKIPPED: Final = (
    rb"//(?:[^\\\n]|\\\r?\n|\\)*|/\*(?:[^*]|\*(?!/))*(?:\*/)?"
    rb'|\bR"(?P<mark>[^()\\\s"]{0,16})\((?:(?!\)(?P=mark)").)*\)(?P=mark)"'
    rb"""|"(?:[^"\\\n]|\\\r?\n|\\.)*"|'(?:[^'\\\n]|\\.)+'"""
)
_TOKEN: Final = re.compile(rb"(?P<skipped>" + _SKIPPED + rb")|\b(?P<name>[A-Za-z_]\w*)", re.DOTALL)
_WORD: Final = re.compile(rb"[A-Za-z_]\w*")
_OPENED: Final = re.compile(rb"\s*(?=\()")
_ARGUMENT: Final = re.compile(rb"(?P<skipped>" + _SKIPPED + rb")|(?P<sign>[(),])", re.DOTALL)
_COMMENT: Final = re.compile(rb"(?P<comment>//[^\n]*|/\*.*?\*/)|" + rb'"(?:[^"\\\n]|\\.)*"', re.DOTALL)
_PART: Final = re.compile(
    rb"(?P<quoted>\"(?:[^\"\\\n]|\\.)*\")|(?P<joint>\s*\#\#\s*)|\#\s*(?P<text>\w+)|(?P<word>[A-Za-z_]\w*)"
)
_REST: Final = b"__VA_ARGS__"
_OPTIONAL: Final = re.compile(rb"\b__VA_OPT__\b")
MAX_CALLS = 20_000
"""Calls in a file beyond which all stay as they are written."""
MAX_PUT = 1_000_000
"""Bytes that macros may stand for in a file, beyond which all stay as they are written."""
MAX_DEPTH = 12
"""Macros within macros that are followed."""
MAX_NESTING = 40
"""Calls within the arguments of calls that are followed."""


class Expanded(NamedTuple):
    """A text with its macros put in.

    Attributes:
        exported: the macros that a file which includes it can call.
        is_cut: more stands for macros than is put in, or the text of one is too long to be looked at.
        undecided: what macros that it calls, and that may call something, may stand for: which one holds is not known.
    """

    data: bytes
    exported: tuple[Replacement, ...] = ()
    is_cut: bool = False
    undecided: tuple[Replacement, ...] = ()


class _Arguments(NamedTuple):
    given: Sequence[bytes]
    end: int


class _Found(NamedTuple):
    put: bytes
    end: int


class _Argument(NamedTuple):
    """What stands for a parameter: as it is written for `#` and `##`, with its own macros put in otherwise."""

    written: bytes
    put: bytes


def with_macro_calls(data: bytes, brought: Sequence[Replacement] = ()) -> Expanded:
    """Return a text with the macros that call something put in, each line where it was.

    Args:
        data: a C++ file.
        brought: macros of the headers that it includes.
    """
    if not brought and HINT.search(data) is None:
        return Expanded(data)
    written = [each.rest for each in directives(data) if each.word == b"define"]
    known = [*brought, *[each for each in map(replacement, written) if each is not None]]
    calling = {each.name for each in known if is_calling(each)}
    if not calling:
        told = () if brought else exported(_held_at_end(data))
        return Expanded(data, told, any(map(is_cut_off, written)))
    calling = leading(calling, known)
    around = {each.name for each in known if each.params is not None}
    definitions = Definitions(brought)
    putting = _Put(definitions, calling, around)
    put = putting.into(data)
    is_cut = putting.is_cut or any(map(is_cut_off, written))
    told = () if brought else exported(definitions)  # nobody asks it of a file that is read again
    return Expanded(put, told, is_cut, tuple(sorted(putting.undecided, key=order)))


def _held_at_end(data: bytes) -> Definitions:
    definitions = Definitions()
    for each in directives(data):
        definitions.take(each)
    return definitions


class _Put:
    """Puts macros into a text.

    Args:
        definitions: those that hold at its beginning.
        leading: names of macros that may lead to a call.
        around: names of those that may have such a one among their arguments.
    """

    def __init__(self, definitions: Definitions, leading: Set[bytes], around: Set[bytes]) -> None:
        self.definitions = definitions
        self.leading = leading
        self.names = leading | around
        self.calls = 0
        self.size = 0
        self.calling = 0
        self.is_cut = False
        self.undecided: set[Replacement] = set()
        self._nesting = 0

    def into(self, data: bytes) -> bytes:
        """Return a text with its macros put in; as it is where these are too many. Directives stay."""
        pieces: list[bytes] = []
        position = 0
        for each in directives(data):
            pieces += [self._code(data[position : each.start], ()), data[each.start : each.end]]
            position = each.end
            self.definitions.take(each)
        pieces.append(self._code(data[position:], ()))
        return data if self._is_full() else b"".join(pieces)

    def _is_beyond(self, inside: tuple[bytes, ...]) -> bool:
        beyond = self._is_full() or len(inside) >= MAX_DEPTH or self._nesting >= MAX_NESTING
        self.is_cut |= beyond
        return beyond

    def _is_full(self) -> bool:
        return self.calls > MAX_CALLS or self.size > MAX_PUT

    def _code(self, data: bytes, inside: tuple[bytes, ...]) -> bytes:
        pieces: list[bytes] = []
        position = 0
        while (match := _TOKEN.search(data, position)) is not None:
            found = self._found(data, match, inside) if match["name"] in self.names else None
            end = match.end() if found is None else found.end
            pieces += [data[position : match.start()], match.group() if found is None else found.put]
            if found is not None:
                lines = data.count(b"\n", match.start(), end) - found.put.count(b"\n")
                pieces.append(b"\n" * max(lines, 0))
            position = end
        return b"".join([*pieces, data[position:]])

    def _found(self, data: bytes, match: re.Match[bytes], inside: tuple[bytes, ...]) -> _Found | None:
        """What stands for a name; None where it stays as it is written."""
        name = match["name"]
        macro = self.definitions.of(name)
        if macro is None and name in self.leading and self.definitions.is_open(name):
            self.undecided.update(self.definitions.alternatives(name))
        if macro is None or name in inside or self._is_beyond(inside):
            return None
        given = _given(macro, data, match.end())
        if given is None or not self._leads(name, given.given):
            return None
        before = self.calling
        self._nesting += 1
        put = self._put(macro, given.given, inside)
        self._nesting -= 1
        if put is None or self.calling == before:
            return None
        self.size += len(put)
        return _Found(put, given.end)

    def _leads(self, name: bytes, given: Sequence[bytes]) -> bool:
        """Whether a call of a macro may lead to another call: by what it stands for, or by its arguments."""
        return name in self.leading or any(word in self.leading for each in given for word in _WORD.findall(each))

    def _put(self, macro: Replacement, given: Sequence[bytes], inside: tuple[bytes, ...]) -> bytes | None:
        """The body of a macro for some arguments; None for a wrong count of them."""
        self.calls += 1
        self.calling += is_calling(macro)
        written = _bound(macro.params or (), given)
        if written is None:
            return None
        bound = {name: _Argument(each, self._code(each, inside)) for name, each in written.items()}
        longest = max([len(each.put) for each in bound.values()])
        if self._is_full() or longest * len(_PART.findall(macro.body)) > MAX_PUT:
            self.is_cut = True
            return None
        body = _with_options(macro.body, bool(list(written.values())[-1]))
        return self._code(_Body(bound).of(body), (*inside, macro.name))


class _Body:
    """What a body stands for with some arguments; an argument brings its lines once."""

    def __init__(self, bound: Mapping[bytes, _Argument]) -> None:
        self.bound = bound
        self.used: set[bytes] = set()

    def of(self, body: bytes) -> bytes:
        """Return the body with its parameters replaced."""
        return _PART.sub(lambda part: self._part(part, body), body)

    def _part(self, part: re.Match[bytes], body: bytes) -> bytes:
        if part["joint"] is not None:
            return b""
        name = part["text"] or part["word"] or b""
        value = self.bound.get(name)
        if value is None:
            return part.group()
        if part["text"] is not None:
            return b'"' + b" ".join(value.written.split()).replace(b"\\", b"\\\\").replace(b'"', b'\\"') + b'"'
        is_joined = body[: part.start()].rstrip().endswith(b"##") or body[part.end() :].lstrip().startswith(b"##")
        put = value.written if is_joined else value.put
        put = b" ".join(put.split(b"\n")) if name in self.used else put
        self.used.add(name)
        return put


def _with_options(body: bytes, is_given: bool) -> bytes:
    """A body with what each `__VA_OPT__(...)` stands for: its content where there are more arguments than names."""
    pieces: list[bytes] = []
    position = 0
    for match in _OPTIONAL.finditer(body):
        found = _arguments(body, match.end()) if match.start() >= position else None
        if found is not None:
            content = body[match.end() : found.end].strip()[1:-1]
            pieces += [body[position : match.start()], content if is_given else b""]
            position = found.end
    return b"".join([*pieces, body[position:]])


def _given(macro: Replacement, data: bytes, start: int) -> _Arguments | None:
    """What stands behind a name for its macro; None where it is not called."""
    if macro.params is not None:
        return _arguments(data, start)
    is_used = not is_calling(macro) or _OPENED.match(data, start) is not None
    return _Arguments((), start) if is_used else None


def _arguments(data: bytes, start: int) -> _Arguments | None:
    """The arguments of a call and where it ends: only parentheses keep a comma from parting them."""
    opened = _OPENED.match(data, start)
    if opened is None:
        return None
    depth, begin, found = 0, opened.end() + 1, list[bytes]()
    for token in _ARGUMENT.finditer(data, opened.end()):
        sign = token["sign"]
        depth += (sign == b"(") - (sign == b")")
        if sign is not None and ((sign == b"," and depth == 1) or not depth):
            found.append(data[begin : token.start()])
            begin = token.end()
        if sign is not None and not depth:
            return _Arguments([_COMMENT.sub(_without, each).strip(b" \t\r") for each in found], token.end())
    return None


def _without(match: re.Match[bytes]) -> bytes:
    return b" " + b"\n" * match.group().count(b"\n") if match["comment"] is not None else match.group()


def _bound(params: Sequence[bytes], given: Sequence[bytes]) -> Mapping[bytes, bytes] | None:
    last = params[-1] if params else b""
    named = params[:-1] if last.endswith(b"...") else params
    if len(given) < len(named) or (named is params and params and len(given) != len(params)):
        return None
    rest = last.removesuffix(b"...").strip() or _REST if named is not params else _REST
    return {**dict(zip(named, given, strict=False)), rest: b", ".join(given[len(named) :])}
