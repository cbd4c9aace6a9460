"""What a module can run: from its beginning through everything that is mentioned by name on the way.

Names are taken as they stand, whatever object they are asked of, so that nothing that runs is missed. What no name
leads to is run by others, or by nobody: a program that uses one method of a class does not have what others do.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache
from importlib import resources

from ecm_extract.link.mentioned import Mentions, mentions_of, mentions_of_class
from ecm_extract.link.modules import Module
from ecm_extract.link.program import Program
from ecm_extract.link.spelling import last_name, plain
from ecm_extract.link.units import Cls, File, Func

_SUBCLASSES = "__subclasses__"


@cache
def _table() -> dict[str, frozenset[str]]:
    rows = tomllib.loads((resources.files("ecm_extract.link") / "reach.toml").read_text("utf-8"))
    return {name: frozenset(row["names"]) for name, row in rows.items()}


class Reach:
    """Tells which functions a module can run; each module is asked about once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._functions: dict[Func, Mentions] = {}
        self._runs: dict[Module, _Run] = {}

    def reaches(self, module: Module, funcs: Iterable[Func]) -> bool:
        """Tell whether a module can run functions that call each other; a library runs whatever it is asked to."""
        if module.main is None and module.cls is None:
            return True
        run = self._runs.get(module)
        if run is None:
            run = self._runs[module] = self._run(module)
        return run.any or all(func in run.always for func in funcs)

    def _run(self, module: Module) -> _Run:
        run = _Run()
        for func in self._beginnings(module):
            self._enter(func, run)
        while run.pending and not run.any:
            self._follow(*run.pending.pop(), run)
            if run.any_method and not run.pending:
                self._all_methods(run)
        return run

    def _follow(self, name: str, file: File, run: _Run) -> None:
        for func in self.program.seen_functions(name, file):
            self._enter(func, run)
        for cls in self.program.seen_classes(name, file):
            self._live(cls, run)
        self._constants(name, file, run)
        self._aliases(name, file, run)

    def _all_methods(self, run: _Run) -> None:
        """A method whose name is not known before it runs may be any of those objects that there are."""
        for cls in (*run.made, *run.touched):
            for func in cls.methods:
                self._enter(func, run)

    def _aliases(self, name: str, file: File, run: _Run) -> None:
        for other, target in self.program.aliases.targets(name):
            if self.program.sees(file, other):
                found = Mentions()
                found.add_type(target)
                run.take(found, other)

    def _beginnings(self, module: Module) -> Iterator[Func]:
        if module.main is not None:
            yield module.main
            own = self.program.functions_in(module.main.file)
            yield from (func for func in own if func.fact.name == "<module>")
        for cls in self.program.ancestry(module.cls) if module.cls is not None else ():
            yield from cls.methods

    def _enter(self, func: Func, run: _Run) -> None:
        if func in run.always:
            return
        run.always.add(func)
        known = self._functions.get(func)
        if known is None:
            known = self._functions[func] = mentions_of(func)
        run.take(known, func.file)
        self._plain(func, known, run)
        for name in known.held:
            if (name, func.file.package) not in run.held:
                run.held.add((name, func.file.package))
                self._constants(name, func.file, run)
        if func.cls is not None:
            self._live(func.cls, run, made=False)
        if _SUBCLASSES in known.used:
            run.mention(func.file, *self._derived_names(known))

    def _derived_names(self, known: Mentions) -> Iterator[str]:
        """`Part.__subclasses__()` gives all classes that derive from one."""
        for group in self.program.classes.values():
            for cls in group:
                if any(base.fact.name in known.held for base in self.program.ancestry(cls)):
                    yield cls.fact.name

    def _plain(self, func: Func, known: Mentions, run: _Run) -> None:
        """A name that stands alone means the function of its own file, if that has one, and no other."""
        own = [each for each in self.program.functions_in(func.file) if each.fact.name in known.plain]
        run.mention(func.file, *(known.plain - {each.fact.name for each in own if each.cls is None}))
        imported = (func.file.imported.get(name) for name in known.plain | known.held)
        run.mention(func.file, *(last_name(target) for target in imported if target is not None))
        for each in own:
            self._enter(each, run)

    def _constants(self, name: str, file: File, run: _Run) -> None:
        """What stands outside of functions is run when it is named: macros, tables of callbacks, global objects."""
        for other, constant in self.program.seen_constants(name, file):
            found = Mentions()
            found.add_type(constant.type)
            if constant.value is not None:
                found.add(constant.value)
            run.take(found, other)
            run.mention(other, *found.plain)

    def _live(self, cls: Cls, run: _Run, made: bool = True) -> None:
        """An object is made: what runs without being named. Members are there wherever a method runs."""
        if cls in (run.made if made else run.touched):
            return
        (run.made if made else run.touched).add(cls)
        found = mentions_of_class(cls.fact)
        run.take(found, cls.file)
        run.mention(cls.file, *found.plain)
        if made:
            for base in cls.fact.bases:
                run.mention(cls.file, last_name(plain(base)))
            for func in cls.methods:
                if self._runs_unnamed(func, cls):
                    self._enter(func, run)

    def _runs_unnamed(self, func: Func, cls: Cls) -> bool:
        name = func.fact.name
        if func.is_constructor or name.startswith(("~", "operator", "__")) or name in _table()["unnamed"]:
            return True
        if set(map(_bare, func.fact.decorators)) - _table()["decorators"]:
            return True
        return self._has_foreign_base(cls)

    def _has_foreign_base(self, cls: Cls) -> bool:
        """A base outside of the tree can call what its derived classes define."""
        known = {entry.fact.name for entry in self.program.ancestry(cls)}
        names = {last_name(plain(base)) for entry in self.program.ancestry(cls) for base in entry.fact.bases}
        return bool(names - known - _table()["bases"])


@dataclass(slots=True)
class _Run:
    """What one module mentions so far; `any`: it calls something whose name is not known before it runs."""

    names: set[tuple[str, str, str]] = field(default_factory=set)
    held: set[tuple[str, str]] = field(default_factory=set)
    pending: list[tuple[str, File]] = field(default_factory=list)
    always: set[Func] = field(default_factory=set)
    made: set[Cls] = field(default_factory=set)
    touched: set[Cls] = field(default_factory=set)
    any: bool = False
    any_method: bool = False

    def take(self, mentions: Mentions, file: File) -> None:
        """Follow what is mentioned in a file."""
        self.any = self.any or mentions.any
        self.any_method = self.any_method or mentions.any_method
        self.mention(file, *mentions.used)

    def mention(self, file: File, *names: str) -> None:
        """Follow names, each once in what the package of a file sees."""
        for name in names:
            key = (name, file.package, file.language)
            if key not in self.names:
                self.names.add(key)
                self.pending.append((name, file))


def _bare(decorator: str) -> str:
    return last_name(decorator.partition("(")[0].strip())
