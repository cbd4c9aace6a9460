"""Strings of Python: literals, and those with expressions in them."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.expr import Expr, Op, Template, Text
from ecm_parsers.source.python_literal import NULL, content_value, joined, split_string, string_value
from ecm_parsers.source.python_scan import SKIPPED, Scan, parts

_F_PREFIXES = (b"f", b"F", b"t", b"T")


def string(scan: Scan, node: Node) -> Expr:
    """Read a string; what cannot be told of it is Opaque."""
    raw = scan.data[node.start_byte : node.end_byte]
    # Most strings are short, without prefix and escape.
    quote = raw[:1]
    if quote in (b"'", b'"') and b"\\" not in raw and raw[1:2] != quote and raw[-1:] == quote:
        return Text(raw[1:-1].decode("utf-8", "replace"))
    if raw[:1] in _F_PREFIXES or raw[1:2] in _F_PREFIXES:
        return _template(scan, node, raw)
    value = string_value(raw)
    return scan.opaque(node) if value is None else Text(value)


def _template(scan: Scan, node: Node, raw: bytes) -> Expr:
    bounds = split_string(raw)
    if bounds is None:
        return scan.opaque(node)
    prefix, start, end = bounds
    origin = node.start_byte
    position = start
    pieces: list[Expr] = []
    for child in node.named_children:
        if child.type != "interpolation":
            continue
        pieces.append(_piece(raw[position : child.start_byte - origin], prefix))
        pieces.extend(_interpolation(scan, child))
        position = child.end_byte - origin
    pieces.append(_piece(raw[position:end], prefix))
    if len(pieces) == 1:
        return pieces[0]
    return Template(tuple(piece for piece in pieces if piece != Text("")))


def _piece(content: bytes, prefix: str) -> Text:
    return Text(content_value(content.replace(b"{{", b"{").replace(b"}}", b"}"), raw="r" in prefix))


def _interpolation(scan: Scan, node: Node) -> list[Expr]:
    value: Expr = NULL
    spec: list[Expr] = []
    shown: list[Expr] = []
    for child in node.children[1:-1]:
        kind = child.type
        if kind == "type_conversion":
            spec.append(Text(scan.text(child)))
        elif kind == "format_specifier":
            spec += _spec(scan, child)
        elif kind == "=":
            shown = [Text(scan.data[node.start_byte + 1 : child.end_byte].decode("utf-8", "replace"))]
        elif child.is_named and kind not in SKIPPED:
            value = scan.expr(child)
    return [*shown, Op("format", (value, joined(spec))) if spec else value]


def _spec(scan: Scan, node: Node) -> list[Expr]:
    """What tells how a value is written, with the values that stand in it: `>{width}.{digits}f`."""
    found: list[Expr] = []
    start = node.start_byte + 1
    for child in [each for each in node.children if each.is_named]:
        found += [Text(scan.data[start : child.start_byte].decode("utf-8", "replace")), *map(scan.expr, parts(child))]
        start = child.end_byte
    return [*found, Text(scan.data[start : node.end_byte].decode("utf-8", "replace"))]
