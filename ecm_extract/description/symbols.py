"""Properties of xacro: looked up through the macro calls around, evaluated when they are used.

Source: the xacro wiki page, "Property and Property Blocks", "Evaluation Order".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ecm_parsers.expression import UnknownNameError
from lxml import etree


class Raw:
    """A property's text before it is evaluated, and the symbols of the place where it is written."""

    __slots__ = ("symbols", "text")

    def __init__(self, text: str, symbols: Symbols) -> None:
        self.text = text
        self.symbols = symbols


class Block:
    """Elements that a property or a macro parameter holds, with the file and symbols where they are written."""

    __slots__ = ("elements", "path", "symbols")

    def __init__(self, elements: list[etree._Element], path: str, symbols: Symbols) -> None:
        self.elements = elements
        self.path = path
        self.symbols = symbols


class Symbols(Mapping[str, Any]):
    """The names of one macro call or of the file, and of what surrounds it.

    `evaluate` gives the value of a raw text; a property that needs itself is an `UnknownNameError`.
    """

    def __init__(self, evaluate: Callable[[str, Symbols], Any], parent: Symbols | None = None) -> None:
        self.own: dict[str, Any] = {}
        self.parent = parent
        self._evaluate = evaluate
        self._active: set[str] = set()

    def holder(self, name: str) -> Symbols | None:
        """Return the nearest symbols that hold a name."""
        current: Symbols | None = self
        while current is not None:
            if name in current.own:
                return current
            current = current.parent
        return None

    def top(self) -> Symbols:
        """Return the outermost symbols."""
        current = self
        while current.parent is not None:
            current = current.parent
        return current

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self.holder(name) is not None

    def __getitem__(self, name: str) -> Any:
        holder = self.holder(name)
        if holder is None:
            raise KeyError(name)
        value = holder.own[name]
        if not isinstance(value, Raw):
            return value
        if name in holder._active:
            message = f"property `{name}` needs itself"
            raise UnknownNameError(message)
        holder._active.add(name)
        try:
            value = holder.own[name] = self._evaluate(value.text, value.symbols)
        finally:
            holder._active.discard(name)
        return value

    def __iter__(self) -> Iterator[str]:
        seen: set[str] = set()
        current: Symbols | None = self
        while current is not None:
            yield from (name for name in current.own if name not in seen)
            seen |= current.own.keys()
            current = current.parent

    def __len__(self) -> int:
        return sum(1 for _ in self)
