"""Whatever stands in the free-form fields of a contract, an operation ends with a report."""

from __future__ import annotations

from typing import Any

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
    Signature,
    Source,
    Value,
    Versioning,
)
from ecm_checker.json_data import json_data
from ecm_checker.operations.chain import chain
from ecm_checker.operations.install import install
from ecm_checker.operations.invoke import invoke
from ecm_checker.operations.system import system
from ecm_checker.operations.upgrade import upgrade
from ecm_checker.profiles import Call, Embodiment, Policy, Profiles, Runtime
from hypothesis import given, settings
from hypothesis import strategies as st

WORDS = st.sampled_from(
    [
        "a",
        "x >= 1",
        "not a",
        "x < 1 m",
        "map",
        "a@30Hz",
        "a@wrist",
        "a -> b",
        "once",
        "critical",
        "",
        "{h}",
        "4GB",
        "é\ud800",
    ]
)
LEAVES = st.one_of(st.none(), st.booleans(), st.integers(-2, 9), st.floats(), WORDS)
ANY = st.recursive(
    LEAVES,
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(WORDS, inner, max_size=3)),
    max_leaves=5,
)
ENTRY = Interface("publisher", "/a", "a", "a/msg/A", Qos("odd", "odd", deadline_ms=-1.0), "/a", "literal", ())


def section(draw: st.DrawFn, kind: type[Any]) -> Any:
    names = [name for name in kind.__struct_fields__ if name not in {"interfaces", "entities", "uses"}]
    return kind(**{name: Value(draw(ANY), "declared", "literal", (Evidence("a", 1),)) for name in names})


@st.composite
def contracts(draw: st.DrawFn) -> Contract:
    name = draw(st.sampled_from("abc"))
    signature = msgspec.structs.replace(section(draw, Signature), interfaces=(ENTRY,))
    rest = [section(draw, kind) for kind in (Behavior, Resources, Permissions, Recovery, Versioning)]
    version = draw(st.sampled_from([None, "1.0", "odd"]))
    return Contract(Identity(f"ecm.{name}", name, "node", version, Source(None, None, "."), None), signature, *rest)


@given(contracts(), contracts(), ANY)
@settings(max_examples=50, deadline=None)
def test_operations_never_raise(one: Contract, two: Contract, odd: Any) -> None:
    """Contracts come from other people's files; the report can always be written."""
    mapping = odd if isinstance(odd, dict) else {"a": odd}
    profiles = Profiles(
        Embodiment(sensors=("a",), actuators=(), compute=mapping, control_hz=1.0),
        Policy(physical=mapping, network=("a",), data=(), audit="odd", forbidden_together=(("a", "b"),)),
        Runtime(versions={"a": "odd"}, states=(), facts=mapping),
    )
    call = Call(inputs=odd, state=mapping, handles=(), completion=())
    reports = (
        install(one, profiles),
        invoke(one, call, profiles),
        chain([one, two, one], profiles),
        upgrade(one, two, profiles, [two]),
        system([one, two], profiles, together=True),
    )
    for report in reports:
        assert json_data(report)
