"""Two sides have different definitions of one message type."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.definitions import difference
from ecm_extract.observe.model import Endpoint
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS004",
    name="definition_differs",
    dimension="versioning",
    severity="error",
    who="wire",
    consequence="ROS 1 drops the connection with an md5 error, ROS 2 reads bytes of one as fields of the other",
    resolution="build both sides against one version of the interface package",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Endpoints of one topic against each other, and every endpoint against the interface packages."""
    yield from _between(watch)
    told: set[tuple[str, str]] = set()
    for end in watch.seen.endpoints:
        wanted = watch.hashes.get(end.type or "")
        if wanted and _differs(end.hash, wanted) and (end.type or "", end.hash or "") not in told:
            told.add((end.type or "", end.hash or ""))
            text = f"{end.node or end.name} runs with {end.type} {_short(end.hash)}, its contract says {_short(wanted)}"
            yield RULE.seen(text, Entity("message", end.type or "", "contract"), (end.node or end.name,))


def _between(watch: Watch) -> Iterator[Finding]:
    """One finding for each topic and type with several hashes."""
    groups: defaultdict[tuple[str, str], dict[str, Endpoint]] = defaultdict(dict)
    for end in watch.seen.endpoints:
        if end.type and end.hash and end.hash != "*":
            groups[end.name, end.type].setdefault(end.hash, end)
    for (name, kind), ends in groups.items():
        if len(ends) > 1:
            one, two = list(ends.values())[:2]
            text = (
                f"{name}: {one.node or 'one side'} has {kind} {_short(one.hash)}, {two.node or 'another'} has "
                f"{_short(two.hash)}{difference(one.definition, two.definition)}"
            )
            subjects = [end.node or name for end in ends.values()]
            yield RULE.seen(text, Entity("message", kind, name), subjects)


def _differs(seen: str | None, wanted: str) -> bool:
    """Hashes of one kind only: md5 of ROS 1 and RIHS01 of ROS 2 say nothing of each other."""
    same_kind = seen is not None and seen != "*" and seen.startswith("RIHS") == wanted.startswith("RIHS")
    return same_kind and seen != wanted


def _short(digest: str | None) -> str:
    return (digest or "").removeprefix("RIHS01_")[:12]
