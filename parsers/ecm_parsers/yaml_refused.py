"""YAML that no reader takes: neither libyaml nor the reader in Python, which rosparam and ROS 2 load files with."""

from __future__ import annotations

from typing import Any, Final

import yaml

from ecm_parsers.result import Diagnostic, diagnostic
from ecm_parsers.text import decode

MAX_BYTES: Final = 1_000_000
"""Of larger files nothing is said: the reader in Python is slow, and what is so large was written by a program."""
CODE: Final = "yaml-refused"
_OWN_BOUND: Final = "exceeded maximum nesting depth"
_OF_OPENCV: Final = "%YAML:"
"""How a file of cv::FileStorage begins, whose reader is another one."""
_LOADERS: Final[tuple[Any, ...]] = (getattr(yaml, "CSafeLoader", yaml.SafeLoader), yaml.SafeLoader)


def refused_by_every_yaml(data: bytes) -> Diagnostic | None:
    """Return the first problem for which no reader of YAML takes a file, None where one does or may."""
    if len(data) > MAX_BYTES:
        return None
    text, _ = decode(data)
    found: Diagnostic | None = None
    for loader in reversed(dict.fromkeys(reversed(_LOADERS))):
        found = _problem(text, loader)
        if found is None:
            return None
    return found


def _problem(text: str, loader: Any) -> Diagnostic | None:
    try:
        for _ in yaml.parse(text, Loader=loader):
            pass
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark is not None else 1
        wrong = str(error.problem or error.context)
        if wrong == _OWN_BOUND or _is_of_another(text, line):
            return None
        return diagnostic("error", CODE, min(line, text.count("\n") + 1), wrong, "Correct the line")
    except (yaml.YAMLError, UnicodeError, ValueError, RecursionError):
        return None
    return None


def _is_of_another(text: str, line: int) -> bool:
    """Whether the line says that the file is none of YAML, or is to be replaced by something."""
    written = text.split("\n")[line - 1 : line]
    return any(each.startswith(_OF_OPENCV) or "$(" in each or "${" in each for each in written)
