"""Conditions of package.xml evaluate as REP 149 says, and nothing else does."""

import pytest
from ecm_parsers.condition import MAX_DEPTH, evaluate
from hypothesis import given, settings
from hypothesis import strategies as st

ROS2 = {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy"}


@pytest.mark.parametrize(
    ("condition", "value"),
    [
        (None, True),
        ("$ROS_VERSION == 2", True),
        ("$ROS_VERSION==1", False),
        ("2 == $ROS_VERSION", True),
        ("$ROS_VERSION >= 1", True),
        ("$ROS_DISTRO < 'kilted'", True),
        ("$ROS_DISTRO != jazzy", False),
        ('$UNSET == ""', True),
        ("$ROS_VERSION == 1 or $ROS_VERSION == 2", True),
        ("$ROS_VERSION == 1 and $UNSET == a or $ROS_VERSION == 2", True),
        ("$ROS_VERSION == 1 and ($UNSET == a or $ROS_VERSION == 2)", False),
        ("(($ROS_VERSION == 2))", True),
        ("$ROS_DISTRO == 'or'", False),
    ],
)
def test_values(condition: str | None, value: bool) -> None:
    """`and` binds closer than `or`, values compare as text, an unset variable is empty."""
    assert evaluate(condition, ROS2) is value


@pytest.mark.parametrize(
    "condition",
    [
        "",
        "$ROS_VERSION",
        "$ROS_VERSION = 2",
        "$ROS_VERSION == ",
        "== 2",
        "($ROS_VERSION == 2",
        "$ROS_VERSION == 2)",
        "a == b c == d",
        "a == b and",
        "or == 1",
        "a == 'b",
        "not a == b",
        "__import__('os')",
        "(" * (MAX_DEPTH + 1) + "a == a" + ")" * (MAX_DEPTH + 1),
        "(" * 100_000,
        "a == a or " * 10_000 + "a == a",
    ],
)
def test_what_is_no_condition(condition: str) -> None:
    """Anything outside the grammar or beyond the bounds is None, never an exception."""
    assert evaluate(condition, ROS2) is None


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(["(", ")", "a", "$B", "==", "<", "and", "or", "'", '"c"', " "]), max_size=12))
def test_never_raises(tokens: list[str]) -> None:
    """Any text gives a truth value or None."""
    assert evaluate("".join(tokens), {"B": "a"}) in (True, False, None)
