"""Methods that begin with a new object: a framework calls them first, and once, so what others change later is not yet.

Sources: see `hosts.toml`.
"""

from __future__ import annotations

from collections.abc import Mapping, Set
from functools import cache
from typing import TYPE_CHECKING

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.bases_outside import bases_outside
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


@cache
def _first() -> Mapping[str, Set[str]]:
    return {name: frozenset(methods) for name, methods in shipped("link/running/hosts.toml")["first"].items()}


class FirstMethods:
    """Tells which methods of C++ find an object as it was made; each is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Func, bool] = {}

    def is_first(self, func: Func) -> bool:
        """Tell whether a method runs before any other of its object but constructors: nobody in the tree calls it."""
        known = self._known.get(func)
        if known is None:
            known = self._known[func] = func.file.language == "cpp" and self._is_called_first(func)
        return known

    def finds_new(self, func: Func, name: str) -> bool:
        """Tell whether a function begins with a member as it is declared, which no constructor gives anything else."""
        return func.is_constructor or (self.is_first(func) and self._is_left(func, name))

    def _is_left(self, func: Func, name: str) -> bool:
        """Whether the constructors that run before leave a member and its fields alone, and call no function."""
        program, flow = self.folder.program, self.folder.flow
        lineage = (*program.ancestry(func.cls), *program.derived(func.cls)) if func.cls is not None else ()
        makers = (Env(each, this=entry) for entry in lineage for each in entry.constructors if each.fact.body)
        ends = [run.end if run is not None else None for run in map(flow.run, makers)]
        key = f".{name}"
        return all(
            end is not None and not end.called and not any(f"{each}.".startswith(f"{key}.") for each in end.holds)
            for end in ends
        )

    def _is_called_first(self, func: Func) -> bool:
        if func.cls is None or not any(func.fact.name in _first().get(each, ()) for each in self._hosts(func.cls)):
            return False
        return next(self.folder.states.callers.all(func), None) is None

    def _hosts(self, cls: Cls) -> Set[str]:
        """The names of the bases outside of the tree."""
        return set(map(last_name, bases_outside(cls, self.folder.program)))
