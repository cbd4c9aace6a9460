"""Objects that a container makes of what it is given: `rows.emplace_back(node, "name")` constructs an element."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final

from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.containers import element_type
from ecm_extract.link.code.spelling import by_value, last_name, plain, template_arguments
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects

EMPLACING: Final[Mapping[str, int]] = MappingProxyType(
    {"emplace_back": 0, "emplace_front": 0, "try_emplace": 1, "emplace": 0}
)
"""Methods that make an element -> arguments in front that are none of its constructor (C++ standard, containers)."""
_OF_OPTIONALS: Final = "emplace"
"""Of an optional it makes what that holds; of a container it is given a key, or a place."""


def emplaced(
    calls: Mapping[str, Sequence[Invocation]], objects: Objects, known: Collection[str]
) -> Iterator[tuple[str, Invocation]]:
    """Yield the class that a call makes an element of, by its last name, with its construction.

    Args:
        calls: all calls by their last names.
        objects: tells what containers hold.
        known: last names of classes of libraries that tell something when they are made.
    """
    for name, skipped in EMPLACING.items():
        for call in calls.get(name, ()):
            written = _made_by(call, objects)
            found = _construction(call, written, skipped, objects, known) if by_value(written) else None
            if found is not None:
                yield found.last, found


def _made_by(call: Invocation, objects: Objects) -> str:
    """The type of what a method makes, empty where it makes nothing; a pointer is made elsewhere."""
    if call.receiver is None or call.func.file.language != "cpp":
        return ""
    written = objects.type_of(call.receiver, Env(call.func, call.at))
    if call.last != _OF_OPTIONALS:
        return element_type(written)
    return next(iter(template_arguments(written)), "") if last_name(plain(written)) == "optional" else ""


def _construction(
    call: Invocation, written: str, skipped: int, objects: Objects, known: Collection[str]
) -> Invocation | None:
    if not written:
        return None
    cls = objects.class_written(written, Env(call.func, call.at))
    made = replace(call, receiver=None, args=call.args[skipped:], made=True)
    if cls is not None:
        return replace(made, path=cls.qualified, types=call.types or template_arguments(written))
    meant = objects.program.alias(plain(written), call.func.file, call.func.scope) or written
    if last_name(plain(meant)) not in known or not by_value(meant):
        return None
    return replace(made, path=plain(meant), types=template_arguments(meant))
