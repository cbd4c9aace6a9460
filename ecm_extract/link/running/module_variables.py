"""What variables of Python modules hold: what the body of the module leaves, and what functions give them."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import TYPE_CHECKING

from ecm_extract.link.code.units import File, Func
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.named_globals import NamedGlobals
from ecm_extract.link.running.values import Value, alternatives, circular, is_circle, setting, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ModuleVariables:
    """Evaluates variables that functions of their module may assign to (`global x`).

    A function that assigns what it is given is asked for by its calls; where the tree has none, somebody outside may
    set the variable, which holds what the module gives it until then.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.named = NamedGlobals(folder)
        self._known: dict[Hashable, tuple[Value, ...]] = {}

    def forget(self) -> None:
        """Drop what is remembered, since more is known of parameters now."""
        self._known.clear()

    def changers(self, name: str, file: File) -> list[Func]:
        """Return the functions of a module that may change a variable of it: they assign it, or call a method of it.

        So do those that keep it by another name, by which somebody changes it, and who changes it by a text.
        """
        kept = {each.func for each in self.folder.kept_parts.of(name) if each.key == name}
        kept |= {*self.named.writers(name, file)}
        return [func for func in self.folder.program.functions_in(file) if func in kept or self._changes(func, name)]

    def _changes(self, func: Func, name: str) -> bool:
        outline = self.folder.flow.outline(func)
        if func.fact.name == "<module>" or name not in outline.changes:
            return False
        return name in func.fact.shared or name not in outline.effects.own

    def given(self, name: str, file: File, first: tuple[Value, ...]) -> tuple[Value, ...]:
        """Return what a variable may hold, which its module leaves as `first`."""
        fixed = not any(value.confidence == "pattern" for value in first)  # who gets a text cannot change it
        asked = ("variable", file, name)
        known = self._known.get((asked, fixed))
        if known is None:
            marks = self.folder.marks
            known = self.folder.guarded(asked, name, lambda: self._all(name, file, fixed), circular(name))
            if marks == self.folder.marks:
                self._known[asked, fixed] = known
        return alternatives([*first, *(value for value in known if not is_circle(value))]) if known else first

    def _all(self, name: str, file: File, fixed: bool) -> tuple[Value, ...]:
        named, given = self.named.writers(name, file), self.folder.flow.outline
        every = self.changers(name, file)
        giving = (func for func in every if not fixed or func in named or name in given(func).given)
        return tuple([value for func in giving for value in self._by(func, name)])

    def _by(self, func: Func, name: str) -> Iterator[Value]:
        values = self._left(name, Env(func, len(func.fact.body)))
        if not any(value.open("param") for value in values):
            yield from values
            return
        callers = tuple(self.folder.states.callers.all(func))
        for call, place in callers:
            args = bind(func, call, place)
            yield from self._left(name, Env(func, len(func.fact.body), args, depth=place.depth + 1))
        if not callers:
            yield setting(name)

    def _left(self, name: str, end: Env) -> tuple[Value, ...]:
        """What a function leaves a variable with, at its end and whenever it calls others."""
        run = self.folder.flow.run(end)
        ways = self.folder.flow.left(run, name)
        if run is None or not ways or name not in end.func.fact.shared:
            return (unknown(name),)
        return self.folder.held.of([ways, *((held,) for held in run.shown.get(name, ()))], end)
