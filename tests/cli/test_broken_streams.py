"""Streams that are closed or full, and runs that are interrupted: a status, one sentence, and nothing left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ecm_extract.parallel_work import Background
from ecm_extract.processes import end_forks, forked

ROOT = Path(__file__).parent.parent.parent
DEMO = str(ROOT / "fixtures" / "demo_robot")
PROGRAM = f"{sys.executable} -c 'from ecm_extract.cli import main; main()'"
COMMANDS = ["rules", f"{DEMO} --format json -o -", f"lint {DEMO} --select LNT004", f"lint {DEMO} --format json"]


def shell(line: str) -> tuple[int, str]:
    done = subprocess.run(line, shell=True, capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


@pytest.mark.parametrize("command", COMMANDS)
def test_closed_standard_output(command: str) -> None:
    """Nobody could read the result, so the command line is wrong: never the status of findings."""
    status, err = shell(f"{PROGRAM} {command} >&-")
    assert status == 2
    assert err.startswith("error: standard output is closed\nhint: ")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk(command: str) -> None:
    """It is no bug of this program, and no finding."""
    status, err = shell(f"{PROGRAM} {command} >/dev/full")
    assert status == 3
    assert "error: cannot write: No space left on device\nhint: make room" in err
    assert "bug" not in err
    assert "Traceback" not in err


@pytest.mark.parametrize(
    ("line", "status"), [("rules 2>&-", 0), ("lint --select none 2>&-", 2), ("rules >&- 2>&- <&-", 2)]
)
def test_nobody_to_tell(line: str, status: int) -> None:
    """A closed standard error costs the words, not the status."""
    assert shell(f"{PROGRAM} {line}") == (status, "")


def test_closed_standard_input_is_an_empty_patch() -> None:
    """What is not there cannot be read."""
    status, said = shell(f"{PROGRAM} lint {DEMO} --patch - --preview <&-")
    assert (status, said) == (0, "nothing found\n")


def test_an_error_in_a_fork_is_told_once_by_the_parent(capfd: pytest.CaptureFixture[str]) -> None:
    """`lint --base` on a ref that cannot be listed showed the traceback of the other process."""

    def work() -> None:
        message = "cannot be listed"
        raise ValueError(message)

    with pytest.raises(ValueError, match="cannot be listed"):
        Background(work).result()
    assert capfd.readouterr().err == ""


def test_an_interrupted_fork_unwinds_without_a_word(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Its folders go, and no traceback is shown beside the sentence of the run."""
    begun, gone = tmp_path / "begun", tmp_path / "gone"

    def work() -> None:
        try:
            begun.touch()
            time.sleep(60)
        finally:
            gone.touch()

    process = forked(work)
    while not begun.exists():
        time.sleep(0.01)
    os.kill(process.pid or 0, signal.SIGINT)
    process.join(60)
    assert gone.exists()
    assert process.exitcode == 130
    assert capfd.readouterr().err == ""


def test_forks_end_with_their_parent() -> None:
    """A run that ends early leaves no process behind."""
    process = forked(time.sleep, 60)
    end_forks()
    assert process.exitcode is not None


@pytest.mark.parametrize(
    ("number", "status", "said"), [("SIGINT", 130, "interrupted"), ("SIGTERM", 143, "asked to stop")]
)
def test_an_interrupted_run_says_one_sentence(number: str, status: int, said: str) -> None:
    """No traceback, whatever was under way."""
    code = (
        "import os, signal, sys, time\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"  # a shell lets its background jobs ignore it
        "import ecm_extract.tree\n"
        "from ecm_extract.cli import main\n"
        "def stopped(*_):\n"
        f"    os.kill(os.getpid(), signal.{number})\n"
        "    time.sleep(60)\n"
        "ecm_extract.tree.open_tree = stopped\n"
        f"sys.argv = ['ecm-extract', 'lint', {DEMO!r}]\n"
        "main()\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (status, "")
    assert done.stderr.strip() == f"error: {said}"
