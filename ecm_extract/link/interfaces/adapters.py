"""Types of C++ that a tree adapts to messages: `template<> struct rclcpp::TypeAdapter<Custom, Message>` (REP 2007)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import File
from ecm_extract.link.index.program import Program

_NAME: Final = "TypeAdapter"
_SCOPE: Final = "rclcpp"
_CUSTOM: Final = "custom_type"
_MESSAGE: Final = "ros_message_type"


@dataclass(frozen=True, slots=True)
class _Adapter:
    """The two types that each specialization must name, as written."""

    custom: str
    message: str


class Adapters:
    """Finds the message that a type is sent as; each file is looked through once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._of: dict[File, Sequence[_Adapter]] = {}

    def message(self, name: str, file: File, scope: str) -> str:
        """Return the message of a type, qualified; empty of one that no header which a file sees adapts.

        Args:
            name: of the type, in a scope of the file.
            file: where it is sent.
            scope: in which the name stands.
        """
        own = self.program.class_named(name, file, scope)
        found = {
            each.message
            for seen in ((file, *self.program.included(file)) if own is not None else ())
            for each in self._in(seen)
            if self.program.class_named(each.custom, seen, _SCOPE) is own
        }
        return found.pop() if len(found) == 1 else ""

    def _in(self, file: File) -> Sequence[_Adapter]:
        known = self._of.get(file)
        if known is None:
            known = self._of[file] = tuple(_adapters(file))
        return known


def _adapters(file: File) -> Iterator[_Adapter]:
    for cls in file.facts.classes:
        if cls.name == _NAME and cls.scope == _SCOPE:
            inside = (each for each in file.facts.aliases if cls.line <= each.line <= cls.end_line)
            named = {each.name: plain(each.target) for each in inside}
            if _CUSTOM in named and _MESSAGE in named:
                yield _Adapter(named[_CUSTOM], named[_MESSAGE])
