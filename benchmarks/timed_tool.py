"""The installed command, run several times in an environment whose cache folder is a temporary one."""

from __future__ import annotations

import os
import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from extracted import command

RUNS = 3


def best(action: Callable[[], None], before: Callable[[], None] = lambda: None) -> float:
    """Seconds of the fastest of three runs; what is done `before` each does not count."""
    times = []
    for _ in range(RUNS):
        before()
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


class Tool:
    """Runs command lines and takes their time."""

    def __init__(self, cache: Path) -> None:
        self.cache = cache
        # An installed package has its bytecode; where Python may not write it, each run would compile the tool anew.
        inherited = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        self.environment = {**inherited, "ECM_CACHE_DIR": str(cache)}

    def extraction(self, root: str, *options: str) -> list[str]:
        """Command line of an extraction."""
        return [command(), "extract", root, "--format", "json", "-o", "-", *options]

    def run(self, line: list[str]) -> None:
        """Run once; a status above 1 ends the benchmark."""
        done = subprocess.run(line, env=self.environment, capture_output=True, check=False)
        if done.returncode > 1:
            sys.exit(f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")

    def cold(self, line: list[str]) -> float:
        """Seconds without the cache."""
        return best(lambda: self.run([*line, "--no-cache"]))

    def filled(self, line: list[str]) -> float:
        """Seconds of a run that finds the cache empty and fills it."""
        return best(lambda: self.run(line), before=self.forget)

    def known(self, line: list[str]) -> float:
        """Seconds of a run that finds the facts of all source files, and nothing else."""
        self.run(line)
        return best(lambda: self.run(line), before=self.forget_results)

    def warm(self, line: list[str]) -> float:
        """Seconds of a run after one that filled the cache."""
        self.run(line)
        return best(lambda: self.run(line))

    def forget(self) -> None:
        """Empty the cache."""
        shutil.rmtree(self.cache, ignore_errors=True)

    def forget_results(self) -> None:
        """Leave only the facts of source files in the cache."""
        for file in self.cache.glob("*.sqlite"):
            with closing(sqlite3.connect(file)) as connection, connection:
                connection.execute("DELETE FROM entries WHERE key NOT LIKE 'facts %'")
