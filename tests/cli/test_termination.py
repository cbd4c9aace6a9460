"""A run that is asked to stop leaves nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path


def test_no_temporary_folder_stays(tmp_path: Path) -> None:
    """Also while git is waited for."""
    for name in ("bin", "tmp", "repo"):
        (tmp_path / name).mkdir()
    slow = tmp_path / "bin" / "git"
    subprocess.run(["git", "init", "-q"], cwd=tmp_path / "repo", check=True)
    slow.write_text("#!/bin/sh\nexec sleep 60\n")
    slow.chmod(0o755)
    environment = {**os.environ, "TMPDIR": str(tmp_path / "tmp"), "PATH": f"{slow.parent}:{os.environ['PATH']}"}
    command = [sys.executable, "-c", "from ecm_extract.cli import main; main()", "diff", "a", "b", "--repo", "repo"]
    with subprocess.Popen(command, cwd=tmp_path, env=environment) as process:
        deadline = time.monotonic() + 60
        while not any((tmp_path / "tmp").iterdir()) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert any((tmp_path / "tmp").iterdir())
        process.send_signal(signal.SIGTERM)
        assert process.wait(30) == 143
    assert not any((tmp_path / "tmp").iterdir())
