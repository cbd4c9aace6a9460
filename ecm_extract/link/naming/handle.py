"""What a handle makes of names: where those that are relative to it stand in the graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ecm_checker.contract import Confidence

from ecm_extract.link.running.values import Value, is_proved, joined, literal, unique, weaker


class Handle(NamedTuple):
    """What a handle makes of names.

    Attributes:
        prefix: put before relative names; starts with `~` for a private handle, empty for the node itself.
        node: name of a node made on the spot, to which `~` then belongs; None for the module's own node.
        others: what it may be as well.
    """

    prefix: Value
    node: Value | None = None
    others: tuple[Handle, ...] = ()

    @property
    def surely(self) -> Confidence:
        """How surely a name below it is where it is told."""
        proved = is_proved(self.prefix) and self.prefix.confidence != "one_of"
        return "literal" if proved else self.prefix.confidence

    def each(self) -> tuple[Handle, ...]:
        """Return each of what it may be."""
        return (self._replace(others=()), *self.others)

    def as_choice(self) -> Handle:
        """Return the same as one of several."""
        return self._replace(prefix=self.prefix._replace(confidence=weaker(self.prefix.confidence, "one_of")))


OWN = Handle(literal(""))


def of_any(prefixes: Sequence[Value], node: Value | None = None) -> Handle:
    """Return the handle that has one of several prefixes."""
    first, *others = unique(prefixes)
    return Handle(first, node, tuple([Handle(each, node) for each in others]))


def under(prefix: Value, name: Value) -> Value:
    """Return `prefix/name`; an empty prefix changes nothing, an absolute name drops the prefix."""
    if not prefix.parts or prefix.text == "" or name.text.startswith("/"):
        return name
    if prefix.text == "~":
        return joined([(prefix,), (name,)])[0]
    return joined([(prefix,), (literal("/"),), (name,)])[0]


def agreed(found: Sequence[Handle | None]) -> Handle | None:
    """Return the handle that all are; None where they differ, or one of them is not known."""
    return found[0] if found and all(each == found[0] for each in found) else None
