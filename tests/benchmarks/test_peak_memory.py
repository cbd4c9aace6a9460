"""The memory sampler sees a command and its children."""

from __future__ import annotations

import os
import sys

import peak_memory

CHILD = "import os, time; x = bytearray(40_000_000); p = os.fork(); time.sleep(0.4); p and os.wait()"


def test_the_peaks_of_all_processes_are_summed() -> None:
    """A forked child shares its pages, which the sum counts twice and the proportional set once."""
    peak = peak_memory.run([sys.executable, "-c", CHILD], dict(os.environ))
    assert peak.processes == 2
    assert peak.largest > 40
    assert peak.sum_of_peaks > 80
    assert peak.proportional < peak.sum_of_peaks
