"""The summary for a person."""

from __future__ import annotations

import io
from collections.abc import Callable

import msgspec
import pytest
from extractions import BAD_MESSAGE, demo, make_extraction, make_package
from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.extraction_model import Extraction, LocatedDiagnostic
from ecm_extract.report.gaps import gaps
from ecm_extract.report.summary import print_summary
from ecm_extract.report.terminal import one_line


def summary(extraction: Extraction, width: int | None = None) -> str:
    file = io.StringIO()
    print_summary(extraction, file, width)
    return file.getvalue()


def test_summary_reads_well(golden: Callable[[str, str], None]) -> None:
    """What a person sees first."""
    golden("summary.txt", summary(demo()))


@pytest.mark.parametrize("width", [20, 40, 80])
def test_summary_fits_a_narrow_terminal(width: int) -> None:
    """No line is wider than the terminal."""
    assert max(map(len, summary(demo(), width).splitlines())) <= width


def test_summary_of_nothing() -> None:
    """A tree without modules is told, not divided by."""
    assert "0 packages" in summary(make_extraction())
    assert "modules: none" in summary(make_extraction(make_package("only_messages")))


def test_one_cause_is_one_line() -> None:
    """Many places with one cause are counted, and each of them is there to be shown."""
    second = msgspec.structs.replace(BAD_MESSAGE, path="z.msg")
    found = gaps(make_extraction(diagnostics=(BAD_MESSAGE, second)))
    assert [(gap.count, [spot.place for spot in gap.spots]) for gap in found] == [(2, ["base/msg/A.msg:3", "z.msg:3"])]


def test_places_of_a_cause_are_shown_with_their_lines() -> None:
    """One of 804 said nothing of where the other 803 are."""
    every = tuple(msgspec.structs.replace(BAD_MESSAGE, path=f"m{number}.msg") for number in range(7))
    text = summary(make_extraction(diagnostics=every))
    assert [f"m{number}.msg:3" in text for number in range(7)] == [True] * 5 + [False] * 2
    assert "and 2 more places" in text


def test_no_colour_in_a_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """Escape sequences are for terminals, and NO_COLOR turns them off there."""
    assert "\x1b" not in summary(demo())
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "\x1b" in summary(demo())
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[3" not in summary(demo())


@settings(max_examples=30, deadline=None)
@given(st.text(st.characters(codec=None)))
def test_names_cannot_act_on_the_terminal(name: str) -> None:
    """Control characters in a path or message are not passed on."""
    diagnostic = LocatedDiagnostic("error", name, name + "\x1b]0;evil\x07", 1, name + "\x9b31m")
    extraction = msgspec.structs.replace(make_extraction(diagnostics=(diagnostic,)), path=name)
    text = summary(extraction)
    assert all(one_line(line, 10_000) == line for line in text.split("\n"))
