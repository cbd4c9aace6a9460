"""One record for an endpoint that several lines make."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.contract import Evidence, Interface


def merged(interfaces: Iterable[Interface]) -> tuple[Interface, ...]:
    """Join records of one endpoint that several lines make: same role, name and type; evidence adds up."""
    by_key: dict[tuple[str, str, str | None], Interface] = {}
    for entry in interfaces:
        key = (entry.role, entry.name, entry.type)
        known = by_key.get(key)
        if known is None:
            by_key[key] = entry
            continue
        evidence = tuple(dict.fromkeys((*known.evidence, *entry.evidence)))
        by_key[key] = _joined(known, entry, evidence)
    return tuple(
        sorted(
            by_key.values(),
            key=lambda e: (e.role, e.name, e.type or "", e.evidence[0].path, e.evidence[0].line),
        )
    )


def _joined(first: Interface, second: Interface, evidence: tuple[Evidence, ...]) -> Interface:
    return Interface(
        role=first.role,
        name=first.name,
        raw_name=first.raw_name,
        type=first.type,
        qos=first.qos or second.qos,
        frame=first.frame or second.frame,
        confidence=first.confidence,
        evidence=evidence,
        default=second.default if first.default is None else first.default,
        inherited_from=first.inherited_from if second.inherited_from else None,
    )
