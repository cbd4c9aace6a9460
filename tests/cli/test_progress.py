"""The progress bar."""

from __future__ import annotations

import io
import os
import sys
import time

import pytest

from ecm_extract.cli.progress import progress_bar


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def open_terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    return terminal


def test_no_bar_in_a_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """A log has no bars."""
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with progress_bar() as progress:
        assert progress is None


def test_no_bar_for_a_short_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """What takes less than a second does not flicker."""
    terminal = open_terminal(monkeypatch)
    with progress_bar() as progress:
        assert progress is not None
        progress(1, 2)
    assert terminal.getvalue() == ""


def test_a_bar_for_a_long_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """After a second it shows how many files are done."""
    terminal = open_terminal(monkeypatch)
    monkeypatch.setattr("ecm_extract.cli.progress._PATIENCE", 0.0)
    with progress_bar() as progress:
        assert progress is not None
        for done in range(20):
            time.sleep(0.02)
            progress(done, 20)
    assert "reading files" in terminal.getvalue()


def test_a_bar_for_work_that_counts_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A warm lint reads no file, and still takes its time."""
    terminal = open_terminal(monkeypatch)
    monkeypatch.setattr("ecm_extract.cli.progress._PATIENCE", 0.0)
    with progress_bar():
        time.sleep(0.3)
    assert "working" in terminal.getvalue()


def test_a_fork_does_not_draw(monkeypatch: pytest.MonkeyPatch) -> None:
    """The base of a comparison is read in another process: two bars would write over each other."""
    open_terminal(monkeypatch)
    with progress_bar() as progress:
        assert progress is not None
        monkeypatch.setattr(os, "getpid", lambda: -1)
        monkeypatch.setattr(progress, "_lock", None)  # that a bar of this process may hold
        progress(1, 2)
