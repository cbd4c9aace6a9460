"""A branch is decided when somebody wants to know what depends on it, and only then."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from ecm_parsers.source.expr import Constant, Text

from ecm_extract.infer.held import Held, State, Turn, joined_states
from ecm_extract.infer.routes import START, Gate, met_routes
from ecm_extract.infer.run import Run
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.link.running.decisions import Decisions
from ecm_extract.link.running.env import Env
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

_SOURCE = """
def kind():
    return "b"

def topic(given):
    if given == "off":
        return
    name = "one"
    if kind() == "b":
        name = "two"
    other = "three"
    if given:
        other = "four"
    if kind() == "c":
        raise ValueError()
    last = "five"
    use(name, other, last)
"""


def _linker(workspace: Any, source: str) -> Linker:
    workspace.package({"pkg/driver.py": source}, name="pkg")
    return Linker(Reader(open_tree(workspace.root), False, (), None).read(1, None), form_table(()))


def _function(linker: Linker, name: str) -> Func:
    return next(func for func in linker.program.functions[name] if func.fact.body)


def _gates(run: Run) -> Sequence[Gate]:
    found = (turn.gate for states in run.states.values() for state in states for turn in state.path)
    return list(dict.fromkeys(gate for gate in found if gate is not None))


@pytest.fixture
def linker(workspace: Any) -> Linker:
    """A program with a function that asks four things."""
    return _linker(workspace, _SOURCE)


def _place(linker: Linker) -> Env:
    func = _function(linker, "topic")
    return Env(func, len(func.fact.body) - 1)


@pytest.mark.parametrize(
    ("name", "texts", "decided"),
    [("last", {"five"}, 0), ("name", {"two"}, 1), ("other", {"three", "four"}, 1)],
)
def test_only_what_a_variable_depends_on_is_decided(linker: Linker, name: str, texts: set[str], decided: int) -> None:
    """Of four branches a variable asks for those at which it was given something else."""
    place = _place(linker)
    run = linker.folder.flow.run(place)
    assert run is not None
    gates = _gates(run)
    assert [gate.found for gate in gates] == [None] * 4
    found = linker.folder.held.of([run.states[place.at][0].holds[name]], place)
    assert {value.text for value in found} == texts
    assert sum(gate.found is not None for gate in gates) == decided


def test_whether_a_place_is_reached_asks_what_leads_there(linker: Linker) -> None:
    """A place behind two branches that may leave asks those, and tells the one that nobody decides."""
    place = _place(linker)
    flow = linker.folder.flow
    state = flow.states(place)[0]
    assert flow.is_reached(place)
    assert [turn.left for turn in flow.decisions.turns(state.path)] == ["return"]


def _side(state: State, holds: bool, gate: Gate) -> State:
    return state.on(Turn(gate.test, holds, gate.env, gate=gate))


def test_both_sides_of_a_branch_lead_to_where_it_was_come_from(linker: Linker) -> None:
    """Behind a branch that nothing left by, nobody has to know how it was decided to know whether it is reached."""
    gate = Gate(Constant("true"), _place(linker))
    one, other = _side(State(), True, gate), _side(State(), False, gate)
    assert met_routes(one.route, other.route) is START
    nested = Gate(Constant("false"), _place(linker))
    inner = joined_states([_side(one, True, nested), _side(one, False, nested)])
    met = joined_states([inner, other])
    assert met is not None
    assert met.route is START


def test_what_is_surely_not_taken_gives_a_variable_nothing(linker: Linker) -> None:
    """A variable holds what it was given on the side that is taken; on both where nobody knows."""
    place = _place(linker)
    decisions: Decisions = linker.folder.flow.decisions
    for test, texts in ((Constant("true"), ["a"]), (Constant("false"), ["b"])):
        gate = Gate(test, place)
        sides = [
            _side(State(), holds, gate).having({"x": (Held("value", "x", Text(text)),)})
            for holds, text in ((True, "a"), (False, "b"))
        ]
        met = joined_states(sides)
        assert met is not None
        assert [held.expr for held in decisions.ways(met.holds["x"])] == [Text(text) for text in texts]


def test_thousands_of_branches_one_after_the_other_are_no_deep_recursion(linker: Linker) -> None:
    """What met again and again, and a place behind as many ways out, is asked for without nesting."""
    place = _place(linker)
    decisions = linker.folder.flow.decisions
    state: State | None = State().having({"x": (Held("value", "x", Text("start")),)})
    passed = State()
    for number in range(5_000):
        gate = Gate(Constant("false" if number else "true"), place)
        assert state is not None
        changed = _side(state, True, gate).having({"x": (Held("value", "x", Text(str(number))),)})
        state = joined_states([changed, _side(state, False, gate)])
        passed = _side(passed, not number, gate)
    assert state is not None
    assert [held.expr for held in decisions.ways(state.holds["x"])] == [Text("0")]
    assert decisions.is_live(passed.route)


def test_what_one_question_costs_is_not_taken_from_the_next(workspace: Any) -> None:
    """However many branches were decided, one after the other, the next is decided too."""
    asked = "".join(f"    if weight({number}) > 90:\n        name = 'heavy'\n" for number in range(120))
    source = (
        "def doubled(number):\n    return number * 2\n"
        "def weight(number):\n    found = doubled(number)\n    if found > 80:\n        found = 80\n    return found\n"
        f"def topic():\n    name = 'light'\n{asked}    return name\n"
    )
    linker = _linker(workspace, source)
    run = linker.folder.flow.run(Env(_function(linker, "topic")))
    assert run is not None
    assert {linker.folder.flow.decisions.of(gate).holds for gate in _gates(run)} == {False}
