"""A seeded part of the programs that are run for real: what they did is contained, and equal where it is folded."""

from __future__ import annotations

import shutil

import pytest
from executed_values import Judged, judged, judged_combined


def _wrong(lines: list[Judged]) -> list[Judged]:
    return [line for line in lines if not line.contained or not line.right]


def test_python_programs_do_what_is_told() -> None:
    """No name is claimed that a run does not make, and none is made that is not told."""
    lines = list(judged("python", [f"suite_{number}" for number in range(12)]))
    assert len(lines) > 20
    assert not _wrong(lines)


@pytest.mark.skipif(shutil.which("g++") is None, reason="no g++ here")
def test_cpp_programs_do_what_is_told() -> None:
    """The same for C++, where a compiler is there."""
    lines = list(judged("cpp", [f"suite_{number}" for number in range(6)]))
    assert len(lines) > 10
    assert not _wrong(lines)


def test_combined_python_programs_do_what_is_told() -> None:
    """What holds a text, what changes it and who reads it: none is told as it was before, as proved."""
    lines = list(judged_combined("python", 25, "suite"))
    assert len(lines) > 20
    assert not _wrong(lines)


@pytest.mark.skipif(shutil.which("g++") is None, reason="no g++ here")
def test_combined_cpp_programs_do_what_is_told() -> None:
    """The same for C++."""
    lines = list(judged_combined("cpp", 25, "suite"))
    assert len(lines) > 20
    assert not _wrong(lines)
