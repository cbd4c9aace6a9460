"""The preprocessor directives of a C++ file, found as the first phases of its translation find them.

A `#` begins a directive where only white space and comments stand before it on its line. What is within comments,
texts, raw texts and continued lines begins none, and a directive goes on as long as its lines are continued or a
comment in it is open. Source: [lex.phases], [cpp.pre], [lex.string] of the C++ standard.
"""

import re
from collections.abc import Iterator
from typing import Final, NamedTuple

COMMENT: Final = rb"//(?:[^\\\n]|\\\r?\n|\\)*|/\*(?:[^*]|\*(?!/))*(?:\*/)?"
QUOTED: Final = rb""""(?:[^"\\\n]|\\\r?\n|\\.)*"?|'(?:[^'\\\n]|\\.)'"""
RAW: Final = rb'(?<![A-Za-z0-9_])(?:u8|[uUL])?R"(?P<mark>[^()\\\s"]{0,16})\('
_TOKEN: Final = re.compile(rb"(?P<comment>" + COMMENT + rb")|" + RAW + rb"|" + QUOTED + rb"|(?P<sign>\#)")
_WITH_BRACKETS: Final = re.compile(_TOKEN.pattern + rb"|(?P<bracket>[{}()])")
_LINE: Final = re.compile(rb"(?:[^\n\\/\"']|\\\r?\n|" + COMMENT + rb"|" + QUOTED + rb"|[\\/'])*")
_WORD: Final = re.compile(rb"\#\s*(?P<word>\w+)\s*")
INCLUDING: Final = frozenset({b"include", b"include_next", b"import"})
_CLOSED_BY: Final = {b"<": b">", b'"': b'"'}
_INSIDE: Final = re.compile(rb"(?P<kept>" + QUOTED + rb")|\\\r?\n|" + COMMENT)


class Directive(NamedTuple):
    """A directive: its word, empty for none, what stands behind that without comments, and the bytes from `#` on."""

    word: bytes
    rest: bytes
    start: int
    end: int


class Bracket(NamedTuple):
    """A brace or parenthesis of the code."""

    sign: bytes


def included(data: bytes) -> Iterator[str]:
    """Yield the paths that the directives of a file include; none of what a macro stands for."""
    for each in directives(data):
        if each.word in INCLUDING:
            opening, closing = each.rest[:1], _CLOSED_BY.get(each.rest[:1])
            path, found, _ = each.rest[len(opening) :].partition(closing) if closing else (b"", b"", b"")
            if found:
                yield path.decode("utf-8", "replace").strip()


def directives(data: bytes) -> Iterator[Directive]:
    """Yield the directives of a file in order; none behind a raw text that is never closed."""
    return (each for each in _scanned(data, _TOKEN) if isinstance(each, Directive))


def directives_and_brackets(data: bytes) -> Iterator[Directive | Bracket]:
    """Yield the brackets between the directives too."""
    return _scanned(data, _WITH_BRACKETS)


def _scanned(data: bytes, tokens: re.Pattern[bytes]) -> Iterator[Directive | Bracket]:
    position, fresh = 0, True
    while position >= 0 and (token := tokens.search(data, position)) is not None:
        if token.lastgroup not in {"comment", "sign"}:
            fresh, position = False, _end(data, token)
            if token.lastgroup == "bracket":
                yield Bracket(token.group())
            continue
        fresh = _is_fresh(data, position, token.start(), fresh)
        position = token.end()
        if token.lastgroup == "sign":
            if fresh:
                directive = _directive(data, token.start())
                position = directive.end
                yield directive
            fresh = False


def _is_fresh(data: bytes, since: int, at: int, before: bool) -> bool:
    """Tell whether only white space stands on a line up to a place; a continued line is no new one."""
    end = data.rfind(b"\n", since, at)
    if end < 0:
        return before and not data[since:at].strip()
    return not data[max(end - 2, 0) : end].removesuffix(b"\r").endswith(b"\\") and not data[end:at].strip()


def _end(data: bytes, token: re.Match[bytes]) -> int:
    """Where a token ends; -1 for a raw text that is never closed."""
    if token.lastgroup != "mark":
        return token.end()
    closing = b")" + token["mark"] + b'"'
    end = data.find(closing, token.end())
    return end if end < 0 else end + len(closing)


def _directive(data: bytes, start: int) -> Directive:
    line = _LINE.match(data, start)
    end = line.end() if line is not None else start + 1
    plain = _INSIDE.sub(_without_comment, data[start:end])
    word = _WORD.match(plain)
    return Directive(word["word"], plain[word.end() :].strip(), start, end) if word else Directive(b"", b"", start, end)


def _without_comment(match: re.Match[bytes]) -> bytes:
    """A text stays, a continued line goes on without a space, a comment is one."""
    kept: bytes | None = match["kept"]
    if kept is not None:
        return kept
    return b"" if match.group().startswith(b"\\") else b" "
