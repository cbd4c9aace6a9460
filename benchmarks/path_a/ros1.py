"""A real ROS 1 master of Debian, scripts of the fixtures under it, and what their odometry says."""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from path_a.row import NotMeasured

PYTHON = "/usr/bin/python3"
PACKAGES = ("python3-rosmaster", "python3-rospy", "python3-geometry-msgs", "python3-nav-msgs")
PROGRAMS = Path(__file__).parent / "programs"


def require(modules: Sequence[str], packages: Sequence[str]) -> None:
    """Refuse to measure without Debian's packages, and say how to get them."""
    line = f"import {', '.join(modules)}"
    there = (
        Path(PYTHON).exists() and not subprocess.run([PYTHON, "-c", line], capture_output=True, check=False).returncode
    )
    if not there or shutil.which("rosmaster") is None:
        message = f"needs packages of Debian: apt-get install --no-install-recommends {' '.join(packages)}"
        raise NotMeasured(message)


class Master:
    """A master on a port of its own, with everything that was started under it."""

    def __init__(self, folder: str) -> None:
        with socket.create_server(("127.0.0.1", 0)) as listener:
            port = listener.getsockname()[1]
        self.uri = f"http://127.0.0.1:{port}"
        self._environment = {
            "PATH": os.environ["PATH"],
            "HOME": folder,
            "ROS_MASTER_URI": self.uri,
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": folder,
            "ROS_LOG_DIR": f"{folder}/log",
        }
        self._running: list[subprocess.Popen[str]] = []
        self._start(["rosmaster", "--core", "-p", str(port)])
        self._wait(port)

    def set(self, **variables: str) -> None:
        """Set variables of what is started from now on."""
        self._environment.update(variables)

    def start(
        self, script: Path, *arguments: str, cwd: str | None = None, heard: bool = False
    ) -> subprocess.Popen[str]:
        """Run a script; only what is `heard` keeps its output, as a full pipe would stop it."""
        return self._start([PYTHON, str(script), *arguments], cwd, heard)

    def output(self, script: Path, *arguments: str) -> dict[str, float | int | str]:
        """Run a program of ours to its end, and return the JSON that it prints last."""
        process = self.start(script, *arguments, heard=True)
        text, _ = process.communicate(timeout=60)
        found: dict[str, float | int | str] = json.loads(text.strip().splitlines()[-1])
        return found

    def stop(self, process: subprocess.Popen[str]) -> None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def stop_all(self) -> None:
        for process in reversed(self._running):
            if process.poll() is None:
                self.stop(process)

    def _start(self, line: list[str], cwd: str | None = None, heard: bool = False) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            line,
            env=self._environment,
            cwd=cwd,
            stdout=subprocess.PIPE if heard else subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        self._running.append(process)
        return process

    def _wait(self, port: int) -> None:
        for _ in range(200):
            try:
                socket.create_connection(("127.0.0.1", port), 0.2).close()
            except OSError:
                time.sleep(0.05)
            else:
                return
        message = "the master of Debian does not come up"
        raise NotMeasured(message)


@contextmanager
def master() -> Iterator[Master]:
    with tempfile.TemporaryDirectory() as folder:
        found = Master(folder)
        try:
            yield found
        finally:
            found.stop_all()
