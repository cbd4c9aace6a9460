"""Texts with something unknown between them."""

from __future__ import annotations

import re
from time import monotonic

import pytest
from ecm_checker.gaps import with_gaps
from ecm_checker.hub.provision import HOLE
from ecm_checker.match.spelling import graph_name_matches, parameter_name_matches, whole_name_matches
from hypothesis import given
from hypothesis import strategies as st

_TEXTS = st.lists(st.text("ab/", max_size=2), min_size=1, max_size=5)
MANY = 40


@given(_TEXTS, st.sampled_from([".*", ".+", "[^/]+", "(?:/[^/]+)*"]), st.text("ab/", max_size=12))
def test_the_same_fits_as_where_all_ways_are_tried(texts: list[str], gap: str, given_text: str) -> None:
    """What is not tried could not have fitted."""
    if gap.startswith("("):
        texts = [re.sub("/+", "/", f"/{text.strip('/')}") + r"(?=/|\Z)" if text.strip("/") else "" for text in texts]
    plain = re.fullmatch(gap.join(texts), given_text)
    assert (re.fullmatch(with_gaps(texts, gap), given_text) is None) == (plain is None)


@pytest.mark.parametrize("matches", [graph_name_matches, parameter_name_matches, whole_name_matches])
def test_many_gaps_take_no_time(matches: object) -> None:
    """A name of a contract that somebody else wrote cannot stop a comparison."""
    begin = monotonic()
    assert not matches("/" + f"x{HOLE}" * MANY + "y", "/" + "x" * 3 * MANY)  # type: ignore[operator]
    assert monotonic() - begin < 1
