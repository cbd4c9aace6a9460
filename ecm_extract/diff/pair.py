"""Which old entity is which new one: same key, moved, renamed, else removed and added.

Containers (packages, messages, classes) are paired first; the members of a container follow it, so that one
rename is one change.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

import msgspec
from ecm_checker.hub.kinds import containers, kinds, kinds_that
from ecm_checker.hub.provision import HOLE, LAUNCHED, Key, Provision
from ecm_checker.hub.roles import module_kinds
from ecm_checker.match.hierarchy import Bases

from ecm_extract.diff.assignment import assign
from ecm_extract.diff.computed import Computed
from ecm_extract.diff.file_moves import alone_in_moved_files, with_their_files
from ecm_extract.diff.hidden_names import HiddenNames, is_hidden_in
from ecm_extract.diff.kinship import kin, may_be_of
from ecm_extract.diff.launched import NoLongerStarted
from ecm_extract.diff.model import How, Pair
from ecm_extract.diff.module_homes import is_ported, likely_homes, module_homes, names_after
from ecm_extract.diff.moves import (
    GENERATED,
    Places,
    best_home,
    is_reshaped,
    move_key,
    tail_of,
    values_by_place,
)
from ecm_extract.diff.nodes import Successions, node_pairs
from ecm_extract.diff.same_form import given_away, only_ones
from ecm_extract.diff.same_line import same_lines
from ecm_extract.diff.same_stem import other_endings
from ecm_extract.diff.scores import score
from ecm_extract.diff.sent_frames import SentFrames
from ecm_extract.diff.settings import SettingFiles
from ecm_extract.diff.shared_parts import SharedParts
from ecm_extract.diff.sharing import by_sharers
from ecm_extract.diff.similarity import last_part
from ecm_extract.diff.still_there import Evidence, StillThere
from ecm_extract.diff.successors import stated_successor
from ecm_extract.diff.with_package import WithPackage


class Pairing:
    """The state of one pairing; `pairs` holds the decisions so far."""

    def __init__(self, old: Mapping[Key, Provision], new: Mapping[Key, Provision], evidence: Evidence) -> None:
        self.all_old, self.all_new, self.evidence = old, new, evidence
        self.old = {key: entity for key, entity in old.items() if key not in new}
        self.new = {key: entity for key, entity in new.items() if key not in old}
        self.pairs = [Pair(old[key], new[key]) for key in old if key in new]
        self.shared = by_sharers(new.values())
        self.owners: dict[str, str] = {}
        self.packages: dict[str, str] = {}
        self.homes: dict[str, str] = {}
        self.modules: dict[tuple[str, str], tuple[str, str]] = {}
        self.bases = Bases(new)
        self._parts = SharedParts(old.values(), new.values())
        self._packaged, self._sent = WithPackage(old, new), SentFrames(old, new)
        self._modules = {(key[0], key[1], key[2]) for key in new if key[0] in module_kinds()}
        self._owners = frozenset((key[1], key[2] or key[3]) for key in new)
        wholes = [kind for kind in containers() if not kinds()[kind].released]
        self._wholes = frozenset(key[3] for key in (*old, *new) if key[0] in wholes)

    def run(self) -> list[Pair]:
        """Return the pairs, then what is left as removed and added."""
        for kind in containers():
            self._moved({kind})
            self._renamed({kind})
            self._by_file(kind)
            self._learn(kind)
            self._with_their_package(kind)
        self._nodes()
        self._settings()
        self._follow()
        self._by_sharers()
        self._with_their_module()
        rest = set(kinds_that(lambda row: not (row.contains or row.runs or row.sets)))
        self._inherited()
        self._reshaped()
        self._endings()
        self._moved(rest)
        self._computed()
        self._successors()
        self._on_their_lines()
        self._renamed(rest)
        self._by_signature()
        hidden = HiddenNames(self.all_old.values(), self.all_new.values())
        still = StillThere(self.evidence, self.bases, self.owners, self._sent)
        pairs = [msgspec.structs.replace(pair, kept=True) if still.is_bound(pair.old) else pair for pair in self.pairs]
        lost = [entity for entity in self.old.values() if not still.is_there(entity)]
        removed = [Pair(entity, None, hidden_in=hidden.holder(entity, self._module_of(entity))) for entity in lost]
        return [*pairs, *removed, *(Pair(None, entity) for entity in self.new.values())]

    def take(self, pair: Pair) -> None:
        """Decide on a pair."""
        self.pairs.append(pair)
        if pair.old is not None:
            self.old.pop(pair.old.key, None)
        if pair.new is not None:
            self.new.pop(pair.new.key, None)

    def _by_file(self, kind: str) -> None:
        """What its file alone declared of a kind has moved with the file, however it is called now."""
        for found in list(alone_in_moved_files(kind, self.old.values(), self.new.values(), self.evidence.files)):
            old, new = found.old, found.new
            if old is not None and new is not None and new.key in self.new and self._is_taken(old, new):
                self.take(found)

    def _is_taken(self, old: Provision, new: Provision) -> bool:
        """Whether one may be the other, and its package has no other of its name: then a copy was made of it.

        A file that has another name in another package is one of its own while its package stays.
        """
        if old.row.is_file and self.packages.get(old.package, old.package) != new.package:
            return False
        names = (last_part(key[3]) for key in self.all_new if key[:2] == old.key[:2])
        return self._parts.may_be_one(old, new) and not (old.row.symbol and last_part(old.name) in names)

    def _nodes(self) -> None:
        """Nodes under another name, made by something else, or that a launch file no longer starts."""
        for found in list(node_pairs(self.old.values(), self.new.values(), self._known())):
            self.take(found)
        started = NoLongerStarted(self.all_old.values(), self.all_new.values())
        self.pairs += [Pair(entity, None) for entity in started.unnamed(self.packages)]
        for side in (self.old, self.new):
            for entity in list(side.values()):
                is_launched = entity.row.runs and entity.facet == LAUNCHED
                is_lost = is_launched and side is self.old and started.is_lost(entity, self._module_of(entity)[0])
                if entity.name == HOLE or (is_launched and not is_lost):
                    side.pop(entity.key)

    def _settings(self) -> None:
        """What parameter files set, in files that are on both sides."""
        files = SettingFiles(self.all_old, self.all_new, self.evidence.files)
        for found in list(files.pairs(self.old.values(), self.new.values())):
            self.take(found)
        for side in (self.old, self.new):
            for entity in list(side.values()):
                if entity.row.sets and files.is_one_sided(entity, side is self.old):
                    side.pop(entity.key)

    def _with_their_package(self, kind: str) -> None:
        """What a package offers goes with it under its new name."""
        if kinds()[kind].released:
            for found in list(self._packaged.pairs(self.old, self.new, self.packages)):
                self.take(found)

    def _by_sharers(self) -> None:
        """What a module has now by a line of another one is still its own."""
        for key, entity in list(self.old.items()):
            if key in self.shared:
                self.old.pop(key)
                self.pairs.append(Pair(entity, self.shared[key]))

    def _with_their_module(self) -> None:
        """What a module offers is what it was when the module or its package has another name."""
        known = self._known()
        likely = likely_homes(self.all_old.values(), self.all_new.values(), known)
        self.modules = likely | module_homes(self.pairs)
        offered = {**self.shared, **self.all_new}
        for entity in list(self.old.values()):
            if entity.is_of_module:
                package, owner = self._module_of(entity)
                keys = ((entity.kind, package, owner, name, entity.facet) for name in names_after(entity))
                target = next((offered[key] for key in keys if key in offered), None)
                if target is not None and is_ported(entity, target):
                    self.take(Pair(entity, target))

    def _module_of(self, old: Provision) -> tuple[str, str]:
        """Package and owner that a module has now."""
        place = old.package, old.owner
        owner = self.owners.get(old.owner, old.owner) if old.row.duty else old.owner
        return self.modules.get(place, (self.packages.get(old.package, old.package), owner))

    def _known(self) -> Successions:
        return Successions(self.packages, self.owners, self.evidence.files)

    def _learn(self, kind: str) -> None:
        for pair in self.pairs:
            if pair.old is None or pair.new is None or pair.old.kind != kind or pair.how == "same":
                continue
            names = self.packages if kinds()[kind].released else self.owners
            names[pair.old.name] = pair.new.name
            self.homes[pair.old.name] = pair.new.package

    def _follow(self) -> None:
        """Members of a container that moved or was renamed are the same members."""
        for key, entity in list(self.old.items()):
            kind, package, owner, name, facet = key
            if entity.row.part and owner in self.owners:
                home = self.owners[owner]
                others = (package, self.homes.get(owner, package), home.split("/")[0])
                wanted = {(kind, other, home, name, facet) for other in others}
                wanted |= {(kind, found.package, home, name, facet) for found in self.bases.named(home)}
                target = next((self.new[key] for key in wanted if key in self.new), None)
                if target is not None:
                    self.take(Pair(entity, target))
        for found in list(with_their_files(self.old.values(), self.new.values(), self.evidence.files)):
            self.take(found)

    def _inherited(self) -> None:
        """A method that is now in a base class of its class is still there."""
        for entity in list(self.old.values()):
            if entity.row.inherited:
                owner = self.owners.get(entity.owner, entity.owner)
                home = self.bases.provider(owner, entity.row.called, entity.name)
                if home is None and entity.name == entity.owner.rpartition("::")[2]:
                    home = self.bases.constructor(owner)
                if home is not None:
                    self.old.pop(entity.key)
                    self.pairs.append(Pair(entity, home))

    def _endings(self) -> None:
        """A header whose ending alone changed."""
        for found in list(other_endings(self.old.values(), self.all_new.values())):
            self.take(found)

    def _reshaped(self) -> None:
        """A parameter whose computed prefix is computed otherwise is the same parameter.

        So is one that a library declares for whoever uses it, when only a user of the library is gone.
        """
        index = values_by_place(self.all_new.values())
        for entity in list(self.old.values()):
            if entity.is_value:
                tail = tail_of(entity)
                places = ["/".join(self._module_of(entity)), f"{entity.package}/{GENERATED}"]
                if len(entity.chain) > 1 or (entity.kind, entity.package, entity.owner) not in self._modules:
                    places.append(self.evidence.files.get(entity.path, entity.path))
                alike = (other for place in places for other in index.get((place, tail), ()))
                found = next((other for other in alike if is_reshaped(entity, other) and _may_be(entity, other)), None)
                if found is not None:
                    self.take(Pair(entity, found))

    def _computed(self) -> None:
        """A name that the other side computes is still there."""
        computed = Computed(self.all_new.values())
        for entity in list(self.old.values()):
            found = computed.home(entity, *self._module_of(entity))
            if found is not None:
                self.take(Pair(entity, found))

    def _moved(self, wanted: set[str]) -> None:
        index: dict[tuple[str, str, str], list[Provision]] = defaultdict(list)
        for entity in self.new.values():
            if entity.kind in wanted:
                index[move_key(entity)].append(entity)
        files, before = self.evidence.files, self.evidence.before
        places = Places(files, self.packages, self._same_module, before, self._owners, self._wholes)
        for entity in list(self.old.values()):
            if entity.kind not in wanted:
                continue
            homes = [other for other in index.get(move_key(entity), ()) if other.key in self.new]
            if entity.row.layout:  # what makes the bytes of a message is of no other one
                homes = [other for other in homes if other.owner == self.owners.get(entity.owner, entity.owner)]
            found = best_home(entity, homes, places)
            if found is not None:
                self.take(found)

    def _same_module(self, old: Provision, new: Provision) -> bool:
        """Whether the module that had it still exists: then its new owner is only another view of one file."""
        return old.package == new.package and (old.kind, old.package, old.owner) in self._modules

    def _successors(self) -> None:
        """What an old name's own deprecation names as its successor is the new name, though both lived side by side."""
        for entity in list(self.old.values()):
            found = stated_successor(entity, self.all_new)
            if found is not None:
                self.old.pop(entity.key)
                self.new.pop(found.key, None)
                reason = f"its deprecation at the old ref names the successor: {entity.deprecated}"
                self.pairs.append(Pair(entity, found, "renamed", 0.95, reason[:300]))

    def _on_their_lines(self) -> None:
        """What stands in the very line of an old name is that, however it is called."""
        for found in list(same_lines(self.old.values(), self.new.values(), self.evidence.files)):
            old, new = found.old, found.new
            if old is None or new is None or not old.row.part or self.owners.get(old.owner, old.owner) == new.owner:
                self.take(found)

    def _renamed(self, wanted: set[str]) -> None:
        groups: dict[object, tuple[list[Provision], list[Provision]]] = defaultdict(lambda: ([], []))
        for side, entities in enumerate((self.old, self.new)):
            for entity in entities.values():
                if entity.kind in wanted:
                    groups[self._neighbourhood(entity, old=side == 0)][side].append(entity)
        for found in list(self._parts.twins(groups.values())):
            self.take(found)
        for before, after in groups.values():
            self._assign(
                [each for each in before if each.key in self.old], [each for each in after if each.key in self.new]
            )

    def _by_signature(self) -> None:
        """A method whose name alone changed is the one with its very signature."""
        for pair, better in list(given_away(self.pairs, self.new.values())):
            self.pairs.remove(pair)
            self.take(better)
            if pair.new is not None:
                self.new[pair.new.key] = pair.new
        for found in list(only_ones(self.old.values(), self.new.values(), self.evidence.history)):
            self.take(found)

    def _neighbourhood(self, entity: Provision, old: bool) -> object:
        package = self.packages.get(entity.package, entity.package) if old else entity.package
        owner = self.owners.get(entity.owner, entity.owner) if old else entity.owner
        if entity.row.part:
            return entity.kind, package, owner, entity.facet
        return entity.kind, package if not entity.row.released else "", entity.facet

    def _assign(self, before: list[Provision], after: list[Provision]) -> None:
        if not before or not after:
            return
        one = set(kin(self.pairs))
        scores: dict[tuple[int, int], float] = {}
        reasons: dict[tuple[int, int], str] = {}
        for row, old in enumerate(before):
            for column, new in enumerate(after):
                if not self._parts.may_be_one(old, new) or is_hidden_in(old, new):
                    continue
                known = may_be_of(old, new) or (old.owner, new.owner) in one
                found = score(old, new, self.evidence.files, self.evidence.history, known)
                if found is not None:
                    scores[row, column], reasons[row, column] = found
        for row, column in assign(scores):
            confidence = round(min(0.99, scores[row, column]), 2)
            how: How = "moved" if before[row].name == after[column].name else "renamed"
            self.take(Pair(before[row], after[column], how, confidence, reasons[row, column]))


def _may_be(old: Provision, new: Provision) -> bool:
    """A full name that another module has as well, on another line, is that module's own."""
    return old.name != new.name or old.owner == new.owner or bool(old.chain[1:])
