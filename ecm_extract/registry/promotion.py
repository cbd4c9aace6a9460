"""The way of a release: from channel to channel, deprecated before it is withdrawn, never without a trace."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from ecm_checker.profiles import NO_PROFILES, Profiles
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry import audit, clock
from ecm_extract.registry.channels import Table
from ecm_extract.registry.evidence import evidence_of
from ecm_extract.registry.gates import Verdict, Waiver, judge
from ecm_extract.registry.matter import Inputs, in_channel, scope_ids
from ecm_extract.registry.migration_documents import migration_of_release
from ecm_extract.registry.releases import find_release, name_of, newest_ids, release_before
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Release, Running, Standing, VerdictRow, WaiverRow


def promote(session: Session, spec: str, channel: str, table: Table, profiles: Profiles = NO_PROFILES) -> Verdict:
    """Judge a release that is to go one channel up, keep the verdict, and let it go when all gates agree.

    Args:
        session: one that writes.
        spec: the release.
        channel: where it is to go: the one above its own.
        table: of channels and gates.
        profiles: of the robot and its governance.

    Raises:
        InputError: there is no such release or channel, or it is not the next one.
    """
    release = find_release(session, spec)
    standing = session.get_one(Standing, release.id)
    _require_step(release, standing, channel, table)
    at = clock.written(clock.now())
    inputs = _inputs(session, release, standing, Submitted(channel, table, profiles, at))
    verdict = judge(session, inputs, _waivers(session, release, channel), table)
    _keep(session, release, verdict)
    if verdict.passed:
        standing.channel, standing.since = channel, at
    return verdict


class Submitted(msgspec.Struct, frozen=True):
    """What a release is submitted to, and when."""

    channel: str
    table: Table
    profiles: Profiles
    at: str


def _inputs(session: Session, release: Release, standing: Standing, submitted: Submitted) -> Inputs:
    target = _target(session, release, submitted)
    previous = target if target is not None else _id_before(session, release)
    evidence = evidence_of(session, release.id)
    return Inputs(
        release=release.id,
        digest=release.digest,
        previous=previous,
        source=standing.channel or "",
        channel=submitted.channel,
        since=standing.since,
        scope=scope_ids(session, _scope(session, submitted)),
        target=target,
        evidence=in_channel(evidence, standing.since),
        migration=migration_of_release(session, release.id),
        embodiment=submitted.profiles.embodiment,
        policy=submitted.profiles.policy,
        at=submitted.at,
    )


def _scope(session: Session, submitted: Submitted) -> Scope:
    above = _from(submitted.table, submitted.channel)
    return Scope("", tuple(session.scalars(newest_ids(Standing.channel.in_(above)))))


def _from(table: Table, channel: str) -> list[str]:
    names = list(table.channels)
    return names[names.index(channel) :]


def _target(session: Session, release: Release, submitted: Submitted) -> int | None:
    """The newest older release that is in the channel, or above."""
    query = (
        select(Release.id)
        .join(Standing, Standing.release_id == Release.id)
        .where(Release.package == release.package, Release.rank < release.rank, Standing.withdrawn.is_(None))
        .where(Standing.channel.in_(_from(submitted.table, submitted.channel)))
    )
    return session.scalars(query.order_by(Release.rank.desc()).limit(1)).first()


def _id_before(session: Session, release: Release) -> int | None:
    """Where nothing older is in the channel, the release is compared with the one before it, wherever that is."""
    previous = release_before(session, release)
    return previous.id if previous is not None else None


def _require_step(release: Release, standing: Standing, channel: str, table: Table) -> None:
    table.require_channel(channel)
    names = list(table.channels)
    if standing.withdrawn is not None:
        message = f"{name_of(release)} is withdrawn since {standing.withdrawn}"
        raise InputError(message, "release a new version")
    here = names.index(standing.channel) if standing.channel in names else -1
    if names.index(channel) != here + 1:
        message = f"{name_of(release)} is in {standing.channel} and cannot go to {channel}"
        hint = f"the next channel is {names[here + 1]}" if here + 1 < len(names) else "it is in the highest one"
        raise InputError(message, f"{hint}; `ecm-extract demote` leads back")


def _keep(session: Session, release: Release, verdict: Verdict) -> None:
    channel, document = verdict.inputs.channel, msgspec.json.encode(verdict, order="deterministic").decode()
    row = VerdictRow(
        release_id=release.id, channel=channel, at=verdict.inputs.at, passed=verdict.passed, document=document
    )
    session.add(row)
    refused = [each.gate for each in verdict.gates if each.state == "refused"]
    waived = [each.gate for each in verdict.gates if each.state == "waived"]
    audit.append(session, "promote", name_of(release), {"to": channel, "refused": refused, "waived": waived})


def verdicts(session: Session, spec: str) -> list[Verdict]:
    """Return what the gates said of a release, oldest first."""
    release = find_release(session, spec)
    rows = session.scalars(select(VerdictRow).filter_by(release_id=release.id).order_by(VerdictRow.id))
    return [msgspec.json.decode(row.document, type=Verdict) for row in rows]


def waive(session: Session, spec: str, channel: str, waiver: Waiver) -> str:
    """Keep that somebody answers for a gate, and return the release; the promotion that follows names them.

    Raises:
        InputError: there is no such release, or the waiver has no reason, name or end.
    """
    release = find_release(session, spec)
    if not waiver.name.strip() or not waiver.reason.strip():
        message = "a waiver needs a name and a reason"
        raise InputError(message)
    if waiver.ends <= clock.written(clock.now()):
        message = f"the waiver ended already on {waiver.ends}"
        raise InputError(message, "name a day that is to come")
    fields = msgspec.structs.asdict(waiver)
    session.add(WaiverRow(release_id=release.id, channel=channel, **fields))
    audit.append(session, "waive", name_of(release), {"to": channel, **fields})
    return name_of(release)


def _waivers(session: Session, release: Release, channel: str) -> Sequence[Waiver]:
    rows = session.scalars(select(WaiverRow).filter_by(release_id=release.id, channel=channel).order_by(WaiverRow.id))
    return [Waiver(row.gate, row.name, row.reason, row.ends) for row in rows]


def demote(session: Session, spec: str, channel: str, reason: str, table: Table) -> str:
    """Lead a release back to a lower channel, and return it.

    Raises:
        InputError: there is no such release or channel, or the channel is not below its own.
    """
    release = find_release(session, spec)
    standing = session.get_one(Standing, release.id)
    table.require_channel(channel)
    names = list(table.channels)
    if standing.channel not in names or names.index(channel) >= names.index(standing.channel):
        message = f"{name_of(release)} is in {standing.channel or 'no channel'}; {channel} is not below it"
        raise InputError(message)
    detail = {"from": standing.channel, "to": channel, "reason": reason}
    standing.channel, standing.since = channel, audit.append(session, "demote", name_of(release), detail)
    return name_of(release)


def deprecate(session: Session, spec: str, reason: str, successor: str | None) -> str:
    """Announce that a release goes away, and return it.

    Raises:
        InputError: it, or its successor, is not stored, or it is withdrawn already.
    """
    release = find_release(session, spec)
    standing = session.get_one(Standing, release.id)
    if standing.withdrawn is not None:
        message = f"{name_of(release)} is withdrawn since {standing.withdrawn}"
        raise InputError(message)
    heir = name_of(find_release(session, successor)) if successor else None
    detail = {"reason": reason, "successor": heir}
    standing.deprecated = audit.append(session, "deprecate", name_of(release), detail)
    standing.reason, standing.successor = reason, heir
    return name_of(release)


def withdraw(session: Session, spec: str) -> str:
    """Take a deprecated release out of all channels, and return it; its contract stays.

    Raises:
        InputError: it was not deprecated for a release cycle, or something runs it still.
    """
    release = find_release(session, spec)
    standing = session.get_one(Standing, release.id)
    _require_cycle(session, release, standing)
    at = audit.append(session, "withdraw", name_of(release), {"channel": standing.channel})
    standing.withdrawn, standing.channel = at, None
    return name_of(release)


def _require_cycle(session: Session, release: Release, standing: Standing) -> None:
    if standing.withdrawn is not None:
        message = f"{name_of(release)} is withdrawn since {standing.withdrawn}"
        raise InputError(message)
    if standing.deprecated is None:
        message = f"{name_of(release)} is not deprecated"
        raise InputError(message, "deprecate it, and withdraw it after the next release of its package")
    since = select(Release.id).where(Release.package == release.package, Release.stored > standing.deprecated)
    if session.scalars(since.limit(1)).first() is None:
        message = f"no release of {release.package} came since {name_of(release)} was deprecated"
        raise InputError(message, "a release is withdrawn one release cycle after its deprecation at the earliest")
    runs = session.scalars(select(Running.environment).filter_by(release_id=release.id).order_by(Running.environment))
    environments = runs.all()
    if environments:
        message = f"{name_of(release)} runs on {', '.join(environments)}"
        raise InputError(message, "upgrade these, and record it with `ecm-extract registry record`")
