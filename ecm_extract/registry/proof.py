"""What evidence proves of a release.

Of each witness the newest word on each module counts. What one of them contradicts, only they take back; a doubt takes
back what was confirmed and no contradiction, and what was not seen says nothing. A record confirms the content that it
names and no other one under the same version, and when something of the contract was seen at all.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

import msgspec
from ecm_checker.wire import EvidenceRecord
from msgspec import UNSET

from ecm_extract.registry.evidence import Kept, in_time, names_content


class Proof(msgspec.Struct, frozen=True):
    """What records of one kind prove.

    Attributes:
        confirmed: that confirm this content. against: that contradict. doubtful: the other ones that count.
        elsewhere: that confirm another content. unproved: modules that nothing confirms; none when the package is
            confirmed as a whole.
    """

    confirmed: tuple[Kept, ...]
    against: tuple[Kept, ...]
    doubtful: tuple[Kept, ...]
    elsewhere: tuple[Kept, ...]
    unproved: tuple[str, ...]

    @property
    def holds(self) -> bool:
        """Whether all of the release is confirmed, and nobody contradicts."""
        return bool(self.confirmed) and not self.against and not self.unproved


def proof_of(kept: Iterable[Kept], contents: Mapping[str | None, str], running: Collection[str]) -> Proof:
    """Return what records prove.

    Args:
        kept: records of one kind, oldest first.
        contents: of the release, see `contents_of`.
        running: its modules that run, each of which must be confirmed when the package is not as a whole.
    """
    counting = words_that_count(kept)
    said = [each for each in counting if each.evidence.result == "confirmed" and not _saw_nothing(each.evidence)]
    confirmed = [each for each in said if names_content(each.evidence, contents)]
    about = {each.evidence.subject.module_id for each in confirmed}
    return Proof(
        confirmed=tuple(confirmed),
        against=tuple(each for each in counting if each.evidence.result == "contradicted"),
        doubtful=tuple(each for each in counting if _is_doubtful(each.evidence)),
        elsewhere=tuple(each for each in said if each not in confirmed),
        unproved=() if None in about else tuple(sorted(set(running) - about)),
    )


def _saw_nothing(record: EvidenceRecord) -> bool:
    """Whether a contract was compared with nothing: its node was there, and none of its endpoints was seen."""
    return record.promised is not UNSET and not record.seen


def _is_doubtful(record: EvidenceRecord) -> bool:
    return record.result == "doubtful" or (record.result == "confirmed" and _saw_nothing(record))


def words_that_count(kept: Iterable[Kept]) -> list[Kept]:
    """Return of each witness the word on each module that counts, oldest first."""
    found: dict[tuple[str, str | None], Kept] = {}
    for each in kept:
        who = witness_of(each.evidence), each.evidence.subject.module_id
        if _takes_the_place(each, found.get(who)):
            found[who] = each
    return sorted(found.values(), key=in_time)


def _takes_the_place(new: Kept, old: Kept | None) -> bool:
    if new.evidence.result in {"confirmed", "contradicted"}:
        return True
    return new.evidence.result == "doubtful" and (old is None or old.evidence.result != "contradicted")


def witness_of(record: EvidenceRecord) -> str:
    """Return the name of a witness as it is compared: who writes it with other capitals or spaces is the same."""
    return " ".join(record.by.name.casefold().split())


def witnesses(kept: Sequence[Kept]) -> dict[str, str]:
    """Return the names of witnesses, by the form in which they are compared."""
    return {witness_of(each.evidence): each.evidence.by.name for each in kept}
