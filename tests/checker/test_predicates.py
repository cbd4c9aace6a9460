"""Predicates: reading them and comparing them by implication."""

from __future__ import annotations

import pytest
from ecm_checker.predicates import Predicate, fact, implies, parse, settle
from hypothesis import given, settings
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("localization_confidence >= 0.90", Predicate("", "localization_confidence", ">=", 0.9)),
        ("gripper.is_open", Predicate("", "gripper.is_open", "==", True)),
        ("not gripper.is_open", Predicate("", "gripper.is_open", "==", False)),
        ("object_held == true", Predicate("", "object_held", "==", True)),
        ("object_held != true", Predicate("", "object_held", "==", False)),
        ("dist < 1 m", Predicate("", "dist", "<", 1.0, "length")),
        ("dist < 50cm", Predicate("", "dist", "<", 0.5, "length")),
        ("target.frame == base_link", Predicate("", "target.frame", "==", "base_link")),
        ("ee in workspace_bounds", Predicate("", "ee in workspace_bounds", "==", True)),
        ("__import__('os')", Predicate("", "__import__('os')", "==", True)),
    ],
)
def test_forms(text: str, expected: Predicate) -> None:
    """Each form is read as a comparison; anything else is an atom and is never run."""
    found = parse(text)
    assert (found.subject, found.op, found.value, found.dimension) == (
        expected.subject,
        expected.op,
        expected.value,
        expected.dimension,
    )


@pytest.mark.parametrize(
    ("known", "wanted", "verdict"),
    [
        ("c >= 0.95", "c >= 0.90", "implied"),
        ("c >= 0.80", "c >= 0.90", "unknown"),
        ("c < 0.5", "c >= 0.90", "contradicted"),
        ("c == 0.9", "c >= 0.9", "implied"),
        ("c > 0.9", "c >= 0.9", "implied"),
        ("c >= 0.9", "c > 0.9", "unknown"),
        ("c < 0.9", "c >= 0.9", "contradicted"),
        ("d < 50 cm", "d < 1 m", "implied"),
        ("d < 1 m", "d < 1 s", "unknown"),
        ("c == 3", "c != 4", "implied"),
        ("c == 3", "c != 3", "contradicted"),
        ("c > 1", "c != 3", "unknown"),
        ("c != 3", "c == 3", "contradicted"),
        ("mode == auto", "mode == manual", "contradicted"),
        ("mode != manual", "mode != manual", "implied"),
        ("force <= safe_force", "force <= safe_force", "implied"),
        ("force <= safe_force", "force <= other", "unknown"),
        ("open", "not open", "contradicted"),
        ("open", "closed", "unknown"),
    ],
)
def test_implication(known: str, wanted: str, verdict: str) -> None:
    """What is known implies, contradicts or leaves open what is wanted; units are converted first."""
    assert implies(parse(known), parse(wanted)) == verdict


def test_a_contradiction_weighs_more_than_a_support() -> None:
    """Two facts that disagree do not settle a precondition."""
    assert settle([parse("ready"), parse("not ready")], parse("ready")) == "contradicted"


@given(st.text(max_size=60))
@settings(max_examples=50)
def test_every_text_is_read_and_implies_itself(text: str) -> None:
    """Reading never fails and implication is reflexive."""
    found = parse(text)
    assert implies(found, found) == "implied"


@given(st.floats(-9, 9), st.floats(-9, 9), st.sampled_from(["<", "<=", ">", ">=", "==", "!="]))
@settings(max_examples=50)
def test_implication_of_a_fact_is_what_python_says(value: float, bound: float, op: str) -> None:
    """A number that is known settles every comparison."""
    from operator import eq, ge, gt, le, lt, ne

    truth = {"<": lt, "<=": le, ">": gt, ">=": ge, "==": eq, "!=": ne}[op](value, bound)
    wanted = Predicate("", "x", op, bound)
    known = Predicate("", "x", "==", value)
    assert fact("x", 1.0).value == 1.0
    assert implies(known, wanted) == ("implied" if truth else "contradicted")
