"""Compatibility classes and required version steps."""

from __future__ import annotations

import pytest
from ecm_checker.finding import Dimension
from ecm_checker.release import ACTIONS, Change, ChangeWord, compatibility_class, declared_class, required_bump
from ecm_checker.versions import bump_between, in_range


def change(dimension: Dimension, breaking: bool, word: ChangeWord = "removed") -> Change:
    return Change(
        kind="topic", change=word, package="a", owner="b", old="x", new=None, breaking=breaking, dimension=dimension
    )


@pytest.mark.parametrize(
    ("changes", "name", "bump"),
    [
        ([], "fully-compatible", "none"),
        ([change("signature", False, "added")], "fully-compatible", "minor"),
        ([change("signature", False, "default_changed")], "fully-compatible", "patch"),
        ([change("resources", True)], "resource-sensitive", "major"),
        ([change("resources", False)], "fully-compatible", "minor"),
        ([change("resources", True), change("permissions", True)], "policy-sensitive", "major"),
        ([change("recovery", True)], "recovery-sensitive", "major"),
        ([change("permissions", True), change("signature", True)], "breaking", "major"),
        ([change("behavior", True)], "breaking", "major"),
    ],
)
def test_class_and_step(changes: list[Change], name: str, bump: str) -> None:
    """The severest change decides; more resources are major, fewer are minor."""
    assert compatibility_class(changes) == name
    assert required_bump(changes) == bump
    assert ACTIONS[compatibility_class(changes)]


def test_declared_class_in_both_spellings() -> None:
    """The paper writes the class with a hyphen and with an underscore."""
    assert declared_class("resource_sensitive") == declared_class("resource-sensitive") == "resource-sensitive"
    assert declared_class("nice") is None


@pytest.mark.parametrize(
    ("installed", "wanted", "fits"),
    [
        ("2.4", ">=2.1,<3.0", True),
        ("3.0", ">=2.1,<3.0", False),
        ("3.0", ">=2.1 <3.0", False),
        ("1.0", "*", True),
        ("1.0", "1.0", True),
        ("what", ">=1", None),
        ("1.0", "about one", None),
    ],
)
def test_ranges(installed: str, wanted: str, fits: bool | None) -> None:
    """Ranges in both spellings; what cannot be read is not known."""
    assert in_range(installed, wanted) is fits


@pytest.mark.parametrize(
    ("old", "new", "step"),
    [("1.0.0", "1.0.1", "patch"), ("1.0.0", "1.1.0", "minor"), ("1.9.0", "2.0.0", "major"), ("2.0", "1.0", "none")],
)
def test_steps(old: str, new: str, step: str) -> None:
    """The first number that differs names the step; a step back is none."""
    assert bump_between(old, new) == step


def test_a_version_of_thousands_of_digits_is_none() -> None:
    """What no registry takes cannot be read, in a version as in a range."""
    long = "1." + "9" * 5000
    assert bump_between("1.0.0", long) is None
    assert in_range(long, ">=1") is None
    assert in_range("1.0", f">={long}") is None
