"""One cause, one change: what several modules share is told once, with what lives on beside it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import Final

import msgspec
from ecm_checker.hub.provision import HOLE, Provision
from ecm_checker.hub.roles import module_kinds

from ecm_extract.diff.model import Located
from ecm_extract.diff.similarity import last_part
from ecm_extract.entities.side import Side

_MAX_NAMED: Final = 4
_TELLING: Final = 12
Homes = dict[tuple[str, str, str], list[Provision]]


def one_cause(found: Iterable[Located], new: Side) -> list[Located]:
    """Join what one line does to one name in several modules; hint at the same name elsewhere in its owner.

    Names that a line makes beside each other, as in a loop, are several: who uses one does not use the next. What it
    makes of values that are not known are ways to write one name; all are named, and each is asked for.
    """
    homes: Homes = defaultdict(list)
    for entity in new.entities.values():
        if entity.is_of_module:
            homes[entity.kind, entity.facet, last_part(entity.name)].append(entity)
    groups: dict[object, list[Located]] = {}
    for number, located in enumerate(found):
        groups.setdefault(_cause(located) or number, []).append(located)
    return [_hinted(_joined(group), homes) for group in groups.values()]


def _cause(located: Located) -> object:
    """What makes two changes one: kind, what happened, the names and values, the lines."""
    change = located.change
    if change.kind not in module_kinds() and not change.row.policy:
        return None
    sides = [entity for entity in (located.pair.old, located.pair.new) if entity is not None]
    what = (change.kind, change.change, change.breaking, change.old_value, change.new_value)
    policy = (change.old, change.new) if change.row.policy else ()
    return what, policy, tuple((_known(entity.name), entity.path, entity.line) for entity in sides)


def _known(name: str) -> str:
    """A name, or what one ends in whose parts are computed."""
    return f"{HOLE}{last_part(name)}" if HOLE in name else name


def _joined(group: list[Located]) -> Located:
    first, *rest = sorted(group, key=lambda entry: (_is_foreign(entry), entry.change.package, entry.change.owner))
    pairs = tuple(entry.pair for entry in rest)
    owners = sorted({entry.change.owner for entry in group} - {first.change.owner})
    names = sorted({_name(entry) for entry in rest} - {_name(first)})
    reason = first.change.reason
    reason += f" (also of {_listed(owners)})" if owners else ""
    reason += f" (also {_listed(names)})" if names else ""
    return Located(msgspec.structs.replace(first.change, reason=reason), first.pair, pairs)


def _name(located: Located) -> str:
    entity = located.pair.old or located.pair.new
    return entity.name if entity is not None else ""


def _listed(words: list[str]) -> str:
    return ", ".join(words[:_MAX_NAMED]) + (" and more" if len(words) > _MAX_NAMED else "")


def _is_foreign(located: Located) -> bool:
    """Whether the line stands outside the folder that is named after the package."""
    at = located.change.evidence_new or located.change.evidence_old
    return at is None or located.change.package not in at.path.split("/")


def _hinted(located: Located, homes: Homes) -> Located:
    change, entity = located.change, located.pair.old
    if change.change != "removed" or entity is None or not entity.is_of_module:
        return located
    alike = homes.get((entity.kind, entity.facet, last_part(entity.name)), ())
    found = next((other for other in alike if _is_beside(entity, other)), None)
    if found is None:
        return located
    reason = f"{change.reason}; {found.name} of {found.owner} remains"
    return msgspec.structs.replace(located, change=msgspec.structs.replace(change, reason=reason))


def _is_beside(old: Provision, other: Provision) -> bool:
    """Whether an entity is of the same owner, or declared in the same folders; a short name says nothing."""
    if (old.package, old.owner) == (other.package, other.owner):
        return True
    return old.path.split("/")[:3] == other.path.split("/")[:3] and len(last_part(old.name)) >= _TELLING
