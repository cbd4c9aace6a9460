"""What functions of `os.path` make of a path from the root of the tree; outside of the tree nothing is known.

Source: docs.python.org, os.path.
"""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ecm_parsers.python_values import Data, Names, PyCall, Value


def of_path(call: PyCall, names: Names, line: int) -> Data:
    """Return what `basename(path)` or `os.path.dirname(path)` gives; None where that is not known.

    Args:
        call: the call; of a function that the file gives another meaning by that name nothing is known.
        names: the variables of the file.
        line: the line of the call.
    """
    function = _FUNCTIONS.get(call.name.rpartition(".")[2])
    path = call.args[0].data if len(call.args) == 1 and not call.keywords else None
    if function is None or call.name in names or not isinstance(path, str):
        return None
    return function(path, line) or None


def _itself(path: str, _: int) -> Data:
    return path


def _base(path: str, _: int) -> Data:
    return posixpath.basename(path)


def _folder(path: str, _: int) -> Data:
    return posixpath.dirname(path)


def _root_and_suffix(path: str, line: int) -> Data:
    return tuple(Value(part, line) for part in posixpath.splitext(path))


_FUNCTIONS: Mapping[str, Callable[[str, int], Data]] = MappingProxyType(
    {
        "abspath": _itself,
        "realpath": _itself,
        "basename": _base,
        "dirname": _folder,
        "splitext": _root_and_suffix,
    }
)
