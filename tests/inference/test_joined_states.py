"""Where two ways meet, only what one of them changed is looked at."""

from __future__ import annotations

from ecm_parsers.source.expr import Text

from ecm_extract.infer.held import Held, State, joined_states
from ecm_extract.infer.layers import Layers, Written

_NAMES = [f"name{number}" for number in range(100)]


def _held(text: str) -> tuple[Held, ...]:
    return (Held("value", text, Text(text)),)


def _state() -> State:
    return State(Layers(Written({name: _held(name) for name in _NAMES})))


def test_ways_that_part_are_compared_in_what_they_changed() -> None:
    """Of a hundred variables two were changed after the ways parted, so two are compared."""
    before = _state()
    left, right = before.having({"name3": _held("left")}), before.having({"name5": _held("right")})
    assert list(left.holds.apart(right.holds)) == ["name3", "name5"]


def test_a_join_holds_what_either_way_holds() -> None:
    """States over the same and states that only look alike join to the same names with the same ways, in one order."""
    before, alike = _state(), _state()
    left = before.having({"name3": _held("left"), "new": _held("new")})
    for other in (before, alike):
        met = joined_states([left, other.having({"name5": _held("right")})])
        assert met is not None
        assert list(met.holds) == [*_NAMES, "new"]
        texts = {name: [held.expr for held in met.holds[name]] for name in ("name3", "name5")}
        assert texts == {"name3": [Text("left"), Text("name3")], "name5": [Text("name5"), Text("right")]}
        assert [held.how for held in met.holds["new"]] == ["value", "given"]
