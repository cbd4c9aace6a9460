"""Endpoints that a contract leaves open, with the names and policies under which they were seen."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

import msgspec
from ecm_checker.contract import Contract, Evidence, Interface, Qos
from ecm_parsers.overlay_yaml import SeenEndpoint


def with_seen(contract: Contract, seen: Iterable[SeenEndpoint], path: str) -> Contract:
    """Return a contract with what was seen of its open endpoints; what it knows itself stays.

    Args:
        contract: as it was read.
        seen: endpoints of the overlay.
        path: of the overlay in the tree.
    """
    by_open: defaultdict[tuple[str, str], list[SeenEndpoint]] = defaultdict(list)
    for each in seen:
        by_open[each.role, each.was].append(each)
    if not by_open:
        return contract
    interfaces = tuple(
        filled
        for entry in contract.signature.interfaces
        for filled in _filled(entry, by_open.get((entry.role, entry.name), ()), path)
    )
    return msgspec.structs.replace(
        contract, signature=msgspec.structs.replace(contract.signature, interfaces=interfaces)
    )


def _filled(entry: Interface, seen: Iterable[SeenEndpoint], path: str) -> Iterator[Interface]:
    """One endpoint for each name that was seen. What was seen once may differ elsewhere, as a default may."""
    found = list(seen)
    if not found:
        yield entry
    for each in found:
        yield msgspec.structs.replace(
            entry,
            name=each.name if "{" in entry.name else entry.name,
            type=entry.type or each.type,
            qos=entry.qos or _qos(each),
            confidence="default" if entry.confidence == "pattern" else entry.confidence,
            evidence=(*entry.evidence, Evidence(path, each.line)),
        )


def _qos(seen: SeenEndpoint) -> Qos | None:
    """None for policies that are none."""
    try:
        return msgspec.convert(seen.qos, Qos) if seen.qos else None
    except msgspec.ValidationError:
        return None
