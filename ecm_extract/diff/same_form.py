"""Methods that live on under another name with the very signature that they had.

Names of a rename need not be alike (`setPlan`, `newPathReceived`), and an old name may be given to something else
(`get_state` of a lifecycle became `get_lifecycle_state`, and `get_state` now reads an interface).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.effects import accepts
from ecm_extract.diff.history import History
from ecm_extract.diff.model import Pair
from ecm_extract.diff.similarity import name_similarity

_LEAST_NAME = 0.5
_GIVEN_AWAY, _ONLY = 0.8, 0.65
Signature = frozenset[tuple[tuple[str, ...], str]]


def given_away(pairs: Iterable[Pair], added: Iterable[Provision]) -> Iterator[tuple[Pair, Pair]]:
    """Yield each pair of one name whose old signature has gone to a new, similar name, with the pair it should be."""
    fresh: dict[tuple[str, str, Signature], list[Provision]] = defaultdict(list)
    for entity in added:
        if entity.row.called:
            fresh[entity.kind, entity.owner, signature(entity)].append(entity)
    for pair in pairs:
        old, new = pair.old, pair.new
        if old is None or new is None or not old.row.called or old.name != new.name or not old.forms:
            continue
        if any(accepts(after, before) for before in old.forms for after in new.forms):
            continue
        homes = [
            entity
            for entity in fresh.get((old.kind, new.owner, signature(old)), ())
            if name_similarity(old.name, entity.name) >= _LEAST_NAME
        ]
        if len(homes) == 1:
            reason = f"{homes[0].name} is new and has its very signature; {new.name} is something else now"
            yield pair, Pair(old, homes[0], "renamed", _GIVEN_AWAY, reason)


def only_ones(removed: Iterable[Provision], added: Iterable[Provision], history: History | None) -> Iterator[Pair]:
    """Yield the pair of a method that went and one that came, when no other of the class has their signature.

    A signature without parameters says little, so there somebody must have written of the two names; so does one of
    Python, whose parameters seldom have types, unless the names are alike.
    """
    gone: dict[tuple[str, Signature], list[Provision]] = defaultdict(list)
    came: dict[tuple[str, Signature], list[Provision]] = defaultdict(list)
    for entities, groups in ((removed, gone), (added, came)):
        for entity in entities:
            if entity.row.part and entity.forms:
                groups[entity.owner, signature(entity)].append(entity)
    for key, before in gone.items():
        after = came.get(key, [])
        if len(before) != 1 or len(after) != 1:
            continue
        written = history.mentions(before[0].name, after[0].name) if history is not None else None
        if written or _is_telling(before[0], after[0]):
            reason = "of all methods that went and came only these two have this signature"
            reason += f"; history says: {written[:160]}" if written else ""
            yield Pair(before[0], after[0], "renamed", _ONLY, reason)


def _is_telling(old: Provision, new: Provision) -> bool:
    """Whether that two methods have one signature says that they are one."""
    alike = not old.is_python or name_similarity(old.name, new.name) >= _LEAST_NAME
    return alike and any(form.types for form in old.forms)


def signature(entity: Provision) -> Signature:
    """Parameter types and return types of all overloads."""
    return frozenset((form.types, form.returns) for form in entity.forms)
