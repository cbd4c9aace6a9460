"""Contracts as plain data."""

from __future__ import annotations

import json
import pickle
from typing import Any

import msgspec
import pytest
from ecm_checker.contract import (
    Behavior,
    Contract,
    Entity,
    Evidence,
    Identity,
    Interface,
    Qos,
    Resources,
    Signature,
    Source,
    Use,
    Value,
    Versioning,
)
from ecm_checker.encode import decode, encode, encode_manifest
from ecm_checker.hub.condition import Condition
from hypothesis import given, settings
from hypothesis import strategies as st

AT = (Evidence("src/a.cpp", 41),)
IDENTITY = Identity("ecm.a.b", "a", "node", "1.2.0", Source(None, None, "."), 2)
CMD_VEL = Interface(
    "publisher",
    "/cmd_vel",
    "cmd_vel",
    "geometry_msgs/msg/Twist",
    Qos("reliable", "volatile", "keep_last", 10),
    None,
    "literal",
    AT,
)


def with_interface(interface: Interface) -> dict[str, Any]:
    plain = encode(Contract(IDENTITY, Signature(interfaces=(interface,))))
    first: dict[str, Any] = plain["signature"]["interfaces"][0]
    return first


def test_interface_is_written_as_other_programs_read_it() -> None:
    """The keys and their order are those of the published schema."""
    assert json.dumps(with_interface(CMD_VEL)) == json.dumps(
        {
            "role": "publisher",
            "name": "/cmd_vel",
            "raw_name": "cmd_vel",
            "type": "geometry_msgs/msg/Twist",
            "qos": {"reliability": "reliable", "durability": "volatile", "history": "keep_last", "depth": 10},
            "frame": None,
            "confidence": "literal",
            "evidence": [{"path": "src/a.cpp", "line": 41}],
        }
    )


def test_parameter_always_shows_its_default() -> None:
    """A reader may take `default` of a parameter without asking whether it is there."""
    parameter = Interface("parameter", "rate", "rate", "double", None, None, "literal", AT)
    assert with_interface(parameter)["default"] is None


def test_undeclared_fields_are_absent_and_named() -> None:
    """What nothing declares is not written, and `ecm.missing` says so; an empty list stays."""
    contract = Contract(
        IDENTITY,
        resources=Resources(sensors=Value([], "inferred")),
        missing=("resources.compute",),
    )
    plain = encode(contract)
    assert plain["resources"] == {"sensors": {"value": [], "origin": "inferred"}}
    assert plain["ecm"]["missing"] == ["resources.compute"]


def test_all_sections_are_always_there() -> None:
    """A reader may open any section of any manifest."""
    assert list(encode_manifest(Contract(IDENTITY))) == [
        "schema",
        "ecm",
        "signature",
        "behavior",
        "resources",
        "permissions",
        "recovery",
        "versioning",
    ]


def test_free_form_values_have_sorted_keys() -> None:
    """Equal contracts give equal bytes, in whatever order a value was put together."""
    one = Contract(IDENTITY, behavior=Behavior(rates=Value({"b": 1, "a": 2}, "inferred")))
    two = Contract(IDENTITY, behavior=Behavior(rates=Value({"a": 2, "b": 1}, "inferred")))
    assert json.dumps(encode(one)) == json.dumps(encode(two))


def test_unknown_keys_are_passed_over() -> None:
    """A manifest of a later minor version can be read."""
    plain = encode_manifest(Contract(IDENTITY))
    plain["ecm"]["later"] = 1
    assert decode(plain) == Contract(IDENTITY)


def test_a_wrong_type_names_its_path() -> None:
    """A broken manifest is told with the path of what is wrong."""
    plain = encode(Contract(IDENTITY))
    plain["ecm"]["ros"] = 3
    with pytest.raises(msgspec.ValidationError, match=r"\$\.ecm\.ros"):
        decode(plain)


@pytest.mark.parametrize(
    "value",
    [{1: "a", "b": 2}, {None: 1, "None": 2}, (1, {3, 1}), float("nan"), 10**400, "half \ud800", b"bytes"],
)
def test_hostile_values_are_written(value: object) -> None:
    """No value that a file of somebody else's holds can make writing fail."""
    plain = encode(Contract(IDENTITY, behavior=Behavior(rates=Value(value, "inferred"))))
    text = json.dumps(plain, allow_nan=False).encode("utf-8")
    assert decode(json.loads(text)).behavior.rates is not None


def test_nesting_without_end_is_cut() -> None:
    """A value that is nested a hundred thousand times neither fails nor takes the stack."""
    value: object = "end"
    for _ in range(100_000):
        value = [value]
    plain = encode(Contract(IDENTITY, behavior=Behavior(rates=Value(value, "inferred"))))
    assert decode(json.loads(json.dumps(plain))).behavior.rates is not None


plain_data = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**53), 2**53)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=8,
)
names = st.text(max_size=8)
evidence = st.lists(st.builds(Evidence, names, st.integers(0, 9)), max_size=2).map(tuple)
values = st.none() | st.builds(Value, plain_data, st.sampled_from(["declared", "inferred", "default"]))
interfaces = st.builds(
    Interface,
    role=st.sampled_from(["publisher", "parameter", "tf_lookup"]),
    name=names,
    raw_name=names,
    type=st.none() | names,
    qos=st.none() | st.builds(Qos, depth=st.none() | st.integers(0, 9)),
    frame=st.none() | names,
    confidence=st.sampled_from(["literal", "pattern"]),
    evidence=evidence,
    default=plain_data,
    inherited_from=st.none() | names,
)
contracts = st.builds(
    Contract,
    ecm=st.builds(Identity, names, names, names, st.none() | names, st.just(Source(None, None, ".")), st.just(1)),
    signature=st.builds(Signature, st.lists(interfaces, max_size=2).map(tuple), values),
    behavior=st.builds(Behavior, values, values),
    versioning=st.builds(
        Versioning,
        dependencies=values,
        entities=st.lists(st.builds(Entity, names, names, names, names, evidence), max_size=2).map(tuple),
        uses=st.lists(st.builds(Use, names, names, evidence), max_size=2).map(tuple),
    ),
    missing=st.lists(names, max_size=2).map(tuple),
)


@settings(max_examples=50, deadline=None)
@given(contracts)
def test_what_is_written_is_read_back(contract: Contract) -> None:
    """Decoding undoes encoding, also through JSON text."""
    assert decode(json.loads(json.dumps(encode_manifest(contract)))) == contract


def test_records_that_were_handed_between_processes_are_the_same_bytes() -> None:
    """msgspec leaves out a default by identity, and a text that was unpickled is another object."""
    records = (Condition("argument", "x", "true"), Value(1, "inferred", "literal"))
    handed = pickle.loads(pickle.dumps([("".join(["tr", "ue"]), "".join(["lite", "ral"])), *records]))
    texts, *copies = handed
    made = (Condition("argument", "x", texts[0]), Value(1, "inferred", texts[1]))
    for known, copied, anew in zip(records, copies, made, strict=True):
        assert msgspec.json.encode(copied) == msgspec.json.encode(anew) == msgspec.json.encode(known)
