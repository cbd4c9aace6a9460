"""What the names of the parameters of a plugin are below is the name that it is loaded under."""

from __future__ import annotations

import pytest
from ecm_checker.hub.local_name import LocalName, OpenPart, Parts

from ecm_extract.link.naming.plugin_names import own_parts

GIVEN, UNKNOWN = OpenPart("caller", "name"), OpenPart("nobody", "label")


@pytest.mark.parametrize(
    ("names", "own"),
    [
        ([(GIVEN, ".rate")], {GIVEN}),
        ([("~", GIVEN, "/rate")], {GIVEN}),
        ([(UNKNOWN, ".rate")], {UNKNOWN}),
        ([(UNKNOWN, ".rate"), (GIVEN, ".rate")], {GIVEN}),
        ([(GIVEN, "_rate")], set()),
        ([(GIVEN,)], set()),
        ([("~",), ("/",), ()], set()),
        ([("rate",)], set()),
    ],
)
def test_the_part_that_parameters_are_below(names: list[Parts], own: set[OpenPart]) -> None:
    """An open part with more below it, of a private name too; names of nothing but a mark say nothing."""
    assert own_parts(LocalName(parts) for parts in names) == own
