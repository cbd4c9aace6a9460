"""Matching by name, QoS and frame: what connects, what is near, what cannot be known."""

from __future__ import annotations

import msgspec
import pytest
from ecm_checker import frames
from ecm_checker.contract import (
    Confidence,
    Contract,
    Evidence,
    Identity,
    Interface,
    Qos,
    Role,
    Signature,
    Source,
    Value,
)
from ecm_checker.finding import Finding
from ecm_checker.names import NearNames, is_known
from ecm_checker.operations.system import system
from ecm_checker.operations.upgrade import upgrade
from ecm_checker.terms import escalations, fields, rates, retry, spec
from ecm_checker.units import Quantity, quantity
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("used", "offered", "near"),
    [
        ("/camera/image_raw", "/camera/imageraw", "spelling"),
        ("/camera/image_raw", "/camera_image_raw", "spelling"),
        ("/clear_costmap", "/clear_costmaps", "typo"),
        ("/joint_states", "/joint_staets", "typo"),
        ("/odometry", "/odometrx", "typo"),
        ("/odom", "/robot/odom", "namespace"),
        ("/camera1", "/camera2", None),
        ("/scan", "/scam", None),
        ("/map", "/odom", None),
    ],
)
def test_near_names(used: str, offered: str, near: str | None) -> None:
    """Graded; numbered and short names are meant to differ."""
    found = NearNames([offered]).near(used)
    assert found == ((offered, near) if near else None)


@given(st.text("ab_/1", min_size=1, max_size=20), st.text("ab_/1", min_size=1, max_size=20))
@settings(max_examples=50)
def test_nearness_is_symmetric(one: str, two: str) -> None:
    """Which side has the typo does not matter."""
    there, back = NearNames([one]).near(two), NearNames([two]).near(one)
    assert (there and there[1]) == (back and back[1])


@pytest.mark.parametrize("name", ["/{topic}", "~/scan", "/", ""])
def test_computed_and_private_names_match_nothing(name: str) -> None:
    """A hole is filled when it runs; a private name depends on the name of its node."""
    assert not is_known(name)


def endpoint(
    role: Role, qos: Qos | None, confidence: Confidence = "literal", kind: str | None = "a/msg/A"
) -> Interface:
    return Interface(role, "/scan", "scan", kind, qos, None, confidence, (Evidence("a.cpp", 1),))


def module(name: str, *interfaces: Interface, ros: int = 2) -> Contract:
    identity = Identity(f"ecm.{name}.node", name, "node", "1.0.0", Source(None, None, "."), 1 if ros == 1 else 2)
    return Contract(identity, Signature(interfaces))


def said(*modules: Contract, together: bool = True) -> list[tuple[str, str]]:
    found: tuple[Finding, ...] = system(modules, together=together).findings
    return [(each.rule, each.severity) for each in found]


BEST, RELIABLE = Qos("best_effort"), Qos("reliable")


@pytest.mark.parametrize(
    ("offer", "want", "severity"),
    [
        (BEST, RELIABLE, "error"),
        (BEST, Qos("reliable", defaulted=("reliability",)), "warning"),
        (BEST, None, "warning"),
        (BEST, Qos("best_available"), None),
        (Qos("system_default"), RELIABLE, None),
        (RELIABLE, BEST, None),
        (None, None, None),
    ],
)
def test_reliability(offer: Qos | None, want: Qos | None, severity: str | None) -> None:
    """What source sets is proved, what is a default is likely at most."""
    found = said(module("a", endpoint("publisher", offer)), module("b", endpoint("subscriber", want)))
    assert found == ([("BEH001", severity)] if severity else [])


def test_an_alternative_that_fits_is_enough() -> None:
    """A module that chooses between two endpoints when it runs may choose the right one."""
    both = module("a", endpoint("publisher", BEST), endpoint("publisher", RELIABLE))
    assert not said(both, module("b", endpoint("subscriber", RELIABLE)))


def test_modules_that_only_could_run_together_are_warned_about() -> None:
    """The modules of a repository are no system."""
    pair = module("a", endpoint("publisher", BEST)), module("b", endpoint("subscriber", RELIABLE))
    assert said(*pair, together=False) == [("BEH001", "warning")]


def test_ros_1_has_no_qos_and_does_not_meet_ros_2() -> None:
    """Two graphs, two sets of rules."""
    publisher, subscriber = endpoint("publisher", BEST), endpoint("subscriber", RELIABLE)
    assert not said(module("a", publisher, ros=1), module("b", subscriber, ros=1))
    other = endpoint("subscriber", RELIABLE, kind="a/msg/B")
    assert not said(module("a", publisher, ros=1), module("b", other, ros=2))


def test_type_of_a_topic_whose_name_is_a_parameter_says_little() -> None:
    """The name is often set otherwise; an unknown type is never silently fine."""
    named = module("b", endpoint("subscriber", BEST, "default", "a/msg/B"))
    assert said(module("a", endpoint("publisher", BEST)), named) == [("SIG001", "info")]
    unknown = module("b", endpoint("subscriber", BEST, kind=None))
    assert said(module("a", endpoint("publisher", BEST)), unknown) == [("SIG012", "warning")]


def test_upgrade_compares_private_names_and_lists_computed_ones() -> None:
    """Within one module `~` is the same node; what a hole is called in source does not matter."""
    private = msgspec.structs.replace(endpoint("publisher", None), name="~/state")
    computed = msgspec.structs.replace(endpoint("publisher", None, "pattern"), name="/{joint}/state")
    renamed = msgspec.structs.replace(computed, name="/{name}/state")
    new = module("a", renamed)
    assert not upgrade(module("a", computed), new).findings
    old = module("a", private, computed)
    assert [(each.rule, each.severity) for each in upgrade(old, module("a")).findings] == [
        ("SIG010", "warning"),
        ("VER003", "warning"),
        ("SIG010", "info"),
    ]


def test_an_endpoint_that_is_gone_is_told_once() -> None:
    """The output that restates a publisher is no second cause; one that is nobody's endpoint is."""
    gone = msgspec.structs.replace(endpoint("publisher", None), name="/fix")
    outputs = Value({"/fix": {"type": "a/msg/A"}, "plan": {"type": "a/msg/B"}}, "declared")
    old = module("a", gone)
    old = msgspec.structs.replace(old, signature=msgspec.structs.replace(old.signature, output_schema=outputs))
    told = [each.message for each in upgrade(old, module("a")).findings if each.rule == "SIG010"]
    assert len(told) == 2
    assert sum("/fix" in message for message in told) == 1


def test_frames() -> None:
    """Leading slashes and usual spellings are one frame; transforms connect over others."""
    assert frames.known("/map_frame") == "map"
    assert frames.known("{frame}") is None
    assert frames.ends("odom <- base_link") == ("odom", "base_link")
    assert frames.ends("{odom} <- base_link") is None
    tree = frames.groups([("map", "odom"), ("odom", "base_link"), ("left", "right")])
    assert tree["map"] == tree["base_link"] != tree["left"]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("0.5 m", Quantity(0.5, "length")),
        ("4GB", Quantity(4.0, "memory")),
        (3, Quantity(3.0, "")),
        (True, None),
        ("x", None),
    ],
)
def test_quantities(value: object, expected: Quantity | None) -> None:
    """Numbers with units in SI; a truth value is no number."""
    assert quantity(value) == expected


def test_free_forms_of_a_contract() -> None:
    """What people write in several ways is read as one."""
    assert fields([{"a": "T"}]) == fields({"a": {"type": "T"}})
    assert (spec("rgbd@30Hz").rate_hz, spec("ft@wrist").mount) == (30.0, "wrist")
    assert retry(Value("retry_once", "declared")) == retry(Value({"max": 1}, "declared")) == retry(Value(1, "declared"))
    assert escalations(Value(["slip -> planner"], "declared")) == escalations(Value({"slip": "planner"}, "declared"))
    assert rates(Value({"/a": "50 Hz", "/b": {"hz": 5}}, "declared")) == {"/a": 50.0, "/b": 5.0}
