"""What source text says about the end of a name: warnings that quote it beside the word `deprecated`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ecm_parsers.source.expr import Call, Expr, Items, Op, Table, Template, Text
from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.facts import PackageFacts

_WORD = re.compile(r"[\w./~-]+")
_MARK = re.compile(r"deprecat", re.IGNORECASE)
_OLD = re.compile(r"(.{0,200}?)deprecat(.{0,200})", re.IGNORECASE | re.DOTALL)
_INSTEAD = re.compile(r"\b(?:use|replaced by|in favou?r of|instead)\b", re.IGNORECASE)
MAX_DEPTH = 40


def deprecated_names(facts: PackageFacts) -> Mapping[str, str]:
    """Return names that warnings of a package call deprecated, with the warning.

    Words before `deprecated` are the old name; so are words right after it, up to `use` or `instead`.
    """
    found: dict[str, str] = {}
    for source in facts.sources.values():
        for text in _warnings(source):
            for word in _old_names(text):
                found.setdefault(word, " ".join(text.split()))
    return found


def _old_names(text: str) -> Iterator[str]:
    match = _OLD.search(text)
    if match is None:
        return
    before, after = match.groups()
    parts = [before, _INSTEAD.split(after)[0]]
    quoted = [word for part in parts for word in re.findall(r"[\"'`]([\w./~-]+)[\"'`]", part)]
    words = quoted or [word for part in parts for word in _WORD.findall(part)]
    yield from (word.strip(".") for word in words if "_" in word or "." in word.strip(".") or quoted)


def _warnings(source: SourceFile) -> Iterator[str]:
    for function in source.functions:
        for statement in function.body:
            if statement.value is not None:
                yield from (text for text in texts(statement.value) if _MARK.search(text))


def texts(expr: Expr, depth: int = 0) -> Iterator[str]:
    """Yield the string literals of an expression, outermost first; adjacent parts of a sum are one text."""
    if depth > MAX_DEPTH:
        return
    if isinstance(expr, Text):
        yield expr.value
    elif isinstance(expr, Op) and expr.op in {"+", "<<"}:
        parts = [text for operand in expr.operands for text in texts(operand, depth + 1)]
        yield "".join(parts)
    else:
        for part in children(expr):
            yield from texts(part, depth + 1)


def children(expr: Expr) -> tuple[Expr, ...]:
    """Return the direct parts of an expression."""
    if isinstance(expr, Call):
        return (expr.callee, *expr.args, *(value for _, value in expr.keywords))
    if isinstance(expr, Op):
        return expr.operands
    if isinstance(expr, Items):
        return expr.items
    if isinstance(expr, Template):
        return expr.parts
    if isinstance(expr, Table):
        return tuple(part for entry in expr.entries for part in entry)
    base = getattr(expr, "base", None)
    return (base,) if base is not None else ()
