"""Begins two workers that tell their numbers and then have nothing to do but wait."""

import os
import sys
import time
from functools import partial
from pathlib import Path

from ecm_extract.registry.workers import Processes


def tell(folder: str, _job: int) -> None:
    """Leave a file that is called like the process."""
    Path(folder, str(os.getpid())).touch()
    time.sleep(600)


if __name__ == "__main__":
    list(Processes(2).do(partial(tell, sys.argv[1]), [1, 2]))
