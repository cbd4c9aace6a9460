"""Types of plain YAML scalars, as the ROS parameter readers see them.

Sources: YAML 1.1 core types, with the floats that both `rcl_yaml_param_parser` and people accept (`1e-5`); PyYAML,
which `rosparam`, `roslaunch` and `launch` read with, and to which `1e-5` is text.
"""

import math
import re
from typing import Any

import yaml

PlainScalar = str | int | float | bool | None

MAX_DIGITS = 64
_PYYAML_TAGS = frozenset(f"tag:yaml.org,2002:{kind}" for kind in ("null", "bool", "int", "float"))
_NULLS = frozenset({"", "~", "null", "Null", "NULL"})
_TRUE = frozenset({"true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"})
_FALSE = frozenset({"false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"})
_DECIMAL = re.compile(r"[-+]?(0|[1-9][0-9_]*)")
_BASED = re.compile(r"(?P<sign>[-+]?)(0x(?P<hex>[0-9a-fA-F_]+)|0b(?P<bin>[01_]+)|0o?(?P<oct>[0-7_]+))")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_SPECIAL = re.compile(r"(?P<sign>[-+]?)\.(?P<name>inf|Inf|INF|nan|NaN|NAN)")


def typed(text: str) -> PlainScalar:
    """Return the value of an unquoted scalar; text that is no number, boolean or null stays text."""
    if text in _NULLS:
        return None
    if text in _TRUE or text in _FALSE:
        return text in _TRUE
    number = _number(text) if len(text) <= MAX_DIGITS else None
    return text if number is None else number


def typed_by_pyyaml(text: str) -> PlainScalar:
    """Return the value of an unquoted scalar as PyYAML reads it; what is no number, boolean or null stays text."""
    resolver: Any = yaml.resolver.Resolver()
    tag = resolver.resolve(yaml.ScalarNode, text, (True, False)) if len(text) <= MAX_DIGITS else ""
    if tag not in _PYYAML_TAGS:
        return text
    try:
        value: PlainScalar = yaml.constructor.SafeConstructor().construct_object(yaml.ScalarNode(tag, text))
    except ValueError:  # `0b_` fits the pattern of a number
        return text
    return value


def _number(text: str) -> int | float | None:
    """Return the number that `text` spells, or None."""
    if _DECIMAL.fullmatch(text):
        return int(text.replace("_", ""))
    based = _BASED.fullmatch(text)
    if based:
        return _based_int(based)
    if _FLOAT.fullmatch(text):
        return float(text)
    special = _SPECIAL.fullmatch(text)
    if special:
        value = math.inf if special["name"].lower() == "inf" else math.nan
        return -value if special["sign"] == "-" else value
    return None


def _based_int(match: re.Match[str]) -> int | None:
    """Return a hexadecimal, binary or octal integer; None when only underscores were given."""
    for group, base in (("hex", 16), ("bin", 2), ("oct", 8)):
        digits = (match[group] or "").replace("_", "")
        if digits:
            return int(match["sign"] + digits, base)
    return None
