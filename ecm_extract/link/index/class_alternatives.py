"""Classes that a file defines once for each branch of `#if`, as sources for two distributions do."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_parsers.source.facts import Class
from msgspec.structs import replace


def alternatives_joined(classes: Iterable[Class]) -> Iterable[Class]:
    """Return the classes of one file, those of one name as one: it has the bases and members of all of them."""
    found: dict[tuple[str, str], Class] = {}
    for entry in classes:
        key = (entry.scope, entry.name)
        found[key] = _joined(found[key], entry) if key in found else entry
    return found.values()


def _joined(first: Class, second: Class) -> Class:
    own = {entry.name for entry in first.fields}
    fields = (*first.fields, *(entry for entry in second.fields if entry.name not in own))
    return replace(first, bases=tuple(dict.fromkeys((*first.bases, *second.bases))), fields=fields)
