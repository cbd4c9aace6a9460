"""Plain JSON data as YAML text that YAML 1.1 and 1.2 readers understand alike.

PyYAML's own writer takes seconds for the manifests of a large repository, so plain data has this small one.
Block style; a mapping or list of scalars that fits on the line is written on one line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from json.encoder import encode_basestring
from typing import Any, Final

_WIDTH: Final = 110
_LONGEST_SIMPLE_KEY: Final = 1000  # YAML 1.1 and 1.2: 1024 characters, indicator included
_PLAIN: Final = re.compile(r"[A-Za-z_/][A-Za-z0-9_/.+-]*(?: [A-Za-z0-9_/.+(][A-Za-z0-9_/.+()-]*)*")
_RESERVED: Final = frozenset(["null", "true", "false", "yes", "no", "on", "off", "y", "n"])
# What YAML does not allow raw or takes for a line break.
_UNSAFE: Final = re.compile("[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff\ud800-\udfff]")
_SCALARS: Final = (str, int, float, type(None))


def yaml_document(data: dict[str, Any]) -> str:
    """One YAML document, beginning with `---`.

    Args:
        data: dicts with string keys, lists, strings, integers, floats, booleans, None.

    Returns:
        Text that ends with a newline; `yaml.safe_load` gives back `data`.
    """
    if not data:
        return "--- {}\n"
    return "---\n" + "\n".join(_mapping(data, "")) + "\n"


def _mapping(data: dict[str, Any], indent: str) -> Iterator[str]:
    for key, value in data.items():
        head = _key(key, indent)
        line = _one_line(value, len(head))
        if line is not None:
            yield f"{head} {line}"
        elif isinstance(value, dict):
            yield head
            yield from _mapping(value, indent + "  ")
        else:
            yield head
            yield from _items(value, indent)


def _key(key: str, indent: str) -> str:
    text = _string(key)
    return f"{indent}{text}:" if len(text) < _LONGEST_SIMPLE_KEY else f"{indent}? {text}\n{indent}:"


def _items(data: list[Any], indent: str) -> Iterator[str]:
    for value in data:
        line = _one_line(value, len(indent) + 1)
        if line is not None:
            yield f"{indent}- {line}"
            continue
        inner = indent + "  "
        lines = _mapping(value, inner) if isinstance(value, dict) else _items(value, inner)
        yield f"{indent}- {next(lines)[len(inner) :]}"
        yield from lines


def _one_line(value: Any, column: int) -> str | None:
    """Text of a scalar, an empty collection, or a collection of scalars that fits; else None."""
    if isinstance(value, _SCALARS):
        return _scalar(value)
    if isinstance(value, dict):
        if not all(isinstance(item, _SCALARS) for item in value.values()):
            return None
        text = "{" + ", ".join([f"{_string(key)}: {_scalar(item)}" for key, item in value.items()]) + "}"
    else:
        if not all(isinstance(item, _SCALARS) for item in value):
            return None
        text = "[" + ", ".join([_scalar(item) for item in value]) + "]"
    return text if column + len(text) < _WIDTH or not value else None


def _scalar(value: Any) -> str:
    if isinstance(value, str):
        return _string(value)
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _float(value) if isinstance(value, float) else str(value)


@lru_cache(maxsize=4096)
def _string(text: str) -> str:
    if len(text) < _WIDTH and _PLAIN.fullmatch(text) and text.lower() not in _RESERVED:
        return text
    quoted = encode_basestring(text)
    if quoted.isascii() and "\x7f" not in quoted:
        return quoted
    return _UNSAFE.sub(lambda match: f"\\u{ord(match[0]):04x}", quoted)


def _float(value: float) -> str:
    """YAML 1.1 takes `1e-05` for a string: a mantissa needs its point."""
    text = repr(value)
    if text in ("inf", "-inf", "nan"):
        return text.replace("inf", ".inf").replace("nan", ".nan")
    mantissa, exponent, power = text.partition("e")
    return text if "." in mantissa or not exponent else f"{mantissa}.0e{power}"
