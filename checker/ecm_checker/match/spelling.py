"""Whether a name that is used is the name that is provided, across namespaces and computed parts."""

from __future__ import annotations

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase
from functools import lru_cache
from typing import Final

from ecm_checker.gaps import with_gaps
from ecm_checker.hub.provision import HOLE

_UNKNOWN: Final = re.compile(r"\{[^{}]*\}")
_KEPT: Final = 4096
"""Patterns that are kept compiled: the names of one release are compared with those of all consumers."""
_EVERY_NODE: Final = frozenset({"", "/**", "/*", "**", "*"})


def graph_name_matches(offered: str, used: str) -> bool:
    """Compare graph names by their ends: private and relative names hang below a node or namespace.

    `~/gps/fix` offers `/mavros/gps/fix`; `/scan` offers `/robot1/scan`; a computed part fits anything but a slash, and
    one in front may be no namespace at all.
    """
    rest = offered.lstrip("~/")
    given = _UNKNOWN.sub(HOLE, used).lstrip("~/")
    if not rest or not given or not given.replace(HOLE, "").strip("/"):
        return False
    below_node = offered.startswith("~") and not used.startswith("~")
    return _graph_pattern(rest, below_node).fullmatch(given) is not None


def whole_name_matches(offered: str, used: str) -> bool:
    """Compare names that are resolved; a computed part is any text, one in front may be none."""
    return _whole_pattern(offered).fullmatch(used) is not None


@lru_cache(_KEPT)
def _whole_pattern(name: str) -> re.Pattern[str]:
    lead, rest = ("/(?:.+/)?", name[len(HOLE) + 2 :]) if name.startswith(f"/{HOLE}/") else ("", name)
    return re.compile(lead + _with_holes(rest, ".+"))


@lru_cache(_KEPT)
def _graph_pattern(name: str, below_node: bool) -> re.Pattern[str]:
    name = name if below_node else _without_lead(name)
    pattern = _with_holes(name, "[^/]+")
    return re.compile(rf"(?:.*/)[^/]+/{pattern}|[^/]+/{pattern}" if below_node else rf"(?:.*/)?{pattern}")


def _without_lead(name: str) -> str:
    """A name without a namespace in front that is computed: it may be none."""
    return name.removeprefix(f"{HOLE}/")


def parameter_name_matches(declared: str, given: str) -> bool:
    """Compare parameter names; a computed part fits any name, ROS 1 names hang below namespaces."""
    rest = declared.lstrip("~/")
    if _parameter_pattern(rest, False).fullmatch(given.lstrip("~/")):
        return True
    return "/" in rest and _parameter_pattern(rest, True).fullmatch(given) is not None


@lru_cache(_KEPT)
def _parameter_pattern(name: str, below_namespace: bool) -> re.Pattern[str]:
    pattern = _with_holes(name, ".+")
    return re.compile(rf"(?:.*/)?{pattern}" if below_namespace else pattern)


def text_pattern(names: Iterable[str]) -> re.Pattern[str]:
    """Return what finds the text of one of some names in what is given; something else may stand before it."""
    found = (_with_holes(_without_lead(name.lstrip("~/")).removeprefix(HOLE), ".*") for name in names)
    return re.compile("|".join(rf"(?s:{each})\Z" for each in dict.fromkeys(found)))


def _with_holes(name: str, hole: str) -> str:
    return with_gaps([re.escape(part) for part in name.split(HOLE)], hole)


def node_matches(owner: str, node: str) -> bool:
    """Whether parameters that a file gives to a node pattern reach a module; `**` fits any depth, `*` one part."""
    return node in _EVERY_NODE or fnmatchcase(owner, node.rsplit("/", 1)[-1])
