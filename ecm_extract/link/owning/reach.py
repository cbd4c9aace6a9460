"""What a module can run: from its beginning through everything that is mentioned by name on the way.

A method runs only where an object of its class is made, unless it needs none. What no name leads to is run by others,
or by nobody: a program that uses one method of a class does not have what others do.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.index.registered import Registered
from ecm_extract.link.owning.imported import Imported
from ecm_extract.link.owning.leads import Asked, Lead, Leads
from ecm_extract.link.owning.modules import Module
from ecm_extract.link.owning.references import makes_own_class

_VIRTUAL: Final = frozenset({"virtual", "pure", "override"})


class Reach:
    """Tells which functions a module can run; each module is asked about once.

    Args:
        program: all that the tree declares.
        loaded: function -> the classes that it loads by their name.
        registered: tells which classes a function can make since something keeps them that it reads.
    """

    def __init__(self, program: Program, loaded: Mapping[Func, Sequence[Cls]], registered: Registered) -> None:
        self.program = program
        self._leads = Leads(program)
        self._imported = Imported(program)
        self._loaded = loaded
        self._registered = registered
        self._runs: dict[Module, _Run] = {}

    def reaches(self, module: Module, funcs: Iterable[Func]) -> bool:
        """Tell whether a module can run functions that call each other; a library runs whatever it is asked to."""
        if module.main is None and module.cls is None:
            return True
        others = [func for func in funcs if not self._begins_with(func, module)]
        if not others:
            return True
        run = self._runs.get(module)
        if run is None:
            run = self._runs[module] = self._run(module)
        return run.any or all(func in run.always for func in others)

    def _begins_with(self, func: Func, module: Module) -> bool:
        """Tell whether a function is the module's own: its main function, a method of its class."""
        return func is module.main or (module.cls is not None and func.cls in self.program.ancestry(module.cls))

    def _run(self, module: Module) -> _Run:
        run = _Run()
        self._begin(module, run)
        while (run.entered or run.pending) and not run.any:
            if run.entered:
                self._take(run.entered.pop(), run)
            else:
                self._follow(self._leads.of_name(run.pending.pop()), run)
            if run.any_method and not run.pending:
                self._all_methods(run)
        return run

    def _begin(self, module: Module, run: _Run) -> None:
        if module.main is not None:
            own = self.program.functions_in(module.main.file)
            run.enter(module.main, *(func for func in own if func.fact.name == "<module>"))
        for cls in self.program.ancestry(module.cls) if module.cls is not None else ():
            self._make(cls, run)
            run.enter(*cls.methods)

    def _follow(self, lead: Lead, run: _Run) -> None:
        run.take(lead)
        for cls in lead.classes:
            self._make(cls, run)

    def _all_methods(self, run: _Run) -> None:
        """A method whose name is not known before it runs may be any of those objects that there are."""
        for cls in (*run.made, *run.touched):
            for func in cls.methods:
                run.offer(func)

    def _take(self, func: Func, run: _Run) -> None:
        run.take(self._leads.of_func(func))
        run.enter(*self._imported.bodies(func))
        for cls in self._loaded.get(func, ()):
            self._make(cls, run)
            run.enter(*cls.methods)
        for cls in self._registered.read_by(func):
            self._make(cls, run)
        if func.cls is not None:
            self._touch(func, func.cls, run)
            for each in self._overriding(func, func.cls):
                run.offer(each)

    def _overriding(self, func: Func, cls: Cls) -> Iterator[Func]:
        """What a call of a method can run instead, in classes that the one who calls it need not know."""
        if cls.file.language == "python" or _VIRTUAL.intersection(func.fact.traits):
            methods = (method for each in self.program.derived(cls) for method in each.methods)
            yield from (method for method in methods if method.fact.name == func.fact.name)

    def _touch(self, func: Func, cls: Cls, run: _Run) -> None:
        """A method of a class runs, which may need no object of it: what the class holds itself is there."""
        if makes_own_class(func):
            self._make(cls, run)
        if cls in run.touched:
            return
        run.touched.add(cls)
        if cls.file.language == "python":
            run.take(self._leads.of_class(cls))

    def _make(self, cls: Cls, run: _Run) -> None:
        """An object is made: its members are, what runs without being named does, and what was named before can."""
        if cls in run.made:
            return
        run.made.add(cls)
        run.take(self._leads.of_class(cls))
        for base in self.program.ancestry(cls)[1:]:
            self._make(base, run)
        run.take(self._leads.of_bases(cls))
        run.enter(*run.waiting.pop(cls, ()), *self._leads.unnamed(cls))


@dataclass(slots=True)
class _Run:
    """What one module mentions so far.

    `entered`: functions that run and are to be read. `waiting`: methods that are named while no object is made of their
    class. `any`: it calls something whose name is not known before it runs; `any_method`: of some object.
    """

    names: set[Asked] = field(default_factory=set)
    pending: list[Asked] = field(default_factory=list)
    entered: list[Func] = field(default_factory=list)
    always: set[Func] = field(default_factory=set)
    waiting: dict[Cls, list[Func]] = field(default_factory=lambda: defaultdict(list))
    made: set[Cls] = field(default_factory=set)
    touched: set[Cls] = field(default_factory=set)
    any: bool = False
    any_method: bool = False

    def enter(self, *funcs: Func) -> None:
        """Run functions, each once."""
        for func in funcs:
            if func not in self.always:
                self.always.add(func)
                self.entered.append(func)

    def offer(self, func: Func) -> None:
        """Run a function that is named; a method only once there is an object of its class, if it needs one."""
        if func.holder is None or func.holder in self.made:
            self.enter(func)
        else:
            self.waiting[func.holder].append(func)

    def take(self, lead: Lead) -> None:
        """Follow what something leads to, each name once; classes are made by who knows their bases."""
        self.any = self.any or lead.any
        self.any_method = self.any_method or lead.any_method
        new = lead.asked - self.names
        self.names |= new
        self.pending += new
        for func in lead.funcs:
            self.offer(func)
