"""Files of a tree held in memory, for tests of descriptions."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from fnmatch import fnmatchcase


class MemoryFiles:
    """Files by path; a package is a top folder."""

    def __init__(self, texts: Mapping[str, str | bytes], ros: int | None = None) -> None:
        self._ros = ros
        self._texts = {path: text.encode() if isinstance(text, str) else text for path, text in texts.items()}

    def share(self, package: str) -> str | None:
        return f"tree:{package}" if any(path.startswith(f"{package}/") for path in self._texts) else None

    def folder(self, path: str) -> str:
        return "tree:" + path.rpartition("/")[0]

    def find(self, text: str) -> str | None:
        path = posixpath.normpath(text.removeprefix("tree:").lstrip("/"))
        return path if path in self._texts else None

    def candidates(self, text: str) -> list[str]:
        pattern = re.sub(r"\{[^}]*\}", "*", posixpath.normpath(text.removeprefix("tree:").lstrip("/")))
        return sorted(path for path in self._texts if fnmatchcase(path, pattern))

    def read(self, path: str) -> bytes | None:
        return self._texts.get(path)

    def globbed(self, text: str) -> list[str]:
        pattern = text.removeprefix("tree:")
        fitting = (path for path in self._texts if path.count("/") == pattern.count("/"))
        return sorted(path for path in fitting if fnmatchcase(path, pattern))

    def ros_of(self, path: str) -> int | None:
        del path
        return self._ros


def robot(body: str) -> str:
    """Return a xacro document."""
    return f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{body}</robot>'
