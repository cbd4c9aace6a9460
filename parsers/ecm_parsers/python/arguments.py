"""What a call is given."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import msgspec

from ecm_parsers.python.values import Condition, Value, template_of
from ecm_parsers.template import Template


class Arguments(msgspec.Struct, frozen=True):
    """What a call is given; `line` is 1-based."""

    positional: tuple[Value, ...]
    keywords: Mapping[str, Value]
    line: int

    def get(self, name: str, position: int | None = None, default: Value = None) -> Value:
        """Return a keyword argument, or the positional one that stands for it."""
        if name in self.keywords:
            return self.keywords[name]
        if position is not None and position < len(self.positional):
            return self.positional[position]
        return default

    def template(self, name: str, position: int | None = None) -> Template:
        """Return an argument as text with substitutions."""
        return template_of(self.get(name, position))

    def optional(self, name: str, position: int | None = None) -> Template | None:
        """Return an argument as text, None when it is not given or None."""
        value = self.get(name, position)
        return None if value is None else template_of(value)

    @property
    def condition(self) -> Template | None:
        """What `condition=` asks for."""
        value = self.get("condition")
        return value.holds if isinstance(value, Condition) else None if value is None else template_of(value)


Constructor = Callable[[Arguments], Value]
"""What makes a value of a call."""
