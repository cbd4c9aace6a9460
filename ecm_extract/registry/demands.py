"""What gates may demand of a release, each by its name in the table of gates."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Final

import msgspec
from ecm_checker.case import Case
from ecm_checker.contract import Contract
from ecm_checker.fields import missing_fields
from ecm_checker.finding import Dimension
from ecm_checker.operations.engine import examine, ready
from ecm_checker.versions import BUMPS
from ecm_checker.wire import EvidenceKind

from ecm_extract.diff.migration import uncovered
from ecm_extract.registry.evidence import Kept
from ecm_extract.registry.impact import Impact
from ecm_extract.registry.matter import Matter
from ecm_extract.registry.proof import Proof, witnesses
from ecm_extract.registry.releases import name_of

_SHOWN: Final = 3


class Answer(msgspec.Struct, frozen=True):
    """What a demand says: whether it is met, why, and the evidence that it stands on, by digest."""

    met: bool
    reason: str
    evidence: tuple[str, ...] = ()


def _complete_contract(matter: Matter) -> Answer:
    if matter.package.gaps:
        told = _listed(f"{each.path} ({each.reason})" for each in matter.package.gaps)
        return Answer(False, f"not all of it could be read: {told}")
    gaps = [f"{each.ecm.module_id} lacks {', '.join(lacking)}" for each, lacking in _incomplete(matter)]
    against = matter.contradictions
    if against:
        told = _listed(each.evidence.subject.module_id or matter.package.name for each in against)
        return Answer(False, f"when it was observed, its contract was contradicted: {told}", _digests(against))
    return Answer(not gaps, _listed(gaps) or "all required fields are filled")


def _incomplete(matter: Matter) -> list[tuple[Contract, tuple[str, ...]]]:
    found = ((each, missing_fields(each)) for each in matter.package.contracts())
    return [(each, lacking) for each, lacking in found if lacking]


def _version_step(matter: Matter) -> Answer:
    if matter.previous is None:
        return Answer(True, "it is the first release of its package")
    if matter.declared is None:
        return Answer(False, f"the step from {matter.previous.version} to {matter.package.version} cannot be read")
    enough = BUMPS.index(matter.declared) >= BUMPS.index(matter.required)
    return Answer(enough, f"its changes need {matter.required}, its version takes {matter.declared}")


def _migration(matter: Matter) -> Answer:
    if matter.compatibility_class != "breaking":
        return Answer(True, f"it is {matter.compatibility_class}")
    if matter.inputs.migration is None:
        return Answer(False, "it is breaking and brings no migration")
    left = [f"{each.kind} {each.old or each.new}" for each in uncovered(matter.inputs.migration, matter.named_changes)]
    return Answer(not left, f"its migration does not tell of {_listed(left)}" if left else "its migration tells all")


def _nobody_breaks(matter: Matter) -> Answer:
    if matter.impact is None:
        return Answer(True, "it is the first release of its package")
    broken = matter.impact.broken
    where = matter.impact.scope
    if not broken and not matter.impact.is_whole:
        return Answer(False, f"nobody is known to break of {where}, and not all is known: {_unknown(matter.impact)}")
    return Answer(not broken, f"of {where} it breaks {_listed(broken)}" if broken else f"nobody breaks of {where}")


def _unknown(impact: Impact) -> str:
    doubts = [f"{each.release} {each.path} {each.why}" for each in impact.doubts]
    return _listed([*(f"{name} is not stored" for name in impact.missing), *doubts])


def _new_permissions_reviewed(matter: Matter) -> Answer:
    asked = matter.new_permissions
    if not asked:
        return Answer(True, "it asks for no new permission")
    return _shown(matter, "policy_review", f"it asks for {_listed([each.new or '' for each in asked])}")


def _policy_reviewed(matter: Matter) -> Answer:
    return _shown(matter, "policy_review", "its permissions must be reviewed")


def _second_reviewer(matter: Matter) -> Answer:
    found = matter.proof("policy_review").confirmed
    names = sorted(witnesses(found).values())
    return Answer(len(names) > 1, f"reviewed by {_listed(names) or 'nobody'}; two must", _digests(found))


def _policy_given(matter: Matter) -> Answer:
    given = matter.inputs.policy is not None
    return Answer(given, "it is judged by a policy" if given else "no policy was given to judge it by (--policy)")


def _policy_allows(matter: Matter) -> Answer:
    return _allowed(matter, "permissions", "policy", given=matter.inputs.policy is not None)


def _robot_has_resources(matter: Matter) -> Answer:
    wanted = [each.ecm.module_id for each in matter.package.contracts() if _needs_resources(each)]
    if wanted and matter.inputs.embodiment is None:
        return Answer(False, f"no robot was given that has what {_listed(wanted)} need (--embodiment)")
    return _allowed(matter, "resources", "embodiment", given=matter.inputs.embodiment is not None)


def _needs_resources(contract: Contract) -> bool:
    wanted = contract.resources
    fields = (wanted.sensors, wanted.actuators, wanted.compute, wanted.timing)
    return any(each is not None and each.value for each in fields)


def _allowed(matter: Matter, dimension: Dimension, profile: str, *, given: bool) -> Answer:
    """What `check install` says of its modules."""
    if not given:
        return Answer(True, f"not asked: no {profile} was given (--{profile})")
    cases = (Case((ready(each),), matter.profiles) for each in matter.package.contracts())
    found = [each for case in cases for each in examine("install", case, (dimension,))]
    wrong = [each.message for each in found if each.severity == "error" or each.certainty == "unknown"]
    return Answer(not wrong, _listed(wrong) or f"the {profile} allows it")


def _resources_revalidated(matter: Matter) -> Answer:
    return _revalidated(matter, "resources")


def _recovery_revalidated(matter: Matter) -> Answer:
    return _revalidated(matter, "recovery")


def _revalidated(matter: Matter, dimension: Dimension) -> Answer:
    changed = [each.new or each.old or "" for each in matter.breaking(dimension)]
    if not changed:
        return Answer(True, f"its {dimension} are as before" if dimension == "resources" else "it recovers as before")
    return _shown(matter, "validation", f"it changed {_listed(changed)}")


def _upgrade_tested(matter: Matter) -> Answer:
    if matter.previous is None:
        return Answer(True, "it is the first release of its package")
    return _shown(matter, "upgrade_test", f"the upgrade from {matter.previous.version} must be tested")


def _rollback_recommended(matter: Matter) -> Answer:
    missing = _rollback_target(matter)
    return Answer(True, missing.reason if missing.met else f"recommended: {missing.reason}")


def _rollback_target(matter: Matter) -> Answer:
    if matter.previous is None:
        return Answer(True, "nothing ran before it: to roll back is to take it away")
    if matter.target is None:
        return Answer(False, f"no older release of it is in {matter.inputs.channel} to roll back to")
    return Answer(True, f"{name_of(matter.target)} is there to roll back to")


def _rollback_tested(matter: Matter) -> Answer:
    return _shown(matter, "rollback_test", "the way back must be tested")


def _rollback_traced(matter: Matter) -> Answer:
    traced = [each for each in matter.proof("rollback_test").confirmed if _is_traced(each, matter.inputs.digest)]
    if traced:
        return Answer(True, "the test of the way back names this very content and what it ran on", _digests(traced))
    wanted = f"sha256:{matter.inputs.digest}"
    return Answer(False, f"no test of the way back names this content ({wanted}) and what it ran on")


def _is_traced(kept: Kept, digest: str) -> bool:
    return kept.evidence.subject.contract == f"sha256:{digest}" and bool(kept.evidence.on)


def _shown(matter: Matter, kind: EvidenceKind, why: str) -> Answer:
    """Whether evidence of a kind confirms the release, and nobody contradicts."""
    proof, name = matter.proof(kind), kind.replace("_", " ")
    if proof.holds:
        told = _listed(witnesses(proof.confirmed).values())
        return Answer(True, f"{why}: {name} by {told}", _digests(proof.confirmed))
    return Answer(False, f"{why}: {_unproved(matter, proof, name)}", _digests((*proof.against, *proof.doubtful)))


def _unproved(matter: Matter, proof: Proof, name: str) -> str:
    if proof.against:
        return f"the newest {name} by {_listed(witnesses(proof.against).values())} says contradicted"
    if proof.confirmed:
        return f"no {name} confirms {_listed(proof.unproved)}"
    if proof.doubtful:
        return f"the newest {name} by {_listed(witnesses(proof.doubtful).values())} says doubtful"
    if proof.elsewhere:
        return f"the {name} is of another content than is stored"
    return f"no {name} since it came to {matter.inputs.source}"


def _digests(kept: Iterable[Kept]) -> tuple[str, ...]:
    return tuple(each.digest for each in kept)


def _listed(texts: Iterable[str]) -> str:
    found: Sequence[str] = list(dict.fromkeys(texts))
    more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
    return f"{'; '.join(found[:_SHOWN])}{more}"


DEMANDS: Final[Mapping[str, Callable[[Matter], Answer]]] = {
    "complete_contract": _complete_contract,
    "version_step": _version_step,
    "migration": _migration,
    "nobody_breaks": _nobody_breaks,
    "new_permissions_reviewed": _new_permissions_reviewed,
    "policy_reviewed": _policy_reviewed,
    "second_reviewer": _second_reviewer,
    "policy_given": _policy_given,
    "policy_allows": _policy_allows,
    "resources_revalidated": _resources_revalidated,
    "robot_has_resources": _robot_has_resources,
    "recovery_revalidated": _recovery_revalidated,
    "upgrade_tested": _upgrade_tested,
    "rollback_recommended": _rollback_recommended,
    "rollback_target": _rollback_target,
    "rollback_tested": _rollback_tested,
    "rollback_traced": _rollback_traced,
}
