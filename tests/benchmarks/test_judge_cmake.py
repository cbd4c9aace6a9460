"""Our reading of CMake against what CMake said of drawn projects: a small part of `benchmarks/judge_cmake.py`.

The answers were recorded by `judge_cmake.py --seed 1000 --count 12 --recorded tests/benchmarks/cmake_answers`.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from cmake_oracle import Oracle, Truth
from cmake_projects import make
from judge_cmake import compare, told_of, write

ANSWERS = sorted((Path(__file__).parent / "cmake_answers").glob("*.json"))


def _answer(path: Path) -> Truth:
    document = json.loads(path.read_text("utf-8"))
    if isinstance(document, str):
        pytest.skip("CMake refuses this project")
    return Truth.of(document)


@pytest.mark.parametrize("path", ANSWERS, ids=lambda path: path.stem)
def test_what_is_told_is_what_cmake_has(path: Path, tmp_path: Path) -> None:
    """Targets, sources and installs are equal, or said not to be known; and few are not known."""
    truth = _answer(path)
    write(make(int(path.stem)), tmp_path)
    told = told_of(tmp_path)
    outcomes = [outcome for kind in ("target", "install") for outcome in compare(kind, told, truth)]
    assert [outcome for outcome in outcomes if outcome[0] in {"wrong", "missing"}] == []
    assert sum(outcome[0] == "equal" for outcome in outcomes) > len(outcomes) / 2


@pytest.mark.skipif(not all(map(shutil.which, ("cmake", "ninja", "c++"))), reason="needs cmake, ninja and a compiler")
def test_the_recorded_answers_are_those_of_cmake(tmp_path: Path) -> None:
    """The program that is installed says what was recorded."""
    path = next(each for each in ANSWERS if each.read_text("utf-8").startswith("{"))
    write(make(int(path.stem)), tmp_path / "project")
    said = Oracle(str(shutil.which("cmake")), tmp_path / "build").ask(tmp_path / "project")
    assert not isinstance(said, str), said
    truth = _answer(path)
    assert said.installs == truth.installs
    assert {name: each.sources for name, each in said.targets.items()} == {
        name: each.sources for name, each in truth.targets.items()
    }
