"""Expanded XML: a light tree in which every element knows the file and line that it came from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(slots=True)
class Element:
    """One element.

    Attributes:
        tag: without namespace. attributes, text: after substitution; `{name}` stands for what is not known.
        path, line: where it is written. conditional: the condition that is not known, empty for none.
    """

    tag: str
    attributes: dict[str, str]
    path: str
    line: int
    text: str = ""
    children: list[Element] = field(default_factory=list)
    conditional: str = ""

    def get(self, name: str, default: str = "") -> str:
        """Return an attribute."""
        return self.attributes.get(name, default)

    def below(self, *tags: str) -> Iterator[Element]:
        """Yield the children with one of these tags."""
        return (child for child in self.children if child.tag in tags)

    def first(self, tag: str) -> Element | None:
        """Return the first child with a tag."""
        return next(self.below(tag), None)

    def content(self, tag: str) -> str:
        """Return the text of the first child with a tag, empty without one."""
        child = self.first(tag)
        return child.text.strip() if child is not None else ""

    def walk(self) -> Iterator[Element]:
        """Yield this element and all below it in document order."""
        pending = [self]
        while pending:
            current = pending.pop()
            yield current
            pending.extend(reversed(current.children))
