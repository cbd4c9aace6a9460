"""One function that takes all evaluations there are leaves the others theirs."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from ecm_extract.link.code.units import Func
from ecm_extract.link.folding import steps as bounds
from ecm_extract.link.folding.steps import Steps
from ecm_extract.link.running.env import Env


def _place(path: str) -> Env:
    fact, file = SimpleNamespace(body=(), line=1), SimpleNamespace(path=path)
    return Env(Func(cast("Any", fact), cast("Any", file)), 0)


def _ask(steps: Steps, asker: Env, other: Env, times: int) -> bool:
    """A question of one function, for which a run of another one asks many of its own."""
    allowed = steps.take(asker)
    with steps, steps.apart():
        for _ in range(times):
            allowed = steps.take(other) and allowed
    return allowed


def test_what_a_function_asks_is_bounded_and_what_others_ask_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    """Evaluations that are made apart are paid for by who asked, so that another function is still answered."""
    monkeypatch.setattr(bounds, "MAX_FUNCTION", 100)
    steps, heavy, light = Steps(0), _place("heavy.cpp"), _place("light.cpp")
    assert not _ask(steps, heavy, light, 200)
    assert not steps.take(heavy)
    assert steps.take(light)
    assert [entry.path for entry in steps.left_out()] == ["light.cpp", "heavy.cpp"]


def test_a_whole_run_is_bounded_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many functions that take much each end like one."""
    monkeypatch.setattr(bounds, "LEAST_RUN", 100)
    steps = Steps(0)
    assert [steps.take(_place(f"{at}.cpp")) for at in range(200)].count(True) == 100
