"""Plain JSON data as YAML text that YAML 1.1 and 1.2 readers understand alike.

PyYAML's own writer takes seconds for the manifests of a large repository, so plain data has this small one.
Block style for sections and their fields. What a person looks through as a list (endpoints, lines of evidence) is
written in flow style: an endpoint in one to a few lines, several places to a line.
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
_DEEPEST: Final = 3
_MOST_LINES_OF_A_LIST: Final = 12
_MOST_LINES_OF_AN_ITEM: Final = 8
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
        most = _MOST_LINES_OF_A_LIST if isinstance(value, list) else 1
        is_section = not indent and isinstance(value, dict) and bool(value)
        lines = _flow_lines(value, f"{head} ", indent + "  ", most) if not is_section else None
        if lines is not None:
            yield from lines
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
        inner = indent + "  "
        flow = _flow_lines(value, f"{indent}- ", inner + " ", _MOST_LINES_OF_AN_ITEM)
        if flow is not None:
            yield from flow
            continue
        lines = _mapping(value, inner) if isinstance(value, dict) else _items(value, inner)
        yield f"{indent}- {next(lines)[len(inner) :]}"
        yield from lines


def _flow_lines(value: Any, head: str, indent: str, most: int) -> list[str] | None:
    """Lines of a value behind `head` in flow style, filled up to the width; None when block style reads better.

    Args:
        value: plain data.
        head: what stands before it on its first line.
        indent: before each further line.
        most: lines that it may take; each step of it stays on one line.
    """
    if isinstance(value, _SCALARS) or not value:
        return [head + (_flow(value) or "")]
    whole = _flow(value)
    if whole is None:
        return None
    if len(head) + len(whole) < _WIDTH:
        return [head + whole]
    lines = _filled(_steps(value), head + whole[0], indent, whole[-1]) if most > 1 else []
    return lines if lines and len(lines) <= most and max(map(len, lines)) <= _WIDTH else None


def _filled(parts: list[str], head: str, indent: str, end: str) -> list[str]:
    """Parts one after the other, a new line where the next one does not fit."""
    lines, current = [], head
    for at, part in enumerate(parts):
        text = part + (end if at == len(parts) - 1 else ",")
        between = "" if at == 0 else " "
        if at and len(current) + len(between) + len(text) > _WIDTH:
            lines.append(current)
            current, between = indent, ""
        current += between + text
    return [*lines, current]


def _flow(value: Any, depth: int = 0) -> str | None:
    """Text of a value in flow style; None when it is nested too deeply for a person, or has a key that is too long."""
    if isinstance(value, _SCALARS):
        return _scalar(value)
    if depth == _DEEPEST:
        return None if value else ("{}" if isinstance(value, dict) else "[]")
    inner = [_flow(item, depth + 1) for item in (value.values() if isinstance(value, dict) else value)]
    if any(text is None for text in inner) or any(len(key) >= _WIDTH for key in value if isinstance(value, dict)):
        return None
    joined = ", ".join(_parts(value, depth))
    return f"{{{joined}}}" if isinstance(value, dict) else f"[{joined}]"


def _steps(value: dict[str, Any] | list[Any]) -> list[str]:
    """Parts between which a line may end: also between the items of a list within."""
    if isinstance(value, list):
        return _parts(value)
    return [step for key, item in value.items() for step in _steps_of(f"{_string(key)}: ", item)]


def _steps_of(head: str, item: Any) -> list[str]:
    if not isinstance(item, list) or len(item) < 2:
        return [f"{head}{_flow(item, 1)}"]
    first, *others = _parts(item, 1)
    return [f"{head}[{first}", *others[:-1], f"{others[-1]}]"]


def _parts(value: dict[str, Any] | list[Any], depth: int = 0) -> list[str]:
    if isinstance(value, dict):
        return [f"{_string(key)}: {_flow(item, depth + 1)}" for key, item in value.items()]
    return [_flow(item, depth + 1) or "" for item in value]


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
