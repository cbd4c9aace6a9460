"""Changes that can break somebody, by kind."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

from ecm_extract.diff.model import Located
from ecm_extract.entities.model import Key, PublicEntity
from ecm_extract.entities.side import Side

GONE = frozenset({"removed", "renamed", "moved"})
_SECOND = frozenset({"type_changed", "default_changed", "signature_changed"})
"""What else changed of a name that is gone: who used the name has that one cause."""


class ChangeIndex:
    """What the matchers look up.

    Attributes:
        old, new: the two sides.
    """

    def __init__(self, located: Iterable[Located], old: Side, new: Side) -> None:
        self.old, self.new = old, new
        self._by_kind: dict[str, list[Located]] = defaultdict(list)
        self._by_name: dict[tuple[str, str], list[Located]] = defaultdict(list)
        self._added: dict[str, list[Located]] = defaultdict(list)
        self._layouts: dict[str, Located] = {}
        for entry in located:
            self._note_layout(entry)
            entity = entry.pair.old
            if entity is None and entry.change.breaking:
                self._added[entry.change.kind].append(entry)
            if entity is None or not (entry.change.breaking or entry.change.change == "deprecated"):
                continue
            if entry.pair.how != "same" and entry.change.change in _SECOND:
                continue
            self._by_kind[entry.change.kind].append(entry)
            self._by_name[entity.kind, entity.name].append(entry)

    def _note_layout(self, entry: Located) -> None:
        """The first change of each type that alters its bytes; it stands for the others."""
        entity = entry.pair.old or entry.pair.new
        if entity is None or not entry.change.breaking:
            return
        if entity.kind == "message_field":
            self._layouts.setdefault(entity.owner, entry)
        elif entity.kind == "message" and entry.change.change == "signature_changed":
            self._layouts.setdefault(entity.name, entry)

    def layout_of(self, name: str) -> Located | None:
        """Return a change that alters the layout of an interface; None when it is as it was."""
        return self._layouts.get(name)

    def of_kind(self, kind: str) -> Sequence[Located]:
        """Return the changes of a kind of entity."""
        return self._by_kind.get(kind, ())

    def additions(self, kind: str) -> Sequence[Located]:
        """Return the additions of a kind that break who does not know of them."""
        return self._added.get(kind, ())

    def named(self, kind: str, name: str) -> Sequence[Located]:
        """Return the changes of an entity by its old name."""
        return self._by_name.get((kind, name), ())

    def is_empty(self) -> bool:
        """Whether nothing can break."""
        return not self._by_kind and not self._added

    def offered(self, kind: str, facet: str) -> Iterable[PublicEntity]:
        """Return what the new side offers of a kind and facet."""
        return (entity for entity in self.new.entities.values() if (entity.kind, entity.facet) == (kind, facet))

    def lives(self, key: Key) -> bool:
        """Whether an entity is still there under its old key."""
        return key in self.new.entities
