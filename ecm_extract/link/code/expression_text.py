"""Expressions as people read them: as their language writes them, without what only a compiler needs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Items, Member, Name, Number, Op, Opaque, Text

MAX_TEXT: Final = 120
"""Characters beyond which a text is cut."""
_PYTHON: Final[Mapping[str, str]] = MappingProxyType({"&&": "and", "||": "or", "!": "not "})
_CONSTANTS: Final[Mapping[str, str]] = MappingProxyType({"true": "True", "false": "False", "null": "None"})
Known = Callable[[Expr], str]
"""What a part of an expression is called; empty for what is written out."""


def expression_text(expr: Expr, python: bool, known: Known = lambda _: "") -> str:
    """Return an expression as a text of one line.

    Args:
        expr: the expression.
        python: whether it is written as Python does, else as C++ does.
        known: names parts of it.
    """
    text = _Writer(python, known).text(expr)
    return text if len(text) <= MAX_TEXT else f"{text[: MAX_TEXT - 3]}..."


class _Writer:
    def __init__(self, python: bool, known: Known) -> None:
        self.python = python
        self.known = known

    def text(self, expr: Expr) -> str:
        named = self.known(expr)
        if named:
            return named
        match expr:
            case Name():
                return "self" if self.python and expr == THIS else expr.id.partition("@")[0]
            case Member():
                return self._member(expr)
            case Call():
                return f"{self.text(expr.callee)}({self._listed(expr.args)})"
            case Op():
                return self._op(expr)
            case Items():
                return f"[{self._listed(expr.items)}]" if self.python else f"{{{self._listed(expr.items)}}}"
        return self._plain(expr)

    def _plain(self, expr: Expr) -> str:
        match expr:
            case Text():
                return f'"{expr.value}"'
            case Number():
                return str(expr.value)
            case Constant():
                return _CONSTANTS[expr.name] if self.python else {"null": "nullptr"}.get(expr.name, expr.name)
            case Opaque():
                return " ".join(expr.text.split())
        return "..."

    def _member(self, expr: Member) -> str:
        if expr.base == THIS and not self.python:
            return expr.name
        return f"{self.text(expr.base)}.{expr.name}"

    def _listed(self, parts: tuple[Expr, ...]) -> str:
        return ", ".join(self.text(part) for part in parts)

    def _op(self, expr: Op) -> str:
        sign = _PYTHON.get(expr.op, expr.op) if self.python else expr.op
        if expr.op == "[]" and len(expr.operands) == 2:
            return f"{self.text(expr.operands[0])}[{self.text(expr.operands[1])}]"
        parts = [f"({self.text(part)})" if _is_compound(part) else self.text(part) for part in expr.operands]
        return f"{sign}{parts[0]}" if len(parts) == 1 else f" {sign} ".join(parts)


def _is_compound(expr: Expr) -> bool:
    return isinstance(expr, Op) and len(expr.operands) > 1 and expr.op != "[]"
