"""Parameters of xacro macros: `a b:=default c:=^ d:=^|default *block **blocks`."""

from __future__ import annotations

import re
from dataclasses import dataclass

from lxml import etree

_PARAMETER = re.compile(
    r"""\s*(?P<stars>\*{0,2})(?P<name>[^\s:*]+?)"""
    r"""(?::?=(?P<forward>\^\|?)?(?P<default>(?:'[^']*'|"[^"]*"|\$\{[^}]*\}|\$\([^)]*\)|[^\s'"])*))?(?=\s|$)"""
)


@dataclass(frozen=True, slots=True)
class MacroParameter:
    """One parameter.

    Attributes:
        name: without stars. block: `*` takes an element, `**` the children of an element, empty a text.
        default: text when the call gives none; None when it must.
        forward: the value of the same name around the call comes before the default.
    """

    name: str
    block: str = ""
    default: str | None = None
    forward: bool = False


@dataclass(frozen=True, slots=True)
class Macro:
    """A macro: its parameters, its body, and the file that it is written in."""

    name: str
    parameters: tuple[MacroParameter, ...]
    body: etree._Element
    path: str


def macro_parameters(text: str) -> tuple[MacroParameter, ...]:
    """Read the `params` attribute of a macro."""
    return tuple(_parameter(match) for match in _PARAMETER.finditer(text))


def _parameter(match: re.Match[str]) -> MacroParameter:
    forward, default = match["forward"], match["default"]
    given = default if default or not forward or forward.endswith("|") else None
    if given is not None and len(given) > 1 and given[0] == given[-1] and given[0] in "\"'":
        given = given[1:-1]
    return MacroParameter(match["name"], match["stars"], given, forward is not None)
