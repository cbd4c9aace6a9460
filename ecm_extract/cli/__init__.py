"""The command line. Importing it imports nothing else, so that `--version` answers at once."""

from __future__ import annotations

import sys


def main() -> None:
    """Run `ecm-extract` with the arguments of the process and leave with its exit status."""
    from ecm_extract.cli.run import run

    sys.exit(run(sys.argv[1:]))
