"""YAML files that xacro loads, as plain data; a value with a unit tag is given in SI units.

Source: the xacro wiki page, "YAML support": `!degrees`, `!radians`, `!meters`, `!millimeters`, `!foot`, `!inches`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping as ReadOnly
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression import ExpressionError, evaluate
from ecm_parsers.yaml_tree import Mapping, Node, Scalar, Sequence, parse_yaml

_FACTORS: ReadOnly[str, float] = MappingProxyType(
    {
        "!radians": 1.0,
        "!degrees": math.pi / 180.0,
        "!meters": 1.0,
        "!millimeters": 0.001,
        "!foot": 0.3048,
        "!inches": 0.0254,
    }
)


def yaml_data(data: bytes) -> Any:
    """Return the first document of a YAML file as dicts, lists and scalars; an empty dict when there is none."""
    documents = parse_yaml(data).facts
    return _plain(documents[0]) if documents else {}


def _plain(node: Node) -> Any:
    if isinstance(node, Mapping):
        return {entry.key: _plain(entry.value) for entry in node.entries}
    if isinstance(node, Sequence):
        return [_plain(item) for item in node.items]
    return _scaled(node)


def _scaled(scalar: Scalar) -> Any:
    factor = _FACTORS.get(scalar.tag)
    if factor is None:
        return scalar.value
    try:
        return float(evaluate(scalar.text, {})) * factor
    except (ExpressionError, TypeError, ValueError):
        return scalar.text
