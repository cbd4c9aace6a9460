"""The changes that can break somebody, found by what consumers require."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ecm_checker.hub.kinds import kinds_that
from ecm_checker.hub.provision import Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.roles import endpoint_kinds
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import NAMES
from ecm_checker.match.names import called_names
from ecm_checker.match.provisions import Provisions, Sought

from ecm_extract.diff.brought import Brought
from ecm_extract.diff.effects import alters_bytes
from ecm_extract.diff.model import Located
from ecm_extract.diff.wholes import wholes_of
from ecm_extract.entities.side import Side

GONE: Final = frozenset({"removed", "renamed", "moved"})
_SECOND: Final = frozenset({"type_changed", "default_changed", "signature_changed"})
"""What else changed of a name that is gone: who used the name has that one cause."""


class BrokenNames:
    """What the old side provided and the new one does not, or provides otherwise.

    Attributes:
        after: all that the new side provides. brought: what depending on its packages brings along.

    `own` are the packages of the new side as consumers; without them only what a consumer itself depends on is known.
    """

    def __init__(self, located: Iterable[Located], old: Side, new: Side, own: Sequence[Consumer] = ()) -> None:
        self.brought = Brought(own)
        self._before = old.paths
        self._ros = {each.ros for side in (old, new) for each in side.packages.values()}
        self._located = tuple(located)
        self._changes: dict[Key, list[Located]] = defaultdict(list)
        changed: dict[Key, Provision] = {}
        for entry in (one for joined in self._located for one in joined.each):
            entity = entry.pair.old
            if entity is not None and _concerns(entry):
                self._changes[entity.key].append(entry)
                changed[entity.key] = entity
        for entity, entry in _gone_with_their_whole(self._located, old, new):
            if entity.key not in changed:
                self._changes[entity.key].append(entry)
                changed[entity.key] = entity
        self._changed = Provisions(changed.values(), whole=Provisions(old.entities.values(), old.bound))
        self.after = Provisions(new.entities.values(), new.bound)
        self._layouts = _layouts(self._located)
        self._duties = _duties(self._located)

    def is_of_other_ros(self, consumer: Consumer) -> bool:
        """Whether a consumer is of a ROS that no package of either side is of."""
        return consumer.ros is not None and bool(self._ros) and not self._ros & {consumer.ros, None}

    def is_older(self, path: str) -> bool:
        """Whether the old side had a file, which the new side may have forgotten."""
        return path in self._before

    def is_empty(self) -> bool:
        """Whether nothing can break."""
        return not self._changes and not self._duties and not self._layouts

    def sought(self) -> Iterator[Sought]:
        """Yield by what every requirement is found that a change may concern, and others as well."""
        yield from self._changed.sought()
        asked = (one for joined in self._located if _is_looked_for(joined) for one in joined.each)
        yield from Provisions(one.pair.new for one in asked if one.pair.new is not None).sought()
        generated = kinds_that(lambda row: row.generated)
        yield from (Sought(kind, name) for kind in generated for name in self._layouts)

    def meant(self, requirement: Requirement, consumer: Consumer) -> Iterator[Located]:
        """Yield the changes of the names that a requirement may mean."""
        found = self._changed.named(requirement, consumer)
        if requirement.row.fit == NAMES and not self._is_one(found, requirement):
            return
        for entity in found:
            yield from self._changes[entity.key]

    def _is_one(self, found: Sequence[Provision], requirement: Requirement) -> bool:
        """Whether a dotted name that several modules below it may have means one function."""
        last = requirement.name.rpartition(".")[2]
        names = {name for each in found for name in called_names(each, self._changed.bases)}
        return len({name for name in names if name.rpartition(".")[2] == last}) <= 1

    def layout_of(self, name: str) -> Located | None:
        """Return a change that alters the layout of an interface; None when it is as it was."""
        return self._layouts.get(name)

    def duties_of(self, package: str | None, launch_file: str) -> Sequence[Located]:
        """Return the arguments that a launch file asks for since the change."""
        return self._duties.get((package, launch_file), ())


def _is_looked_for(entry: Located) -> bool:
    """Whether its new name tells something: an argument that is asked for now, a name that a remap may lead to."""
    return entry.change.breaking and (entry.change.row.duty or entry.change.kind in endpoint_kinds())


def _concerns(entry: Located) -> bool:
    counts = entry.change.breaking or entry.change.change == "deprecated"
    return counts and not (entry.pair.how != "same" and entry.change.change in _SECOND)


def _gone_with_their_whole(located: Iterable[Located], old: Side, new: Side) -> Iterator[tuple[Provision, Located]]:
    """Yield what went with its package, class, message or launch file: one change tells of the whole."""
    removed = [entry for entry in located if entry.change.change == "removed" and entry.change.row.contains]
    wholes = {entry.pair.old.key[:4]: entry for entry in removed if entry.pair.old is not None}
    for entity in old.entities.values() if wholes else ():
        whole = next((wholes[key] for key in wholes_of(entity) if key in wholes), None)
        alone = entity.row.world == "package" or entity.row.alone
        if whole is not None and whole.pair.old is not entity and alone and entity.key not in new.entities:
            yield entity, whole


def _layouts(located: Iterable[Located]) -> dict[str, Located]:
    """The first change of each type that alters its bytes; it stands for the others."""
    found: dict[str, Located] = {}
    for entry in located:
        entity = entry.pair.old or entry.pair.new
        if entity is None or not entry.change.breaking:
            continue
        if alters_bytes(entity):
            found.setdefault(entity.owner, entry)
        elif entity.row.generated and entry.change.change == "signature_changed":
            found.setdefault(entity.name, entry)
    return found


def _duties(located: Iterable[Located]) -> dict[tuple[str | None, str], list[Located]]:
    found: dict[tuple[str | None, str], list[Located]] = defaultdict(list)
    for entry in located:
        old, new = entry.pair.old, entry.pair.new
        if new is None or not new.row.duty or new.default is not None or not entry.change.breaking:
            continue
        if old is None or entry.change.change == "default_changed":
            found[new.package, new.owner].append(entry)
    return found
