"""Calls of macros with parameters that a file defines itself: what stands there for the compiler.

`#define PUB(var, type, name) var = node->create_publisher<type>(name, 10)` declares what each `PUB(...)` declares. Only
macros are put in that call something through an object or a namespace; what joins words (`##`) or is defined twice is
left as it is written. Lines stay as they were. Source: [cpp.replace], [cpp.subst], [cpp.stringize] of the C++ standard.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

from ecm_parsers.source.cpp_directives import directives

_HINT: Final = re.compile(rb"\#[ \t]*define[ \t]+\w+\(")
_DEFINED: Final = re.compile(rb"(?P<name>\w+)\((?P<params>[^()]*)\)(?P<body>.*)", re.DOTALL)
_NAME: Final = re.compile(rb"\w+")
_CALLS: Final = re.compile(rb"(?:->|\.|::)\s*(?:template\s+)?[A-Za-z_]\w*\s*[(<]")
_SKIPPED: Final = (
    rb"//(?:[^\\\n]|\\\r?\n|\\)*|/\*(?:[^*]|\*(?!/))*(?:\*/)?"
    rb'|\bR"(?P<mark>[^()\\\s"]{0,16})\((?:(?!\)(?P=mark)").)*\)(?P=mark)"'
    rb"""|"(?:[^"\\\n]|\\\r?\n|\\.)*"|'(?:[^'\\\n]|\\.)+'"""
)
_ARGUMENT: Final = re.compile(rb"(?P<skipped>" + _SKIPPED + rb")|(?P<sign>[(),])", re.DOTALL)
_COMMENT: Final = re.compile(rb"(?P<comment>//[^\n]*|/\*.*?\*/)|" + rb'"(?:[^"\\\n]|\\.)*"', re.DOTALL)
_PART: Final = re.compile(rb"(?P<quoted>\"(?:[^\"\\\n]|\\.)*\")|\#\s*(?P<text>\w+)|(?P<word>[A-Za-z_]\w*)")
_REST: Final = b"__VA_ARGS__"
MAX_CALLS = 2_000
"""Calls in a file beyond which all stay as they are written."""
MAX_BODY = 4_000
"""A longer body, in bytes, is left as it is."""
MAX_DEPTH = 4
"""Macros within macros that are followed."""


class _Macro(NamedTuple):
    params: tuple[bytes, ...]
    body: bytes


def with_macro_calls(data: bytes) -> bytes:
    """Return `data` with the calls of its own macros put in, each line where it was."""
    macros = _macros(data) if _HINT.search(data) is not None else {}
    if not macros:
        return data
    found = _Put(macros).into(data)
    return found if found is not None else data


def _macros(data: bytes) -> Mapping[bytes, _Macro]:
    """The macros that may be put in, by name: those that are defined once."""
    found: dict[bytes, list[_Macro | None]] = {}
    for directive in directives(data):
        name = _NAME.match(directive.rest) if directive.word == b"define" else None
        if name is not None:
            found.setdefault(name.group(), []).append(_macro(directive.rest))
    return {name: each[0] for name, each in found.items() if len(each) == 1 and each[0] is not None}


def _macro(rest: bytes) -> _Macro | None:
    match = _DEFINED.fullmatch(rest)
    if match is None or b"##" in rest or b"__VA_OPT__" in rest or len(rest) > MAX_BODY or not _CALLS.search(rest):
        return None
    params = tuple([each.strip() for each in match["params"].split(b",")]) if match["params"].strip() else ()
    if any(each.endswith(b"...") and each != b"..." for each in params):
        return None
    return _Macro(params, match["body"].strip())


class _Put:
    """Puts macros into texts; None where there are too many calls."""

    def __init__(self, macros: Mapping[bytes, _Macro]) -> None:
        self.macros = macros
        self.calls = 0
        self.active: set[bytes] = set()
        names = rb"|".join(map(re.escape, sorted(macros)))
        self.token = re.compile(rb"(?P<skipped>" + _SKIPPED + rb")|\b(?P<name>" + names + rb")\s*(?=\()", re.DOTALL)

    def into(self, data: bytes) -> bytes | None:
        """Return a text with the calls in it replaced; directives stay."""
        pieces: list[bytes] = []
        position = 0
        for each in directives(data):
            pieces += [self._code(data[position : each.start], 0), data[each.start : each.end]]
            position = each.end
            name = _NAME.match(each.rest)
            if name is not None and each.word == b"define":
                self.active.add(name.group())
            elif name is not None and each.word == b"undef":
                self.active.discard(name.group())
        pieces.append(self._code(data[position:], 0))
        return b"".join(pieces) if self.calls <= MAX_CALLS else None

    def _code(self, data: bytes, depth: int) -> bytes:
        pieces: list[bytes] = []
        position = 0
        while (match := self.token.search(data, position)) is not None:
            pieces.append(data[position : match.start()])
            position = match.end()
            name = match["name"] if match["name"] in self.active else None
            read = _arguments(data, match.end()) if name is not None and self.calls <= MAX_CALLS else None
            put = self._put(self.macros[name], read[0], depth) if name is not None and read is not None else None
            if read is None or put is None:
                pieces.append(match.group())
                continue
            lines = data.count(b"\n", match.start(), read[1])
            pieces += [put, b"\n" * max(lines - put.count(b"\n"), 0)]
            position = read[1]
        return b"".join([*pieces, data[position:]])

    def _put(self, macro: _Macro, args: Sequence[bytes], depth: int) -> bytes | None:
        """The body of a macro for some arguments; None for a wrong count of them."""
        self.calls += 1
        bound = _bound(macro.params, args)
        if bound is None or depth >= MAX_DEPTH:
            return None
        used: set[bytes] = set()
        put = _PART.sub(lambda part: _of_part(part, bound, used), macro.body)
        return self._code(put, depth + 1)


def _arguments(data: bytes, start: int) -> tuple[list[bytes], int] | None:
    """The arguments of a call and where it ends: only parentheses keep a comma from parting them."""
    depth, begin, found = 0, start + 1, list[bytes]()
    for token in _ARGUMENT.finditer(data, start):
        sign = token["sign"]
        depth += (sign == b"(") - (sign == b")")
        if sign is not None and ((sign == b"," and depth == 1) or not depth):
            found.append(data[begin : token.start()])
            begin = token.end()
        if sign is not None and not depth:
            return [_COMMENT.sub(_without, each).strip(b" \t\r") for each in found], token.end()
    return None


def _without(match: re.Match[bytes]) -> bytes:
    return b" " + b"\n" * match.group().count(b"\n") if match["comment"] is not None else match.group()


def _bound(params: Sequence[bytes], args: Sequence[bytes]) -> Mapping[bytes, bytes] | None:
    named = params[:-1] if params[-1:] == (b"...",) else params
    if len(args) < len(named) or (named is params and len(args) != max(len(params), 1)):
        return None
    return {**dict(zip(named, args, strict=False)), _REST: b", ".join(args[len(named) :])}


def _of_part(part: re.Match[bytes], bound: Mapping[bytes, bytes], used: set[bytes]) -> bytes:
    """What stands for a part of a body; an argument brings its lines once."""
    name = part["text"] or part["word"] or b""
    value = bound.get(name)
    if value is None:
        return part.group()
    if part["text"] is not None:
        return b'"' + b" ".join(value.split()).replace(b"\\", b"\\\\").replace(b'"', b'\\"') + b'"'
    value = b" ".join(value.split(b"\n")) if name in used else value
    used.add(name)
    return value
