"""Properties of xacro: looked up through the macro calls around, evaluated when they are used.

Source: the xacro wiki page, "Property and Property Blocks", "Evaluation Order".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
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

    def target(self, scope: str) -> Symbols:
        """Return the symbols that a property of scope `global`, `parent` or none is set in."""
        if scope == "global":
            return self.top()
        return self.parent if scope == "parent" and self.parent is not None else self

    def evaluated(self, text: str) -> Any:
        """Return the value of a text in these symbols."""
        return self._evaluate(text, self)

    def forget(self, name: str) -> None:
        """Remove a name from these symbols and those around."""
        while (holder := self.holder(name)) is not None:
            del holder.own[name]

    def __contains__(self, name: object) -> bool:
        if not isinstance(name, str):
            return False
        return self.holder(name) is not None or self._inside(name) is not None

    def __getitem__(self, name: str) -> Any:
        holder = self.holder(name)
        if holder is None:
            space = self._inside(name)
            if space is None:
                raise KeyError(name)
            return space[name.partition(".")[2]]
        value = holder.own[name]
        return holder._resolved(name, value) if isinstance(value, Raw) else value

    def _inside(self, name: str) -> Symbols | None:
        """Return the symbols of the included namespace that `ns.name` is in."""
        first, _, rest = name.partition(".")
        holder = self.holder(first) if rest else None
        space = holder.own[first] if holder is not None else None
        return space if isinstance(space, Symbols) and rest in space else None

    def _resolved(self, name: str, raw: Raw) -> Any:
        if name in self._active:
            message = f"property `{name}` needs itself"
            raise UnknownNameError(message)
        self._active.add(name)
        try:
            value = self.own[name] = self._evaluate(raw.text, raw.symbols)
        finally:
            self._active.discard(name)
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


@dataclass(frozen=True, slots=True)
class Unknown:
    """A value with a part that only the launch knows, which stands in braces; no text, so that none is taken for one.

    Whoever writes it out says so by `str`.

    Attributes:
        text: as it is written out. data: list, tuple or map of which a part is not known; None for a text.
    """

    text: str
    data: Any = None

    def __str__(self) -> str:
        return self.text


class Watched(Mapping[str, Any]):
    """The names of one expression; one that is not known is given as text with braces, and noted.

    Attributes:
        touched: an unknown value was used, so that the result is not known either.
    """

    def __init__(self, symbols: Symbols, extra: Mapping[str, Any]) -> None:
        self._symbols = symbols
        self._extra = extra
        self.touched = False

    def __contains__(self, name: object) -> bool:
        return name in self._extra or name in self._symbols

    def __getitem__(self, name: str) -> Any:
        return self.told(self._extra[name] if name in self._extra else self._symbols[name])

    def told(self, value: Any) -> Any:
        """Return a value as the expression has it; that it is not known is noted."""
        if not isinstance(value, Unknown):
            return value
        self.touched = True
        return value.text if value.data is None else value.data

    def __iter__(self) -> Iterator[str]:
        yield from self._extra
        yield from self._symbols

    def __len__(self) -> int:
        return len(self._extra) + len(self._symbols)
