"""Python literals as values: prefixes, quotes, escapes and number forms of Python 2 and 3."""

from __future__ import annotations

import re
import unicodedata

from ecm_parsers.numbers import INT_MIN, integer, real
from ecm_parsers.source.expr import Constant, Expr, Number, Op, Template, Text

_ESCAPE = re.compile(
    r"\\(\r?\n|[0-7]{1,3}|x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|N\{[^{}]{1,100}\}|.)", re.DOTALL
)
_SURROGATE = re.compile("[\ud800-\udfff]")
_OPENING = re.compile(rb"([A-Za-z]{0,3})(\"\"\"|'''|\"|')")
_SIMPLE = {
    "\n": "",
    "\r\n": "",
    "\\": "\\",
    "'": "'",
    '"': '"',
    "a": "\a",
    "b": "\b",
    "f": "\f",
    "n": "\n",
    "r": "\r",
    "t": "\t",
    "v": "\v",
}


def decode(raw: bytes) -> str:
    """Decode source bytes as UTF-8 with line feeds as line ends; bytes that are not UTF-8 become U+FFFD."""
    text = raw.decode("utf-8", "replace")
    return text.replace("\r\n", "\n") if "\r" in text else text


def split_string(raw: bytes) -> tuple[str, int, int] | None:
    """Find what encloses a string literal.

    Args:
        raw: the literal with prefix and quotes.

    Returns:
        Its prefix in lower case, and the offsets of the first and one past the last byte of its content; None
        when it does not open with a quote (Python 2 backticks).
    """
    opening = _OPENING.match(raw)
    if opening is None:
        return None
    quote = opening.group(2)
    start = opening.end()
    closed = raw.endswith(quote) and len(raw) >= start + len(quote)
    return opening.group(1).decode().lower(), start, len(raw) - len(quote) if closed else len(raw)


def string_value(raw: bytes) -> str | None:
    """Value of a string or bytes literal that is no f-string; None for Python 2 backticks."""
    bounds = split_string(raw)
    if bounds is None:
        return None
    prefix, start, end = bounds
    return content_value(raw[start:end], raw="r" in prefix)


def content_value(content: bytes, *, raw: bool) -> str:
    """Value of what stands between the quotes, escapes replaced unless the literal is raw."""
    text = decode(content)
    return text if raw or "\\" not in text else _SURROGATE.sub("\ufffd", _ESCAPE.sub(_unescape, text))


def _unescape(match: re.Match[str]) -> str:
    code = match.group(1)
    if code in _SIMPLE:
        return _SIMPLE[code]
    if code[0] in "01234567":
        return chr(int(code, 8))
    if code[0] == "N" and len(code) > 1:
        return _named(code, match.group())
    if code[0] in "xuU" and len(code) > 1:
        number = int(code[1:], 16)
        return chr(number) if number < 0x110000 else "\ufffd"
    return match.group()


def _named(code: str, written: str) -> str:
    try:
        return unicodedata.lookup(code[2:-1])
    except KeyError:
        return written


def number_value(raw: bytes) -> int | float | None:
    """Value of a number literal, Python 2 `0777` and `10L` included; None for complex, infinite or beyond 64 bit."""
    text = raw.decode("ascii", "replace").replace("_", "").rstrip("lL").lower()
    octal = len(text) > 1 and text[0] == "0" and text.isdigit()
    value = integer(text, 8 if octal else 0)
    return value if value is not None or text.isdigit() else real(text)


def negated(operand: Expr) -> Expr:
    """`-operand`, folded when the operand is a number."""
    if isinstance(operand, Number) and -operand.value >= INT_MIN:
        return Number(-operand.value)
    return Op("-", (operand,))


def joined(parts: list[Expr]) -> Expr:
    """Implicit concatenation: a Text when all parts are, else a Template with neighbouring Texts merged."""
    merged: list[Expr] = []
    texts: list[str] = []
    for part in _flat(parts):
        if isinstance(part, Text):
            texts.append(part.value)
            continue
        _close(texts, merged)
        merged.append(part)
    if not merged:
        return Text("".join(texts))
    _close(texts, merged)
    return Template(tuple(merged))


def _flat(parts: list[Expr]) -> list[Expr]:
    flat: list[Expr] = []
    for part in parts:
        flat.extend(part.parts if isinstance(part, Template) else (part,))
    return flat


def _close(texts: list[str], merged: list[Expr]) -> None:
    text = "".join(texts)
    if text:
        merged.append(Text(text))
    texts.clear()


TRUE, FALSE, NULL = Constant("true"), Constant("false"), Constant("null")
