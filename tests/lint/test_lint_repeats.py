"""The same tree gives the same findings, whatever the order of sets in a process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path


def test_findings_do_not_depend_on_the_seed_of_hashes(apart: Path) -> None:
    """Fingerprints are committed to files: one cause must not have two of them."""
    program = [sys.executable, "-c", "from ecm_extract.cli import main; main()"]
    outputs = set()
    for seed in ("1", "2"):
        arguments = ["lint", "--preview", str(apart), "--format", "json", "--fail-on", "never"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        done = subprocess.run([*program, *arguments], capture_output=True, check=True, env=environment)
        outputs.add(done.stdout)
    assert len(outputs) == 1
