"""Pairs of entities, and what a comparison gives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Literal

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Finding
from ecm_checker.hub.provision import Provision
from ecm_checker.release import Change, CompatibilityClass
from ecm_checker.versions import Bump

from ecm_extract.diff.unread import UnreadPart

How = Literal["same", "moved", "renamed"]


class Pair(msgspec.Struct, frozen=True):
    """An entity before and after.

    Attributes:
        old: None when it was added. new: None when it was removed.
        how: why the two are one.
        confidence: 0 to 1. reason: for people, empty for the same key.
        kept: whether the old name still stands for it.
        hidden_in: what of the new side may be what is gone, by a pattern, or a node that may declare it.
    """

    old: Provision | None
    new: Provision | None
    how: How = "same"
    confidence: float = 1.0
    reason: str = ""
    kept: bool = False
    hidden_in: Provision | None = None


class Located(msgspec.Struct, frozen=True):
    """A change with the entities that it is about, which consumers' uses are matched to.

    `others` are those of other modules that have the very name by the very line, and that it stands for as well.
    """

    change: Change
    pair: Pair
    others: tuple[Pair, ...] = ()

    @property
    def each(self) -> Iterator[Located]:
        """The change as one of each of its pairs."""
        yield self
        yield from (Located(self.change, pair) for pair in self.others)

    @property
    def packages(self) -> frozenset[str]:
        """Packages that have what changed, besides the one that the change names."""
        entities = (entity for pair in (self.pair, *self.others) for entity in (pair.old, pair.new))
        return frozenset(entity.package for entity in entities if entity is not None) | {self.change.package}


class RefInfo(msgspec.Struct, frozen=True):
    """One side as the user named it, and its commit.

    `why` tells how a default was chosen, `uncommitted` that files of the work tree are not those of the commit.
    """

    ref: str
    commit: str | None
    why: str = ""
    uncommitted: bool = False


class Verdict(msgspec.Struct, frozen=True):
    """What is known of a release.

    Attributes:
        compatibility_class: of its changes; `unknown` where none of them breaks and not all could be read.
        required_bump: the step that it needs, the least one where it is not complete.
        declared_bump: the step that it takes; None where it cannot be read.
        complete: whether everything that can carry interfaces was read on both sides.
    """

    compatibility_class: CompatibilityClass | Literal["unknown"]
    required_bump: Bump
    declared_bump: Bump | None
    complete: bool = True


class PackageVerdict(msgspec.Struct, frozen=True):
    """The verdict on one package, with its versions."""

    package: str
    old_version: str | None
    new_version: str | None
    verdict: Verdict


class Comparison(msgspec.Struct, frozen=True):
    """Everything that `diff` says.

    Attributes:
        repo: name of the repository. old, new: the sides.
        changes: most breaking first, grouped by package.
        findings: VER001, one per cause.
        verdict: of the repository. packages: of each package that changed.
        unread: what was not read, what limits the verdict first.
        computed: how many names of endpoints are computed, so that no change of them can be seen.
        accepted: fingerprints that a person has answered.
        homes: folder of the consumer, as it was named, that a line of a finding stands in.
    """

    repo: str
    old: RefInfo
    new: RefInfo
    changes: tuple[Change, ...]
    findings: tuple[Finding, ...]
    verdict: Verdict
    packages: tuple[PackageVerdict, ...] = ()
    unread: tuple[UnreadPart, ...] = ()
    accepted: frozenset[str] = frozenset()
    homes: Mapping[Evidence, str] = {}
