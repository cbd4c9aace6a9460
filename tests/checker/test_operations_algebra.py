"""Laws of the operations, over contracts that hypothesis makes up."""

from __future__ import annotations

from itertools import pairwise

import msgspec
from ecm_checker.contract import (
    Behavior,
    Contract,
    Evidence,
    Identity,
    Interface,
    Permissions,
    Qos,
    Recovery,
    Resources,
    Role,
    Signature,
    Source,
    Value,
)
from ecm_checker.operations.chain import chain
from ecm_checker.operations.compose import compose
from ecm_checker.operations.system import system
from ecm_checker.operations.upgrade import upgrade
from ecm_checker.outcome import worst
from ecm_checker.profiles import Embodiment, Policy, Profiles
from hypothesis import given, settings
from hypothesis import strategies as st

ROLES: tuple[Role, ...] = ("publisher", "subscriber", "service_server", "service_client")
PROFILES = Profiles(
    Embodiment(sensors=("lidar", "imu"), actuators=("base",), compute={"cpu_cores": 4, "gpu": True}),
    Policy(physical={"motion": True}, data=("read:map",), network=False),
)


def declared(values: st.SearchStrategy[object]) -> st.SearchStrategy[Value | None]:
    return st.one_of(st.none(), values.map(lambda value: Value(value, "declared")))


def lists(*names: str) -> st.SearchStrategy[Value | None]:
    return declared(st.lists(st.sampled_from(names), max_size=2, unique=True))


INTERFACES = st.builds(
    lambda role, name, kind, best: Interface(
        role, name, name, kind, Qos("best_effort" if best else "reliable"), None, "literal", (Evidence("a.cpp", 1),)
    ),
    st.sampled_from(ROLES),
    st.sampled_from(["/scan", "/cmd_vel", "/scans", "/map"]),
    st.sampled_from(["a/msg/A", "a/msg/B", None]),
    st.booleans(),
)


@st.composite
def contracts(draw: st.DrawFn, version: str = "1.0.0") -> Contract:
    name = draw(st.sampled_from("abcdefgh"))
    return Contract(
        Identity(f"ecm.{name}.node", name, "node", version, Source(None, None, "."), 2),
        Signature(tuple(draw(st.lists(INTERFACES, max_size=3)))),
        Behavior(draw(lists("x >= 1", "y", "not y")), draw(lists("x >= 2", "x < 1", "y", "not y"))),
        Resources(
            sensors=draw(lists("lidar", "camera")),
            compute=draw(declared(st.fixed_dictionaries({"cpu_cores": st.integers(0, 8), "gpu": st.booleans()}))),
            exclusive_locks=draw(lists("joint1/position", "gripper")),
        ),
        Permissions(physical=draw(declared(st.fixed_dictionaries({"motion": st.booleans(), "zone": st.booleans()})))),
        Recovery(
            failure_modes=draw(declared(st.just({"slip": "critical"}))),
            retry=draw(declared(st.sampled_from(["retry_once", "never"]))),
        ),
    )


SETS = st.lists(contracts(), min_size=2, max_size=4, unique_by=lambda each: each.ecm.module_id)


@given(SETS, st.randoms())
@settings(max_examples=40, deadline=None)
def test_system_does_not_depend_on_order(modules: list[Contract], random: object) -> None:
    """The same modules in another order give the same report, byte for byte."""
    turned = list(reversed(modules))
    assert system(modules, PROFILES, together=True) == system(turned, PROFILES, together=True)


@given(SETS)
@settings(max_examples=40, deadline=None)
def test_chain_is_the_conjunction_of_its_pairs(modules: list[Contract]) -> None:
    """A chain is at least as bad as each adjacent pair, and bracketing changes nothing."""
    pairs = [compose(one, two, PROFILES).outcome for one, two in pairwise(modules)]
    whole = chain(modules, PROFILES).outcome
    assert worst([whole, *pairs]) == whole
    assert worst([pairs[0], worst(pairs[1:])]) == worst([worst(pairs[:-1]), pairs[-1]])


@given(contracts())
@settings(max_examples=40, deadline=None)
def test_upgrade_is_reflexive(module: Contract) -> None:
    """A version may take its own place, whatever is undeclared."""
    assert upgrade(module, module).outcome == "accept"


@given(contracts(), contracts("2.0.0"), contracts("3.0.0"))
@settings(max_examples=50, deadline=None)
def test_upgrade_is_transitive(one: Contract, two: Contract, three: Contract) -> None:
    """Two steps that are accepted make one that is."""
    if upgrade(one, two).outcome == upgrade(two, three).outcome == "accept":
        assert upgrade(one, three).outcome == "accept"


def test_upgrade_is_not_symmetric() -> None:
    """What adds an output may be installed; taking it away again may not."""
    identity = Identity("ecm.a.node", "a", "node", "1.0.0", Source(None, None, "."), 2)
    old = Contract(identity)
    entry = Interface("publisher", "/a", "a", "a/msg/A", None, None, "literal", (Evidence("a.cpp", 1),))
    new = Contract(msgspec.structs.replace(identity, version="1.1.0"), Signature((entry,)))
    assert upgrade(old, new).outcome == "accept"
    assert upgrade(new, old).outcome == "review"
    assert upgrade(new, old, dependents=()).outcome == "accept_with_conditions"


@given(SETS)
@settings(max_examples=40, deadline=None)
def test_a_conflict_more_never_helps(modules: list[Contract]) -> None:
    """Adding a double claim turns nothing into accept."""
    before = system(modules, PROFILES, together=True).outcome
    locks = Resources(exclusive_locks=Value(["joint9/position"], "declared"))
    rivals = [
        Contract(Identity(f"ecm.z.{at}", "z", "node", "1.0.0", Source(None, None, "."), 2), resources=locks)
        for at in range(2)
    ]
    after = system([*modules, *rivals], PROFILES, together=True).outcome
    assert worst([before, after]) == after == "reject"


def test_claim_and_frame_and_qos_are_conflicts_only_when_they_run_together() -> None:
    """Modules of a repository could run together: then a conflict is a condition."""
    locks = Resources(exclusive_locks=Value(["joint1/position"], "declared"))
    rivals = [
        Contract(Identity(f"ecm.z.{at}", "z", "controller", "1.0.0", Source(None, None, "."), 2), resources=locks)
        for at in range(2)
    ]
    assert system(rivals, together=True).outcome == "reject"
    assert system(rivals).outcome == "accept_with_conditions"
    assert [each.dimension for each in system(rivals, together=True).findings] == ["resources"]
