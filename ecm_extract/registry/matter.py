"""What gates stand on: everything that is known of a release when it is judged, so that it can be judged again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import msgspec
from ecm_checker.contract import Contract
from ecm_checker.contract_changes import changes as contract_changes
from ecm_checker.fields import runs_by_itself
from ecm_checker.hub.package import Package
from ecm_checker.operations.engine import ready
from ecm_checker.profiles import Embodiment, Policy, Profiles
from ecm_checker.release import Change, CompatibilityClass, compatibility_class, required_bump
from ecm_checker.versions import Bump, bump_between
from ecm_checker.wire import EvidenceKind
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.diff.migration import Migration
from ecm_extract.registry import clock
from ecm_extract.registry.evidence import Kept, contents_of, evidence_of
from ecm_extract.registry.impact import Impact, impact_of
from ecm_extract.registry.proof import Proof, proof_of, words_that_count
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.sides import stored_side_of
from ecm_extract.registry.tables import Release


class Inputs(msgspec.Struct, frozen=True, kw_only=True):
    """What a verdict was made of; each of it is stored, or stands here.

    Attributes:
        release, previous: ids; `previous` is what it takes the place of: the newest older release of the channel or
            above, else the one before it; None for the first release of a package. digest: of the release's document.
        source, channel: from which channel to which. since: when it came to the first of them.
        scope: ids of the releases that may not break. target: the release to roll back to.
        evidence: digests. migration: None where it has none.
        embodiment, policy: profiles that were given.
        at: when.
    """

    release: int
    digest: str
    previous: int | None
    source: str
    channel: str
    since: str
    scope: tuple[int, ...]
    target: int | None
    evidence: tuple[str, ...]
    migration: Migration | None
    embodiment: Embodiment | None
    policy: Policy | None
    at: str


class Matter:
    """A release as demands look at it.

    Attributes:
        inputs: what it is made of.
        package: the release. previous: the one before it; None for the first.
        evidence: that was collected in the channel that it comes from, oldest first.
        impact: what breaks in the channel that it goes to; None for the first release.
    """

    def __init__(self, session: Session, inputs: Inputs) -> None:
        release = session.get_one(Release, inputs.release)
        after = stored_side_of(session, release)
        self.inputs = inputs
        self._session = session
        self.package = after.package
        self.previous: Package | None = None
        self.impact: Impact | None = None
        if inputs.previous is not None:
            before = stored_side_of(session, session.get_one(Release, inputs.previous))
            self.previous = before.package
            self.impact = impact_of(session, before, after, Scope(f"what is in {inputs.channel}", inputs.scope))
        kept = evidence_of(session, release.id)
        self.evidence = [each for each in kept if each.digest in inputs.evidence]
        self._contents = contents_of(session, release)
        self.target = session.get(Release, inputs.target) if inputs.target is not None else None

    @property
    def profiles(self) -> Profiles:
        """Of the robot and its governance."""
        return Profiles(self.inputs.embodiment, self.inputs.policy)

    @cached_property
    def changes(self) -> tuple[Change, ...]:
        """Changes of public names, then those of contracts beside them."""
        return (*self.named_changes, *self._contract_changes())

    @property
    def named_changes(self) -> tuple[Change, ...]:
        """Changes of public names, as `diff` tells them."""
        return self.impact.changes if self.impact is not None else ()

    def _contract_changes(self) -> Iterator[Change]:
        """Resources, permissions and recovery: what no name shows."""
        if self.previous is None:
            return
        before = {each.ecm.module_id: each for each in self.previous.contracts()}
        for contract in self.package.contracts():
            old = before.get(contract.ecm.module_id)
            if old is None:
                yield from _brought(contract)
            else:
                found = contract_changes(ready(old), ready(contract))
                yield from (each for each in found if each.dimension != "signature")

    @property
    def new_permissions(self) -> list[Change]:
        """Permissions that it asks for and that the release before did not; of a first release all are new."""
        if self.previous is not None:
            return self.breaking("permissions")
        found = (change for each in self.package.contracts() for change in _brought(each))
        return [each for each in found if each.dimension == "permissions"]

    @property
    def compatibility_class(self) -> CompatibilityClass:
        """The class of the release."""
        return compatibility_class(self.changes)

    @property
    def required(self) -> Bump:
        """The least step of its version."""
        return required_bump(self.changes)

    @property
    def declared(self) -> Bump | None:
        """The step that it takes; None when a version cannot be read."""
        return bump_between(self.previous.version, self.package.version) if self.previous is not None else None

    def breaking(self, dimension: str) -> list[Change]:
        """Return the changes of a dimension that may invalidate what was built on the release before."""
        return [each for each in self.changes if each.breaking and each.dimension == dimension]

    def proof(self, kind: EvidenceKind) -> Proof:
        """Return what the evidence of a kind proves."""
        found = (each for each in self.evidence if each.evidence.kind == kind)
        return proof_of(found, self._contents, self._running)

    @property
    def contradictions(self) -> tuple[Kept, ...]:
        """Observations that contradict its contract, whatever they were made for."""
        observed = [each for each in self.evidence if each.evidence.is_observed]
        return tuple(each for each in words_that_count(observed) if each.evidence.result == "contradicted")

    @cached_property
    def _running(self) -> frozenset[str]:
        """Its modules that run."""
        return frozenset(each.ecm.module_id for each in self.package.contracts() if runs_by_itself(each.ecm.kind))


def _brought(contract: Contract) -> Iterator[Change]:
    """Permissions and resources that come with a module that was not there."""
    empty = Contract(contract.ecm)
    found = contract_changes(ready(empty), ready(contract))
    yield from (each for each in found if each.dimension in {"permissions", "resources"})


def in_channel(found: Sequence[Kept], since: str) -> tuple[str, ...]:
    """Return the digests of evidence that was collected since a release is in its channel."""
    start = clock.read(since)
    return tuple(each.digest for each in found if each.time >= start)


def scope_ids(session: Session, scope: Scope) -> tuple[int, ...]:
    """Return the releases of a scope, to be looked at again later."""
    return tuple(session.scalars(select(Release.id).where(Release.id.in_(scope.query())).order_by(Release.id)))
