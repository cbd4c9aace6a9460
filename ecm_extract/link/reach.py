"""What a module can run: from its beginning through everything that is mentioned by name on the way.

Names are taken as they stand, whatever object they are asked of, so that nothing that runs is missed; a method runs
only where an object of its class is made, unless it needs none. What no name leads to is run by others, or by nobody: a
program that uses one method of a class does not have what others do.
"""

from __future__ import annotations

import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from typing import NamedTuple

from ecm_extract.link.mentioned import Mentions, mentions_of, mentions_of_class
from ecm_extract.link.modules import Module
from ecm_extract.link.program import Program
from ecm_extract.link.references import makes_own_class
from ecm_extract.link.spelling import last_name, plain
from ecm_extract.link.units import Cls, File, Func

_SUBCLASSES = "__subclasses__"


@cache
def _table() -> dict[str, frozenset[str]]:
    rows = tomllib.loads((resources.files("ecm_extract.link") / "reach.toml").read_text("utf-8"))
    return {name: frozenset(row["names"]) for name, row in rows.items()}


class Reach:
    """Tells which functions a module can run; each module is asked about once.

    Args:
        program: all that the tree declares.
        loaded: function -> the classes that it loads by their name.
    """

    def __init__(self, program: Program, loaded: Mapping[Func, Sequence[Cls]]) -> None:
        self.program = program
        self._loaded = loaded
        self._functions: dict[Func, Mentions] = {}
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
                self._follow(run.pending.pop(), run)
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

    def _follow(self, asked: _Asked, run: _Run) -> None:
        for func in self.program.seen_functions(asked.name, asked.file):
            run.offer(func)
        for cls in self.program.seen_classes(asked.name, asked.file) if asked.makes else ():
            self._make(cls, run)
        self._constants(asked, run)
        self._aliases(asked, run)

    def _all_methods(self, run: _Run) -> None:
        """A method whose name is not known before it runs may be any of those objects that there are."""
        for cls in (*run.made, *run.touched):
            for func in cls.methods:
                run.offer(func)

    def _aliases(self, asked: _Asked, run: _Run) -> None:
        for entry in self.program.aliases.called(asked.name):
            if self.program.sees(asked.file, entry.file):
                found = Mentions()
                found.add_type(entry.alias.target)
                run.take(found, entry.file)

    def _take(self, func: Func, run: _Run) -> None:
        known = self._functions.get(func)
        if known is None:
            known = self._functions[func] = mentions_of(func)
        run.take(known, func.file)
        for cls in self._loaded.get(func, ()):
            self._make(cls, run)
            run.enter(*cls.methods)
        self._plain(func, known, run)
        if func.cls is not None:
            self._touch(func, func.cls, run)
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
        run.mention(func.file, *_imported(func.file, known.plain))
        run.mention(func.file, *_imported(func.file, known.held), makes=False)
        for each in own:
            run.offer(each)

    def _constants(self, asked: _Asked, run: _Run) -> None:
        """What stands outside of functions is run when it is named: macros, tables of callbacks, global objects."""
        for other, constant in self.program.seen_constants(asked.name, asked.file):
            found = Mentions()
            found.add_type(constant.type)
            if constant.value is not None:
                found.add(constant.value)
            run.take(found, other)
            run.mention(other, *found.plain)

    def _touch(self, func: Func, cls: Cls, run: _Run) -> None:
        """A method of a class runs, which may need no object of it: what the class holds itself is there."""
        if makes_own_class(func):
            self._make(cls, run)
        if cls in run.touched:
            return
        run.touched.add(cls)
        if cls.file.language == "python":
            self._members(cls, run)

    def _make(self, cls: Cls, run: _Run) -> None:
        """An object is made: its members are, what runs without being named does, and what was named before can."""
        if cls in run.made:
            return
        run.made.add(cls)
        self._members(cls, run)
        for base in self.program.ancestry(cls)[1:]:
            self._make(base, run)
        run.mention(cls.file, *(last_name(plain(base)) for base in cls.fact.bases))
        run.enter(*run.waiting.pop(cls, ()), *(func for func in cls.methods if self._runs_unnamed(func, cls)))

    def _members(self, cls: Cls, run: _Run) -> None:
        found = mentions_of_class(cls.fact)
        run.take(found, cls.file)
        run.mention(cls.file, *found.plain)

    def _runs_unnamed(self, func: Func, cls: Cls) -> bool:
        name = func.fact.name
        if func.is_constructor or name.startswith(("~", "operator", "__")) or name in _table()["unnamed"]:
            return True
        if set(map(_bare, func.fact.decorators)) - _table()["decorators"]:
            return True
        return self._has_foreign_base(cls)

    def _has_foreign_base(self, cls: Cls) -> bool:
        """A base outside of the tree can call what its derived classes define."""
        return any(self._is_foreign(base, entry) for entry in self.program.ancestry(cls) for base in entry.fact.bases)

    def _is_foreign(self, base: str, cls: Cls) -> bool:
        written = plain(base)
        known = last_name(written) in _table()["bases"]
        return not known and self.program.class_named(written, cls.file, cls.fact.scope) is None


class _Asked(NamedTuple):
    """A name that code in a file mentions; `makes`: it may make an object of a class of that name."""

    name: str
    file: File
    makes: bool


@dataclass(slots=True)
class _Run:
    """What one module mentions so far.

    `entered`: functions that run and are to be read. `waiting`: methods that are named while no object is made of their
    class. `any`: it calls something whose name is not known before it runs; `any_method`: of some object.
    """

    names: set[tuple[str, str, str, bool]] = field(default_factory=set)
    pending: list[_Asked] = field(default_factory=list)
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

    def take(self, mentions: Mentions, file: File) -> None:
        """Follow what is mentioned in a file."""
        self.any = self.any or mentions.any
        self.any_method = self.any_method or mentions.any_method
        self.mention(file, *mentions.used)
        self.mention(file, *mentions.held, makes=False)

    def mention(self, file: File, *names: str, makes: bool = True) -> None:
        """Follow names, each once in what the package of a file sees."""
        for name in names:
            key = (name, file.package, file.language, makes)
            if key not in self.names:
                self.names.add(key)
                self.pending.append(_Asked(name, file, makes))


def _imported(file: File, names: Iterable[str]) -> Iterator[str]:
    """What names are called where a Python file imports them from."""
    targets = (file.imported.get(name) for name in names)
    return (last_name(target) for target in targets if target is not None)


def _bare(decorator: str) -> str:
    return last_name(decorator.partition("(")[0].strip())
