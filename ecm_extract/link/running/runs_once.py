"""Functions that a program runs at most once: its `main`, and what one statement of such a function calls.

What a library has may be called by programs outside of the tree, which nobody sees: only functions of the file of a
`main`, and those that no other file can name, are told of.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call
from ecm_parsers.source.flow import Block, Later, Loop, blocks, statements, steps

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import calls_in, last_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_MAIN: Final = "main"
_HIDDEN: Final = frozenset({"anonymous"})
"""Traits of functions that no other file can name."""


class RunsOnce:
    """Tells how often programs run functions of C++; each is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Func, bool] = {}
        self._never: dict[Func, bool] = {}

    def of(self, func: Func) -> bool:
        """Tell whether no program runs a function more than once."""
        known = self._known.get(func)
        if known is None:
            self._known[func] = False  # who asks in a circle
            known = self._known[func] = self._is_once(func)
        return known

    def never(self, func: Func) -> bool:
        """Tell whether nobody in the tree runs a free function of C++, or hands it to anybody."""
        known = self._never.get(func)
        if known is None:
            callers = self.folder.states.callers
            free = callers.find is not None and _is_free(func) and not is_main(func) and not callers.is_handed(func)
            known = self._never[func] = free and self._is_of_program(func) and not self._mentions(func)
        return known

    def only_call(self, func: Func) -> Invocation | None:
        """Return the one call of a function that programs run at most once; None of `main`, and of all others."""
        calls = self._calls(func) if self.of(func) and not is_main(func) else []
        return calls[0] if calls else None

    def _is_once(self, func: Func) -> bool:
        if func.file.language != "cpp":
            return False
        if is_main(func):
            return True
        if not self._is_of_program(func):
            return False
        calls = self._calls(func)
        if len(calls) != 1 or func.fact.name in self.called_by_declarations:
            return False
        call = calls[0]
        return self.folder.states.callers.is_straight(call) and _is_single(call, func.fact.name) and self.of(call.func)

    def _is_of_program(self, func: Func) -> bool:
        """Whether nobody outside of the tree can call a function."""
        return not _HIDDEN.isdisjoint(func.fact.traits) or any(
            map(is_main, self.folder.program.functions_in(func.file))
        )

    def _calls(self, func: Func) -> list[Invocation]:
        """All calls of a function, none where somebody else may call it."""
        callers = self.folder.states.callers
        if func.cls is not None:
            return [call for call, _ in callers.of(func) or ()]
        if not _is_free(func) or callers.is_handed(func):
            return []
        return [call for call, _ in callers.all(func)]

    def _mentions(self, func: Func) -> bool:
        if func.fact.name in self.called_by_declarations:
            return True
        return any(True for _ in self.folder.states.callers.all(func))

    @cached_property
    def called_by_declarations(self) -> Set[str]:
        """The functions that defaults of parameters and members, and values of variables, call."""
        program = self.folder.program
        functions = (func for group in program.functions.values() for func in group)
        classes = (cls for group in program.classes.values() for cls in group)
        values = [parameter.default for func in functions for parameter in func.fact.params]
        values += [field.default for cls in classes for field in cls.fact.fields]
        values += [constant.value for group in program.constants.values() for _, constant in group]
        return frozenset(last_of(call.callee) for value in values for call in calls_in(value))


def is_main(func: Func) -> bool:
    """Tell whether a function is where a program of C++ begins."""
    return _is_free(func) and func.fact.name == _MAIN and not func.fact.scope


def _is_free(func: Func) -> bool:
    """Whether a function of C++ belongs to no class and to no other function."""
    fact = func.fact
    odd = fact.name.startswith(("operator", "~")) or fact.decorators or "lambda" in fact.traits
    return func.file.language == "cpp" and func.cls is None and not odd


def _is_single(call: Invocation, name: str) -> bool:
    """Whether a statement that calls a function stands in no loop, and is the only place that names it there."""
    flow = call.func.fact.flow or ()
    repeated = {at for loop in _loops(flow) for block in blocks(loop) for at in statements(block)}
    calls = [each for group in call.func.calls for each in group] + list(_tests(call.func))
    return call.at not in repeated and sum(last_of(each.callee) == name for each in calls) == 1


def _tests(func: Func) -> Iterator[Call]:
    """Yield the calls in the conditions of a function's loops."""
    for loop in _loops(func.fact.flow or ()):
        yield from calls_in(loop.test) if isinstance(loop, Loop) else ()


def _loops(block: Block) -> Iterator[Loop | Later]:
    return (step for step in steps(block) if isinstance(step, Loop | Later))
