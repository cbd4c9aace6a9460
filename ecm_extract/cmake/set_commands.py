"""`set`, `unset`, `option` and `math` (cmake-commands(7))."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Sequence
from typing import Final

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.policies import is_new
from ecm_extract.cmake.state import cached_name

_ENVIRONMENT: Final = "ENV{"
_FORCED: Final = frozenset({"FORCE", "INTERNAL"})
_EXPRESSION: Final = re.compile(r"[0-9a-fA-FxX+\-*/%|&^~()<> \t]{1,200}")
_BITS: Final = 1 << 64
_OPERATORS: Final[dict[type[ast.operator], Callable[[int, int], int]]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.BitOr: operator.or_,
    ast.BitAnd: operator.and_,
    ast.BitXor: operator.xor,
    ast.LShift: lambda one, by: one << by if 0 <= by < 64 else 0,
    ast.RShift: lambda one, by: one >> by if 0 <= by < 64 else 0,
    ast.Div: lambda one, by: abs(one) // abs(by) * (1 if (one < 0) == (by < 0) else -1),
    ast.Mod: lambda one, by: abs(one) % abs(by) * (-1 if one < 0 else 1),
}


def set_variable(args: list[str], look: Look) -> Sequence[Change]:
    """`set(NAME values... [PARENT_SCOPE | CACHE TYPE doc [FORCE]])`; without values the variable goes."""
    if not args or args[0].startswith(_ENVIRONMENT):
        return []
    name, values = args[0], args[1:]
    if "CACHE" in values:
        at = values.index("CACHE")
        return _cached(name, ";".join(values[:at]), not _FORCED.isdisjoint(values[at:]), look)
    outside = values[-1:] == ["PARENT_SCOPE"]
    values = values[:-1] if outside else values
    return [Change(name, ";".join(values) if values else None, "outside" if outside else "here")]


def _cached(name: str, text: str, forced: bool, look: Look) -> Sequence[Change]:
    """What the cache holds already stays; a variable of that name goes, unless CMP0126 keeps it."""
    if look.has(cached_name(name)) and not forced:
        return []
    is_hidden = look.has(name) and look.get(name) is not None and not look.is_cached(name)
    if is_hidden and is_new(look, "CMP0126"):
        return [Change(cached_name(name), text, "everywhere")]
    return [Change(name, text, "cache")]


def unset_variable(args: list[str], look: Look) -> Sequence[Change]:
    """`unset(NAME [CACHE | PARENT_SCOPE])`."""
    del look
    if not args or args[0].startswith(_ENVIRONMENT):
        return []
    return [Change(args[0], None, "outside" if "PARENT_SCOPE" in args[1:] else "here")]


def option(args: list[str], look: Look) -> Sequence[Change]:
    """`option(NAME text [value])`; what the cache holds stays, a variable does so by CMP0077 only."""
    if not args or look.has(cached_name(args[0])):
        return []
    if look.has(args[0]) and look.get(args[0]) is not None and is_new(look, "CMP0077"):
        return []
    return [Change(args[0], args[2] if len(args) > 2 else "OFF", "cache")]


def math(args: list[str], look: Look) -> Sequence[Change]:
    """`math(EXPR NAME expression [OUTPUT_FORMAT DECIMAL | HEXADECIMAL])`."""
    del look
    if len(args) < 3 or args[0] != "EXPR":
        return []
    number = _number(args[2])
    if number is None:
        return not_known(args[1])
    return [Change(args[1], hex(number % _BITS) if "HEXADECIMAL" in args[3:] else str(number))]


def _number(text: str) -> int | None:
    if not _EXPRESSION.fullmatch(text):
        return None
    try:
        value = _evaluated(ast.parse(text.strip(), mode="eval").body) % _BITS
    except (SyntaxError, ValueError, ZeroDivisionError, RecursionError, MemoryError):
        return None
    return value - _BITS if value >= _BITS // 2 else value


def _evaluated(node: ast.expr) -> int:
    if isinstance(node, ast.Constant) and type(node.value) is int:
        return node.value
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd, ast.Invert)):
        inner = _evaluated(node.operand)
        return -inner if isinstance(node.op, ast.USub) else inner if isinstance(node.op, ast.UAdd) else ~inner
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        return _OPERATORS[type(node.op)](_evaluated(node.left), _evaluated(node.right))
    raise ValueError(ast.dump(node))
