"""Bounds of the runs of functions: what is beyond counts as unknown."""

from __future__ import annotations

MAX_WITHIN = 100
"""Runs that one run leads to, directly or through others."""
MAX_RECURSION = 2
"""Runs of a function within runs of itself."""
MAX_RUNS = 5_000
"""Runs with arguments that are remembered."""
MAX_FRAMES = 6_000
"""Calls within calls: our own bounds (MAX_DEPTH, MAX_RUNNING, MAX_NESTING) end before that, the default does not."""
MAX_RUNNING = 8
"""Runs within runs: what a function is called with may be what another function does."""
