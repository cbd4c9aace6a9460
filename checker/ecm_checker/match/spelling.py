"""Whether a name that is used is the name that is provided, across namespaces and computed parts."""

from __future__ import annotations

import re
from fnmatch import fnmatchcase
from typing import Final

from ecm_checker.hub.provision import HOLE

_UNKNOWN: Final = re.compile(r"\{[^{}]*\}")
_EVERY_NODE: Final = frozenset({"", "/**", "/*", "**", "*"})


def graph_name_matches(offered: str, used: str) -> bool:
    """Compare graph names by their ends: private and relative names hang below a node or namespace.

    `~/gps/fix` offers `/mavros/gps/fix`; `/scan` offers `/robot1/scan`; a computed part fits anything but a slash.
    """
    rest = offered.lstrip("~/")
    given = _UNKNOWN.sub(HOLE, used).lstrip("~/")
    if not rest or not given or not given.replace(HOLE, "").strip("/"):
        return False
    pattern = _pattern(rest)
    if offered.startswith("~") and not used.startswith("~"):
        return re.fullmatch(rf"(?:.*/)[^/]+/{pattern}|[^/]+/{pattern}", given) is not None
    return re.fullmatch(rf"(?:.*/)?{pattern}", given) is not None


def _pattern(name: str) -> str:
    return "[^/]+".join(re.escape(part) for part in name.split(HOLE))


def parameter_name_matches(declared: str, given: str) -> bool:
    """Compare parameter names; a computed part fits any name, ROS 1 names hang below namespaces."""
    rest = declared.lstrip("~/")
    pattern = ".+".join(re.escape(part) for part in rest.split(HOLE))
    if re.fullmatch(pattern, given.lstrip("~/")):
        return True
    return "/" in rest and re.fullmatch(rf"(?:.*/)?{pattern}", given) is not None


def node_matches(owner: str, node: str) -> bool:
    """Whether parameters that a file gives to a node pattern reach a module; `**` fits any depth, `*` one part."""
    return node in _EVERY_NODE or fnmatchcase(owner, node.rsplit("/", 1)[-1])
