"""Literals of C++: texts, numbers, constants."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

from ecm_parsers.numbers import integer, real
from ecm_parsers.source.expr import Call, Constant, Expr, Name, Number, Op, Opaque, Text

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_ESCAPES = {
    "n": "\n",
    "t": "\t",
    "r": "\r",
    "a": "\a",
    "b": "\b",
    "f": "\f",
    "v": "\v",
    "\\": "\\",
    '"': '"',
    "'": "'",
    "?": "?",
}
_CODE = re.compile(r"\\(?:x(?P<hex>[0-9a-fA-F]{1,8})|[uU](?P<unicode>[0-9a-fA-F]{4,8})|(?P<octal>[0-7]{1,3}))")
_OF_TEXTS = frozenset({"s", "sv", ""})
_OCTAL = re.compile(r"0[0-7']+[uUlL]*")
_DIGITS = re.compile(r"^-?[\d'.]+(?:[eE][+-]?\d+)?")


def string(reader: ExprReader, node: Node) -> Expr:
    """A string or character, unescaped."""
    return Text(_string_value(reader, node), node.type == "char_literal")


def _string_value(reader: ExprReader, node: Node) -> str:
    parts = []
    for child in node.named_children:
        if child.type == "escape_sequence":
            parts.append(_unescaped(reader.text(child)))
        elif child.type in {"string_content", "character", "raw_string_content"}:
            parts.append(reader.text(child))
        elif child.type in {"string_literal", "raw_string_literal"}:
            parts.append(_string_value(reader, child))
    return "".join(parts)


def _unescaped(text: str) -> str:
    """What an escape sequence stands for; what is none stays as it is written. Source: [lex.ccon]."""
    code = _CODE.fullmatch(text)
    if code is None:
        return _ESCAPES.get(text[1:], text)
    number = int(code["octal"], 8) if code["octal"] else int(code["hex"] or code["unicode"], 16)
    return chr(number) if number < 0x80 or (code["unicode"] and number <= sys.maxunicode) else text


def concatenated(reader: ExprReader, node: Node) -> Expr:
    """Strings side by side; a macro between them is added to them."""
    parts = [reader.read(child) for child in node.named_children if child.type != "comment"]
    if all(isinstance(part, Text) for part in parts):
        return Text("".join(part.value for part in parts if isinstance(part, Text)))
    return Op("+", tuple(parts))


def number(reader: ExprReader, node: Node) -> Expr:
    """A number without suffix and digit separators."""
    text = reader.text(node)
    value = _number(text)
    return Number(value) if value is not None else Opaque(text[:80])


def _number(text: str) -> int | float | None:
    if text[:2].lower() in {"0x", "0b"}:
        return integer(text.rstrip("uUlL").replace("'", ""), 0)
    if _OCTAL.fullmatch(text):
        return integer(text.rstrip("uUlL").replace("'", ""), 8)
    match = _DIGITS.match(text)
    digits = match.group().replace("'", "") if match else text
    return real(digits) if any(c in digits for c in ".eE") else integer(digits)


def user_literal(reader: ExprReader, node: Node) -> Expr:
    """`100ms` is a call of its suffix, and so is a text with one that is none of the standard's."""
    children = node.named_children
    suffix = next((reader.text(child) for child in children if child.type == "literal_suffix"), "")
    value = next((reader.read(child) for child in children if child.type != "literal_suffix"), None)
    if value is None:
        return number(reader, node)
    if isinstance(value, Text) and suffix in _OF_TEXTS:
        return value
    return Call(Name(suffix), (value,), line=node.start_point[0] + 1)


def constant(reader: ExprReader, node: Node) -> Expr:
    """`true`, `false` or null."""
    return Constant("null" if node.type in {"null", "nullptr"} else node.type)
