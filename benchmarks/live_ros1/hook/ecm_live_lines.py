"""Which lines of the trees run: what a line that never ran would register is not missing."""

import os
import sys
import threading
from pathlib import Path


def note_lines(trees, path):
    """Write each line of the trees, `file:number`, when it runs for the first time.

    Args:
        trees: a path list.
        path: file that is written at once, as nodes are killed.
    """
    inside = tuple(f"{os.path.realpath(tree)}/" for tree in trees.split(os.pathsep))
    seen = set()
    out = Path(path).open("a", buffering=1, encoding="utf-8")  # noqa: SIM115  (as long as the node runs)

    def of_line(frame, _event, _given):
        key = (frame.f_code.co_filename, frame.f_lineno)
        if key not in seen:
            seen.add(key)
            out.write(f"{key[0]}:{key[1]}\n")
        return of_line

    def of_call(frame, event, given):
        return of_line(frame, event, given) if frame.f_code.co_filename.startswith(inside) else None

    threading.settrace(of_call)
    sys.settrace(of_call)
