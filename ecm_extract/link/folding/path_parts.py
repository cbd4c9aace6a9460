"""Parts of paths in Python, with which topics are named too: `os.path.dirname(topic)`, `Path(topic).parent`.

Sources: docs.python.org, os.path and pathlib.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import PurePosixPath
from posixpath import basename, dirname, normpath
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from ecm_parsers.source.expr import Call, Expr, Member

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.values import Value
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_PATHS: Final = {
    name for name in shipped_names("link/code/library_values.toml", "slashes") if name.startswith("pathlib.")
}
_PARTS: Final[Mapping[str, Callable[[str], str]]] = MappingProxyType(
    {
        "parent": lambda text: str(PurePosixPath(text).parent),
        "name": lambda text: PurePosixPath(text).name,
        "stem": lambda text: PurePosixPath(text).stem,
        "suffix": lambda text: PurePosixPath(text).suffix,
    }
)


def _of_text(work: Callable[[str], str]) -> Callable[[list[Any]], Any]:
    return lambda data: work(data[0]) if len(data) == 1 and isinstance(data[0], str) else UNKNOWN


PATH_FUNCTIONS: Final[Mapping[str, Callable[[list[Any]], Any]]] = MappingProxyType(
    {f"os.path.{work.__name__}": _of_text(work) for work in (basename, dirname, normpath)}
)
"""What each gives of data that are known."""


def part_of_path(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a part of a path is that a call makes at this place; empty of other fields."""
    if expr.name not in _PARTS or env.func.file.language != "python" or not _is_path(expr.base, env):
        return ()
    return folder.combined([folder.fold(expr.base, env)], _of_text(_PARTS[expr.name]), expr.name)


def _is_path(expr: Expr, env: Env) -> bool:
    if isinstance(expr, Member):
        return expr.name == "parent" and _is_path(expr.base, env)
    return isinstance(expr, Call) and invocation_of(expr, env).path in _PATHS
