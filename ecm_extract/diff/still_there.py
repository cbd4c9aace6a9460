"""What no declaration shows any more and is there all the same: read, set by its name, handed on, or made by others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from ecm_checker.hub.provision import SENT, Provision
from ecm_checker.match.hierarchy import Bases

from ecm_extract.diff.history import History
from ecm_extract.diff.sent_frames import SentFrames

_CONSTRUCTOR: Final = "__init__"


@dataclass(slots=True)
class Evidence:
    """What helps to decide beside the entities.

    Attributes:
        files: new path of each file that moved, by its old one. history: what people wrote.
        bound, quoted, reads: of the new side; see `Side`. before: paths of the old side.
    """

    files: Mapping[str, str] = field(default_factory=dict)
    history: History | None = None
    bound: frozenset[str] = frozenset()
    quoted: frozenset[str] = frozenset()
    reads: frozenset[tuple[str, str]] = frozenset()
    before: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class StillThere:
    """Asks the new side for old names that have no partner.

    Attributes:
        evidence: see there. bases: classes of the new side. owners: new name of each class.
        sent: frames that programs send.
    """

    evidence: Evidence
    bases: Bases
    owners: Mapping[str, str]
    sent: SentFrames

    def is_bound(self, entity: Provision | None) -> bool:
        """Whether Python still offers something that is declared elsewhere (`Old = New`), or stands in such a class."""
        if entity is None:
            return False
        if entity.row.in_language and not entity.row.part:
            return entity.name in self.evidence.bound
        return entity.owner in self.evidence.bound and entity.owner not in self.owners

    def is_there(self, entity: Provision) -> bool:
        """Whether what no declaration shows any more is still read, or set by its name."""
        if self.is_bound(entity) or (entity.facet == SENT and self.sent.may_be_there(entity)):
            return True
        if entity.is_value:
            return (entity.package, entity.name.lstrip("~/")) in self.evidence.reads
        if entity.name == _CONSTRUCTOR and self.bases.is_open(self.owners.get(entity.owner, entity.owner)):
            return True  # what decorates the class may write one
        if not entity.row.fixed or not entity.is_python:
            return False
        modules = (entity.owner, entity.owner.rpartition(".")[0])
        return any(f"{module}.{entity.name}" in self.evidence.quoted for module in modules)
