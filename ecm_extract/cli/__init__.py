"""The command line. Importing it imports nothing else, so that `--version` answers at once."""

from __future__ import annotations

import gc
import os
import sys


def main() -> None:
    """Run `ecm-extract` with the arguments of the process and leave with its exit status.

    The process ends with the run: nothing is gained by collecting garbage in between, or by taking a million
    records apart before the memory goes back anyway (0.2 s on a large repository).
    """
    try:
        from ecm_extract.cli.run import run
        from ecm_extract.cli.streams import flush_streams

        gc.disable()
        status = run(sys.argv[1:])
        flush_streams()
    except KeyboardInterrupt:  # before or after the run itself, which tells of it
        status = 130
    os._exit(status)
