"""A unit is taken from a comment only where people put units."""

import pytest
from ecm_parsers.units import normalize, unit_of


@pytest.mark.parametrize(
    ("comment", "unit"),
    [
        ("[m/s] speed over ground", "m/s"),
        ("yaw (rad)", "rad"),
        ("m", "m"),
        ("Meters.", "m"),
        ("height in metres above the floor", "m"),
        ("rate in radians per second", "rad/s"),
        ("in m/s^2", "m/s^2"),
        ("acceleration [m/s/s]", "m/s^2"),
        ("meters per second squared", "m/s^2"),
        ("area in m²", "m^2"),
        ("units: N*m", "N*m"),
        ("temperature (degrees Celsius)", "degC"),
        ("charge, mAh", "mAh"),
        ("climb rate m/s", "m/s"),
        ("deg [0..360)", "deg"),
        ("degrees 0..360", "deg"),
        ("load in percent (0 when idle)", "%"),
        ("first line\n[ms] second line", "ms"),
        ("in seconds, the timeout in seconds", "s"),
    ],
)
def test_stated_units(comment: str, unit: str) -> None:
    """Brackets, `in ...`, `unit: ...` and a bare unit name the unit in its short form."""
    assert unit_of(comment) == unit


@pytest.mark.parametrize(
    "comment",
    [
        "",
        "the robot's pose in the map frame",
        "in a hurry",
        "in s frame",
        "in second place of the list",
        "as written in C/C++",
        "latitude in degrees * 1E7",
        "latitude in deg 1e7",
        "linear in m/s, angular in rad/s",
        "limit in percent or in m/s",
        "(see the manual)",
        "[0, 1]",
        "m: the model",
        "number of meters read",
        "a, b, s",
    ],
)
def test_prose_names_no_unit(comment: str) -> None:
    """Prose, scaled values and two different units give None rather than a wrong unit."""
    assert unit_of(comment) is None


def test_long_comment_is_cut() -> None:
    """A comment of a megabyte costs no more than its first part."""
    assert unit_of("in " * 400_000) is None


def test_normalize_needs_every_factor() -> None:
    """A quotient with one unknown side is no unit."""
    assert normalize("rad/frob") is None
