"""YAML with parts that only the launch knows: these stand in braces, which YAML would take for a map."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ecm_parsers.template import Template

from ecm_extract.system.substitute import Substituter

_OPEN, _CLOSE = "\ue000", "\ue001"


def marked(template: Template, substituter: Substituter) -> tuple[str, Mapping[str, str]]:
    """Return the text of a template with a mark for each part that is not known, and what the marks stand for."""
    holes: dict[str, str] = {}
    parts: list[str] = []
    for part in template:
        text = substituter.text((part,))
        mark = f"{_OPEN}{len(holes)}{_CLOSE}"
        if not text.known:
            holes[mark] = text.text
        parts.append(text.text if text.known else mark)
    return "".join(parts), holes


def filled(value: Any, holes: Mapping[str, str]) -> Any:
    """Return a value that was read of such a text, with what its marks stand for."""
    if isinstance(value, list):
        return [filled(item, holes) for item in value]
    if isinstance(value, dict):
        return {filled(key, holes): filled(item, holes) for key, item in value.items()}
    if isinstance(value, str):
        for mark, text in holes.items():
            value = value.replace(mark, text)
    return value
