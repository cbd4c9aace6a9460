"""Same-length rewrites that let a grammar without a preprocessor read macro-laden C++.

Offsets and lines stay as they were. Applied only to text whose first parse has errors, since matching
costs half a parse. Causes counted on real trees: export macros, marks of functions, macro-only lines, `typename`
before an expression, `= {}` as default argument, a default of a nameless template parameter, notes on the values of
an enum, `#if` inside an expression, a comment in a `#define` of several lines, which ends there for the grammar.
"""

import re
from collections.abc import Callable, Iterable

_EXPORT_WORD = re.compile(rb"\b[A-Z][A-Z0-9_]*_(?:PUBLIC|EXPORT|LOCAL|API|IMPORT|HIDDEN|DEPRECATED)\b(?!\s*\()")
_CLASS_WORD = re.compile(rb"((?:class|struct) )([A-Z][A-Z0-9_]{2,})(?= \w+\s*(?:final\s*)?[:{])")
_MACRO_LINE = re.compile(
    rb"(?<=[;{}:\n])([ \t]*)([A-Z][A-Z0-9_]{2,}[A-Z0-9](?:\([^;{}]{0,400}?\))?)"
    rb"(?=[ \t]*\r?\n[ \t\r\n]*(?:[^\s,).&|+*/?:<=\[-]|/[/*]|\[\[))"
)
_MARK = re.compile(
    rb"(?<=[;{}:\n])([ \t]*)[A-Z][A-Z0-9]*_[A-Z0-9_]+(?=[ \t]+(?:(?:const|static|virtual|inline)[ \t]+)*"
    rb"(?!const\b|volatile\b|static\b|virtual\b|inline\b|constexpr\b|operator\b)"
    rb"[A-Za-z_][\w:]*(?:<[^;(){}]{0,200}>)?[ \t&*]+\w+[ \t]*\()"
)
"""A macro before the type that a function returns (`Q_INVOKABLE QString name()`): no code has three names in a row."""
_TYPENAME = re.compile(rb"(?<=[(,=<{ \t])typename(?=\s+[\w:]+(?:<[^;(){}]*>)?::)")
_NO_POINTER = re.compile(rb"(?<=::type)\s*\*\s*=\s*nullptr(?=\s*[,>])")
_LABEL_NOTE = re.compile(rb"(?<=\w)\s*\[\[[^\[\]]*\]\](?=\s*[=,}])")
_ADJACENT = re.compile(rb"(?<=[(,])(\s*[A-Z][A-Z0-9]*_[A-Z0-9_]*)[ \t]([A-Z][A-Z0-9]*_[A-Z0-9_]*)(?=\s*[,)])")
"""Two macros for texts side by side: the compiler joins them."""
_BESIDE = re.compile(
    rb"//[^\n]*|/\*.*?(?:\*/|\Z)|'(?:[^'\\\n]|\\.)+'|R\"(?P<mark>[^()\\\s\"]{0,16})\(.*?(?:\)(?P=mark)\"|\Z)"
    rb"|(?P<text>\"(?:[^\"\\\n]|\\.)*\")(?P<before>[ \t]+)(?=[A-Za-z_]\w*\()"
    rb"|\"(?:[^\"\\\n]|\\.)*\""
    rb"|\b(?!(?:if|while|for|switch)\b)(?P<call>[A-Za-z_]\w*\((?:[^()\"';{}]|\([^()\"';{}]*\))*\))"
    rb"(?P<behind>[ \t]+)(?=\")",
    re.DOTALL,
)
"""A call of a macro beside a text, which the compiler joins: `NAME(x) "/raw"`. What nobody ends goes on to the end."""
BRACES = b"$$"
"""Stands for `{}` where the grammar knows no braces; no code has such a name."""
_EMPTY_BRACES = re.compile(rb"=\s*\{\}(?=\s*[,)])")
_DEFINE_LINE = re.compile(rb"^[ \t]*#[^\\\n]*(?:\\(?:\r?\n|[^\n])[^\\\n]*)*", re.MULTILINE)
_COMMENT = re.compile(rb"/\*.*?\*/", re.DOTALL)
_REGISTRATION = re.compile(rb"^[ \t]*([A-Z][A-Z0-9_]*(?:REGISTER|EXPORT|DECLARE)[A-Z0-9_]*)\s*\(", re.MULTILINE)


def blanked(text: bytes) -> bytes:
    """Return spaces and line ends in the place of a text."""
    return b"\n".join([b" " * len(line) for line in text.split(b"\n")])


def blanked_at(data: bytes, ranges: Iterable[tuple[int, int]]) -> bytes:
    """Return a text with what stands at some places blanked, length unchanged."""
    pieces, position = [], 0
    for start, end in sorted(ranges):
        if end > position:
            begin = max(start, position)
            pieces += [data[position:begin], blanked(data[begin:end])]
            position = end
    return b"".join([*pieces, data[position:]]) if pieces else data


def _blank(match: re.Match[bytes]) -> bytes:
    return blanked(match.group())


def _added(match: re.Match[bytes]) -> bytes:
    """What stands side by side with a `+` between."""
    first, gap = (match["text"], match["before"]) if match["text"] else (match["call"], match["behind"])
    return first + gap[:-1] + b"+" if first else match.group()


def without_macros(data: bytes) -> bytes:
    """Return `data` with export words, macro-only lines and odd `typename`s blanked, length unchanged."""
    kept = _DEFINE_LINE.sub(lambda match: _COMMENT.sub(_blank, match.group()), data)
    kept = _outside_directives(kept, lambda text: _EXPORT_WORD.sub(_blank, text))
    kept = _outside_directives(kept, lambda text: _MARK.sub(_blank, _MACRO_LINE.sub(_blank, text)))
    kept = _CLASS_WORD.sub(lambda match: match[1] + b" " * len(match[2]), kept)
    kept = _BESIDE.sub(_added, _ADJACENT.sub(rb"\1+\2", kept))
    kept = _TYPENAME.sub(_blank, kept)
    kept = _LABEL_NOTE.sub(_blank, _NO_POINTER.sub(lambda match: b"=" + BRACES.rjust(len(match.group()) - 1), kept))
    return _EMPTY_BRACES.sub(lambda match: b"=" + BRACES.rjust(len(match.group()) - 1), kept)


def hides_class(data: bytes) -> bool:
    """Tell whether a macro before its name makes a class look like a function: `struct ALIGNED Point {`."""
    return _CLASS_WORD.search(data) is not None


def registrations(data: bytes) -> list[tuple[str, tuple[str, ...], int]]:
    """Return (macro, arguments as written, 1-based line) of each registration macro at the start of a line."""
    found = []
    for match in _REGISTRATION.finditer(data):
        args = _arguments(data, match.end())
        if args is not None:
            found.append((match.group(1).decode(), args, data.count(b"\n", 0, match.start(1)) + 1))
    return found


def _outside_directives(data: bytes, rewrite: Callable[[bytes], bytes]) -> bytes:
    pieces, position = [], 0
    for match in _DEFINE_LINE.finditer(data):
        pieces += [rewrite(data[position : match.start()]), match.group()]
        position = match.end()
    pieces.append(rewrite(data[position:]))
    return b"".join(pieces)


def _arguments(data: bytes, start: int, limit: int = 2000) -> tuple[str, ...] | None:
    """Split a balanced argument list that begins at `start`; None when it does not close within `limit` bytes."""
    depth, begin, args = 0, start, []
    for index in range(start, min(len(data), start + limit)):
        byte = data[index : index + 1]
        if byte in b"(<[{":
            depth += 1
        elif byte in b">]}" or (byte == b")" and depth):
            depth -= 1
        elif byte == b")":
            args.append(data[begin:index])
            return tuple(" ".join(arg.decode("utf-8", "replace").split()) for arg in args)
        elif byte == b"," and depth == 0:
            args.append(data[begin:index])
            begin = index + 1
    return None
