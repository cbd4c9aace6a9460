"""Variables of Python that nobody has given anything on some way: whoever reads one there raises, and makes nothing.

Source: docs.python.org, "Naming and binding": a name that is not bound raises `NameError`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Constant, Name
from ecm_parsers.source.flow import Block, Switch, steps
from ecm_parsers.source.python_names import BUILT_IN, OPEN_NAMES

from ecm_extract.infer.held import Held
from ecm_extract.link.code.units import File, Func
from ecm_extract.link.running.handled_names import handled_names

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

Ways = tuple[Held, ...]


class UnsetVariables:
    """Tells which ways to a place leave a variable without anything; each variable is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[Func, str], bool] = {}
        self._open: dict[File, bool] = {}
        self._handled: dict[File, Set[str]] = {}

    def without(self, ways: Sequence[Ways], func: Func) -> list[Ways]:
        """Return what a variable may hold in states of a function, without those in which reading it raises.

        All of them are returned where nobody gives the variable anything in any state.
        """
        if func.file.language != "python":
            return list(ways)
        left = [tuple([held for held in helds if not self._is_unset(held, func)]) for helds in ways]
        return [helds for helds in left if helds] or list(ways)

    def _is_unset(self, held: Held, func: Func) -> bool:
        return held.how == "given" and not held.before and self._is_alone(held.name, func)

    def _is_alone(self, name: str, func: Func) -> bool:
        """Whether nothing but the statements of a function gives its variable anything."""
        key = (func, name)
        if key not in self._known:
            outline = self.folder.flow.outline(func)
            own = name in outline.effects.own and name not in func.given and name not in outline.bound_inside
            own = own and not self._is_bound_otherwise(name, func.file) and not _has_match(func.fact.flow or ())
            own = own and name not in self._handled_in(func.file)
            self._known[key] = own and not (outline.is_module and self._may_be_set(name, func.file))
        return self._known[key]

    def _is_bound_otherwise(self, name: str, file: File) -> bool:
        """Whether a file has an import, a function or a class of a name, whatever their scope."""
        program = self.folder.program
        functions = {func.fact.name for func in program.functions_in(file)}
        return name in file.imported or name in functions or name in {cls.fact.name for cls in program.classes_in(file)}

    def _handled_in(self, file: File) -> Set[str]:
        if file not in self._handled:
            exceptions, functions = self.folder.flow.exceptions, self.folder.program.functions_in(file)
            self._handled[file] = {name for func in functions for name in handled_names(func, exceptions)}
        return self._handled[file]

    def _may_be_set(self, name: str, file: File) -> bool:
        """Whether others than the body of a module may give its variable something, or Python has one of that name."""
        functions = self.folder.program.functions_in(file)
        shared = any(name in func.fact.shared for func in functions)
        outside = bool(self.folder.scope.assigned_outside(name, "python"))
        if file not in self._open:
            self._open[file] = any(entry.name == "*" for entry in file.facts.imports) or _asks_by_name(functions)
        return shared or outside or name in BUILT_IN or self._open[file]


def _asks_by_name(functions: Iterable[Func]) -> bool:
    """Whether functions call what may bind names while it runs, as `globals` does."""
    calls = (call for func in functions for group in func.calls for call in group)
    return any(isinstance(call.callee, Name) and call.callee.id in OPEN_NAMES for call in calls)


def _has_match(block: Block) -> bool:
    """Whether a block has a `match`, whose patterns bind names; a chain of `elif` asks for what is true."""
    return any(isinstance(step, Switch) and step.subject != Constant("true") for step in steps(block))
