"""Objects that a container makes of what it is given: `rows.emplace_back(node, "name")` constructs an element."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Final

from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.containers import element_type
from ecm_extract.link.code.spelling import by_value, template_arguments
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects

EMPLACING: Final[Mapping[str, int]] = MappingProxyType({"emplace_back": 0, "emplace_front": 0, "try_emplace": 1})
"""Methods that make an element -> arguments in front that are none of its constructor (C++ standard, containers)."""


def emplaced(calls: Mapping[str, Sequence[Invocation]], objects: Objects) -> Iterator[tuple[str, Invocation]]:
    """Yield the class of the tree that a call makes an element of, by its last name, with its construction."""
    for name, skipped in EMPLACING.items():
        for call in calls.get(name, ()):
            found = _construction(call, skipped, objects)
            if found is not None:
                yield found.last, found


def _construction(call: Invocation, skipped: int, objects: Objects) -> Invocation | None:
    if call.receiver is None or call.func.file.language != "cpp":
        return None
    env = Env(call.func, call.at)
    written = element_type(objects.type_of(call.receiver, env))
    cls = objects.class_written(written, env) if written and by_value(written) else None  # a pointer is made elsewhere
    if cls is None:
        return None
    types = call.types or template_arguments(written)
    return replace(call, path=cls.qualified, receiver=None, args=call.args[skipped:], types=types, made=True)
