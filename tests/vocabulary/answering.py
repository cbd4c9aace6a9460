"""Answers command lines, each in a fork of one process that has imported the tool once."""

from __future__ import annotations

import json
import os
import sys
from typing import IO, Final

_HEAVY: Final = ("diff.run", "extraction_run", "lint.catalogue", "lint.linted", "stored", "system.system")


def answer(words: list[str], at: str, out: str, err: str) -> int:
    """Run a command line in a folder, in a fork that writes to files; return its status."""
    child = os.fork()
    if child == 0:
        os.chdir(at)
        for number, path in ((1, out), (2, err)):
            os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        sys.argv = ["ecm-extract", *words]
        from ecm_extract.cli import main

        main()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def serve(asked: IO[str], told: IO[str]) -> None:
    """Answer each line of JSON with the status of what it asks for."""
    for line in asked:
        told.write(f"{answer(**json.loads(line))}\n")
        told.flush()


if __name__ == "__main__":
    for name in _HEAVY:
        __import__(f"ecm_extract.{name}")
    serve(sys.stdin, sys.stdout)
