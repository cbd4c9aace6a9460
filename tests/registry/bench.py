"""Two releases of the paper's module in a registry, judged for any channel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ecm_checker.contract import Evidence as Line
from ecm_checker.hub.package import Package, Provided
from ecm_checker.hub.requirement import Requirement
from ecm_checker.profiles import Embodiment, Policy, Profiles
from sample import published
from scenario import contract, package

from ecm_extract.diff.migration import Migration
from ecm_extract.registry import clock
from ecm_extract.registry.channels import gate_table
from ecm_extract.registry.evidence import Statement, add_evidence, evidence_of, stated
from ecm_extract.registry.gates import Verdict, Waiver, judge, judged_again
from ecm_extract.registry.impact import Impact, impact_of
from ecm_extract.registry.matter import Inputs
from ecm_extract.registry.releases import find_release
from ecm_extract.registry.scope import EVERYTHING
from ecm_extract.registry.sides import two_sides
from ecm_extract.registry.store import Registry

POLICY = Policy(physical={"motion": True, "max_force_n": 50}, data=(), network=False, operational=(), audit="full")
ROBOT = Embodiment(
    sensors=("force_torque@wrist",), actuators=("arm_6dof", "gripper"), compute={"cpu_cores": 8, "gpu": True}
)
PROFILES = Profiles(ROBOT, POLICY)
ALL = ("validation", "upgrade_test", "policy_review", "rollback_test")
TOPIC = Provided(
    kind="topic",
    owner="grasp",
    name="/grasped",
    type="std_msgs/msg/Bool",
    default=None,
    conditions=(),
    confidence="literal",
    deprecated=None,
    evidence=(Line("delivery/grasp.py", 7),),
    facet="published",
)
LISTENER = Requirement(
    use="subscribes",
    kind="topic",
    package=None,
    owner="",
    name="/grasped",
    type="std_msgs/msg/Bool",
    certainty="proved",
    conditions=(),
    by="node show",
    evidence=(Line("panel/show.py", 3),),
)
PANEL = Package(name="panel", version="1.0.0", path="panel", ros=2, manifest="panel/package.xml", requires=(LISTENER,))


class Bench:
    """Two releases of a package in a registry, judged for any channel."""

    def __init__(self, registry: Registry, new: Package, old: Package | None = None) -> None:
        self._registry = registry
        published(registry, (old or package("1.0.0", contract(), provides=(TOPIC,)), PANEL))
        published(registry, (new,))
        self._name = f"delivery@{new.version}"
        self.migration: Migration | None = None

    def impact(self) -> Impact:
        with self._registry.reading() as session:
            sides = two_sides(session, "delivery", None)
            assert sides.before is not None
            return impact_of(session, sides.before, sides.after, EVERYTHING)

    def show(self, *kinds: str, result: str = "confirmed", by: str = "Ada", on: str | None = "robot 7") -> None:
        with self._registry.writing() as session:
            said = [Statement(kind, by, on, result) for kind in kinds]  # type: ignore[arg-type]
            add_evidence(session, [stated(session, self._name, each) for each in said])

    def judge(
        self, channel: str, waivers: Sequence[Waiver] = (), profiles: Profiles = PROFILES, scope: Sequence[str] = ()
    ) -> Verdict:
        with self._registry.reading() as session:
            release = find_release(session, self._name)
            old = find_release(session, "delivery@1.0.0")
            asked = tuple(find_release(session, each).id for each in scope or ("panel",))
            inputs = Inputs(
                release=release.id, digest=release.digest, previous=old.id, source="sandbox", channel=channel,
                since=release.stored, scope=asked, target=old.id,
                evidence=tuple(each.digest for each in evidence_of(session, release.id)),
                migration=self.migration, embodiment=profiles.embodiment, policy=profiles.policy,
                at=clock.written(clock.now()),
            )  # fmt: skip
            verdict = judge(session, inputs, waivers, gate_table())
            assert judged_again(session, verdict) == verdict
            return verdict

    def refused(self, channel: str, **rest: Any) -> set[str]:
        return {each.gate for each in self.judge(channel, **rest).gates if each.state == "refused"}
