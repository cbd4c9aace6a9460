"""One endpoint that several lines make is one record, and says no more than the lines show."""

from __future__ import annotations

from itertools import permutations

import pytest
from ecm_checker.contract import Confidence, Evidence, Interface
from ecm_checker.hub.condition import Condition

from ecm_extract.link.endpoints.merging import merged

WHEN = Condition("expression", "wanted")
OTHER = Condition("expression", "asked")


def _told(confidence: Confidence, line: int, *when: Condition) -> Interface:
    place = (Evidence("a.cpp", line),)
    return Interface("publisher", "/a", "a", None, None, None, confidence, place, when=when)


@pytest.mark.parametrize(
    ("told", "confidence"),
    [
        pytest.param((_told("one_of", 1), _told("literal", 2)), "literal", id="told_for_sure_elsewhere"),
        pytest.param((_told("one_of", 1), _told("default", 2), _told("folded", 3)), "folded", id="of_three"),
        pytest.param((_told("literal", 1, WHEN), _told("one_of", 2)), "one_of", id="sure_under_a_condition_only"),
        pytest.param((_told("literal", 1), _told("one_of", 2, WHEN)), "literal", id="sure_without_the_condition"),
        pytest.param((_told("literal", 1, WHEN), _told("one_of", 2, OTHER)), "one_of", id="under_two_conditions"),
    ],
)
def test_a_name_is_as_sure_as_the_surest_line_that_makes_it_everywhere(
    told: tuple[Interface, ...], confidence: Confidence
) -> None:
    """Which line is read first decides nothing."""
    for order in permutations(told):
        assert [each.confidence for each in merged(order)] == [confidence]
