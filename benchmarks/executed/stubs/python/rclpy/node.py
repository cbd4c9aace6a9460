import sys
from pathlib import Path


def _lines(frame):
    lines = []
    while frame is not None:
        lines.insert(0, frame.f_lineno)
        frame = frame.f_back
    return lines


class Node:
    def __init__(self, name):
        self._made = [str(line) for line in _lines(sys._getframe(1))]

    def create_publisher(self, kind, name, qos):
        frame = sys._getframe(1)
        path = Path(frame.f_code.co_filename).name
        print(path, ",".join([*self._made, *map(str, _lines(frame))]), name, sep="\t")
