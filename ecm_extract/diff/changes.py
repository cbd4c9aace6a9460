"""Pairs -> changes: the records of the wire format, one cause each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import kinds_that
from ecm_checker.hub.provision import LAUNCHED, Key, Provision
from ecm_checker.release import Change

from ecm_extract.diff.alias_targets import retargeted
from ecm_extract.diff.causes import one_cause
from ecm_extract.diff.duties import old_duties
from ecm_extract.diff.effects import EFFECTS, Difference, added_breaks, alters_bytes, hidden, no_longer_set, set_now
from ecm_extract.diff.folding import folded
from ecm_extract.diff.model import Located, Pair
from ecm_extract.diff.overriding import with_inherited_virtual
from ecm_extract.diff.successors import stated_successor
from ecm_extract.diff.wholes import wholes_of
from ecm_extract.diff.wire import nested_changes, own_changes, wire_note
from ecm_extract.entities.side import Side

Names = set[tuple[str, str, str, str]]
NO_LONGER_STARTED: Final = "the launch file no longer starts it: who runs or includes the file is without it"


def changes_of(pairs: Iterable[Pair], old: Side, new: Side) -> list[Located]:
    """Return all changes, most breaking first within each package."""
    listed = list(with_inherited_virtual(pairs, new.entities))
    gone = {pair.old.key[:4] for pair in listed if pair.old is not None and pair.new is None}
    fresh = {pair.new.key[:4] for pair in listed if pair.new is not None and pair.old is None}
    duties = old_duties(listed, old)
    found = [located for pair in listed for located in _of_pair(pair, gone, fresh, duties)]
    found += [_nested(pair, path) for pair, path in nested_changes(listed, old, new)]
    found += [_otherwise(pair, how) for pair, how in own_changes(listed, _altered(found), old, new)]
    found += [_for_another(*each) for each in retargeted(listed, old.entities, new.entities)]
    told = [_with_successor(_with_wire(located, old, new), new) for located in found]
    return sorted(folded(one_cause(told, new)), key=_order)


def _order(located: Located) -> tuple[str, bool, str, str, str, str]:
    change = located.change
    name = change.old or change.new or ""
    return change.package, not change.breaking, change.kind, change.owner, name, change.change


def _of_pair(pair: Pair, gone: Names, fresh: Names, duties: frozenset[Key]) -> Iterator[Located]:
    if pair.old == pair.new:
        return
    if pair.old is not None and pair.new is not None:
        for effect in EFFECTS:
            for difference in effect(pair.old, pair.new, pair):
                yield Located(_record(pair, difference), pair)
    elif pair.old is not None and not _is_covered(pair.old, gone) and not _is_implicit(pair.old):
        yield Located(_record(pair, _removal(pair.old) if pair.hidden_in is None else hidden(pair.hidden_in)), pair)
    elif pair.new is not None and not _is_covered(pair.new, fresh):
        why = added_breaks(pair.new) if pair.new.key not in duties else None
        yield Located(_record(pair, _addition(pair.new, why)), pair)


def _is_covered(entity: Provision, containers: Names) -> bool:
    """Whether the whole that holds an entity came or went too: one cause, one change."""
    if entity.row.of_file and _file_of(entity) & containers:
        return True
    return any(whole in containers for whole in wholes_of(entity))


def _file_of(entity: Provision) -> Names:
    """The file of an entity under each name that it may have in its package."""
    parts = entity.path.split("/")
    names = ["/".join(parts[at:]) for at in range(len(parts))]
    return {(kind, entity.package, "", name) for kind in kinds_that(lambda row: row.included) for name in names}


def _is_implicit(entity: Provision) -> bool:
    """Whether callers still find a method that went: an override of a base, or a constructor that each class has."""
    if not entity.row.called or not entity.row.part:
        return False
    if all(form.override for form in entity.forms):
        return True
    own = entity.owner.rsplit("::", 1)[-1]
    given = {(), (f"const {own}&",), (f"{own}&&",)}
    return own == entity.name and all(form.types in given for form in entity.forms)


def _addition(entity: Provision, why: str | None) -> Difference:
    if entity.row.sets:
        return set_now(entity)
    return Difference("added", why is not None, why or "new")


def _removal(entity: Provision) -> Difference:
    if entity.row.sets:
        return no_longer_set(entity)
    reason = entity.row.gone if entity.facet != LAUNCHED else NO_LONGER_STARTED
    if entity.deprecated:
        reason = f"{reason}; it was deprecated: {entity.deprecated[:200]}"
    return Difference("removed", True, reason)


def _record(pair: Pair, difference: Difference) -> Change:
    entity = pair.new or pair.old
    before = pair.old or entity
    assert entity is not None
    assert before is not None
    return Change(
        kind=difference.kind or before.kind,
        change=difference.change,
        package=before.package,
        owner=before.owner,
        old=difference.old or _name(pair.old, difference, pair),
        new=difference.new or _name(pair.new, difference, pair),
        breaking=difference.breaking,
        dimension=difference.dimension,  # type: ignore[arg-type]
        confidence=pair.confidence,
        reason=difference.reason,
        evidence_old=Evidence(pair.old.path, pair.old.line) if pair.old is not None else None,
        evidence_new=Evidence(pair.new.path, pair.new.line) if pair.new is not None else None,
        old_value=difference.old_value,
        new_value=difference.new_value,
    )


def _name(entity: Provision | None, difference: Difference, pair: Pair) -> str | None:
    """The name; of what moved with its new place, since the name alone says nothing."""
    if entity is None:
        return None
    if difference.change != "moved" or pair.old is None or pair.new is None or pair.old.name != pair.new.name:
        return entity.name
    place = entity.owner if pair.old.owner != pair.new.owner else ""
    if pair.old.package != pair.new.package and not place:
        place = entity.package
    return f"{place}: {entity.name}" if place else entity.name


def _with_successor(located: Located, new: Side) -> Located:
    """Name what a deprecation tells to use, where it names one."""
    entity = located.pair.new
    if located.change.change != "deprecated" or entity is None:
        return located
    successor = stated_successor(entity, new.entities)
    if successor is None:
        return located
    return Located(msgspec.structs.replace(located.change, new=successor.name), located.pair)


def _nested(pair: Pair, path: str) -> Located:
    reason = f"its text is the same, that of {path} is not: rebuild both sides"
    return Located(_record(pair, Difference("signature_changed", True, reason, "signature")), pair)


def _altered(found: Iterable[Located]) -> frozenset[str]:
    """Interfaces of which a part is told whose change makes another type of them."""
    entities = (each.pair.old or each.pair.new for each in found if each.change.breaking)
    return frozenset(entity.owner for entity in entities if entity is not None and alters_bytes(entity))


def _otherwise(pair: Pair, how: str) -> Located:
    return Located(
        _record(pair, Difference("signature_changed", True, f"{how}: rebuild both sides", "signature")), pair
    )


def _for_another(pair: Pair, before: str, after: str) -> Located:
    reason = f"it stood for {before} and stands for {after} now: who uses it gets another class"
    return Located(
        _record(pair, Difference("type_changed", True, reason, "signature", old_value=before, new_value=after)), pair
    )


def _with_wire(located: Located, old: Side, new: Side) -> Located:
    """Add to a change of an interface what its users see at run time."""
    change, pair = located.change, located.pair
    row = change.row
    entity = pair.old or pair.new
    after = pair.new or pair.old
    if entity is None or after is None or not change.breaking:
        return located
    alone = change.change in {"removed", "added"}
    if not (alters_bytes(entity) if alone or row.fixed else row.wire):
        return located
    before_name = entity.owner if entity.row.part else entity.name
    after_name = after.owner if after.row.part else after.name
    note = wire_note(before_name, old, new, after_name)
    reason = f"{change.reason}. {note}" if note else change.reason
    return Located(msgspec.structs.replace(change, reason=reason), pair)
