"""Texts of launch files -> values of parameters, by the rules of who sets them.

Sources: roslaunch `loader.convert_value` (ROS 1); launch `utilities.type_utils` and launch_ros
`utilities.evaluate_parameters` (ROS 2), which read YAML with PyYAML; nav2_common `RewrittenYaml.convert`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from string import ascii_letters, digits
from types import MappingProxyType
from typing import Any

from ecm_parsers.launch.model import Typing
from ecm_parsers.yaml_scalar import PlainScalar, typed, typed_by_pyyaml
from ecm_parsers.yaml_tree import parse_yaml, plain

_PLAIN = frozenset(f"{ascii_letters}{digits}_./+-")
"""Characters of a text that is one scalar of YAML for sure, where it does not begin like a marker."""
_MARKERS = ("--", "..")
_WORDS: Mapping[str, bool] = MappingProxyType({"true": True, "false": False})
_TRUTH: Mapping[str, bool] = MappingProxyType({**_WORDS, "1": True, "0": False})


def value_of(text: str, typing: Typing) -> Any:
    """Return the value that a text has; text that its reader refuses stays as it is."""
    return _READERS[typing](text)


def rewritten(text: str, *, converts: bool) -> Any:
    """Return what `RewrittenYaml` puts in place of a value: numbers only where it converts types."""
    return _auto(text) if converts else _WORDS.get(text.lower(), text)


def of_command_line(text: str) -> Any:
    """Return the value of `-p name:=value` of ROS 2, which rcl reads as YAML."""
    return _yaml(text, typed)


def private(text: str) -> Any:
    """Return the value of `_name:=value` of ROS 1, as roscpp reads it."""
    return _auto(text)


def _yaml(text: str, scalar: Callable[[str], PlainScalar] = typed_by_pyyaml) -> Any:
    if _PLAIN.issuperset(text) and text != "-" and not text.startswith(_MARKERS):
        return scalar(text) if text else text
    found = parse_yaml(text.encode(), scalar)
    if found.diagnostics or len(found.facts) != 1:
        return text
    value = plain(found.facts[0])
    return text if isinstance(value, dict) else value


def _auto(text: str) -> Any:
    """roslaunch: with a dot a double, else an integer, else a truth value, else text."""
    bare = text.strip()
    number = _converted(bare, float) if "." in bare else bare if "_" in bare else _converted(bare, int)
    if number != bare:
        return number
    return _WORDS.get(bare.lower(), bare)


def _converted(text: str, kind: Callable[[str], float]) -> float | str:
    try:
        return kind(text)
    except ValueError:
        return text


def _truth(text: str) -> bool | str:
    known = _TRUTH.get(text.strip().lower())
    value = known if known is not None else typed_by_pyyaml(text.strip())
    return value if isinstance(value, bool) else text


_READERS: Mapping[Typing, Callable[[str], Any]] = MappingProxyType(
    {
        "yaml": _yaml,
        "auto": _auto,
        "str": lambda text: text,
        "bare": str.strip,
        "int": lambda text: _converted(text, int),
        "double": lambda text: _converted(text, float),
        "bool": _truth,
    }
)
