"""Macros of xacro: their parameters `a b:=default c:=^ d:=^|default *block **blocks`, and how a call finds one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lxml import etree

from ecm_extract.description.symbols import Symbols

MAX_PARAMETERS_TEXT = 10_000
_PARAMETER = re.compile(
    r"""(?P<stars>\*{0,2})(?P<name>[^\s:=*]++)"""
    r"""(?:\s*+:?=\s*+(?P<forward>\^\|?)?(?P<default>(?:'[^']*+'|"[^"]*+"|\$\{[^}]*+\}|\$\([^)]*+\)|[^\s'"])*+))?"""
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


@dataclass(frozen=True, slots=True, eq=False)
class Macro:
    """A macro: its parameters, its body, the file that it is written in.

    Attributes:
        prefix: of the namespace that includes it (`ns.`), empty for none. scope: the symbols of that namespace.
    """

    name: str
    parameters: tuple[MacroParameter, ...]
    body: etree._Element
    path: str
    prefix: str = ""
    scope: Symbols | None = None

    def fits(self, given: set[str]) -> bool:
        """Tell whether an element with these attributes can be a call: all that it must give, nothing else."""
        texts = [entry for entry in self.parameters if not entry.block]
        needed = {entry.name for entry in texts if entry.default is None and not entry.forward}
        return needed <= given <= {entry.name for entry in texts}


class Macros:
    """All macros known so far, by name."""

    def __init__(self) -> None:
        self._by_name: dict[str, Macro] = {}

    def add(self, macro: Macro) -> None:
        """Define a macro, or define it anew."""
        self._by_name[macro.prefix + macro.name] = macro

    def find(self, name: str, prefix: str = "") -> Macro | None:
        """Return the macro that a name means inside a namespace: its own first, then those around it."""
        found = (self._by_name.get(around + name) for around in _around(prefix))
        return next((macro for macro in found if macro is not None), None)


def macro_parameters(text: str) -> tuple[MacroParameter, ...]:
    """Read the `params` attribute of a macro."""
    return tuple(_parameter(match) for match in _PARAMETER.finditer(text[:MAX_PARAMETERS_TEXT]))


def _parameter(match: re.Match[str]) -> MacroParameter:
    forward, default = match["forward"], match["default"]
    given = default if default or not forward or forward.endswith("|") else None
    return MacroParameter(match["name"], match["stars"], given, forward is not None)


def _around(prefix: str) -> Iterator[str]:
    """Yield `a.b.`, `a.` and the empty prefix."""
    while prefix:
        yield prefix
        prefix = prefix.rstrip(".").rpartition(".")[0]
        prefix += "." if prefix else ""
    yield ""
