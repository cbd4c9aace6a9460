"""What a name, a function and a class lead to, whichever module comes upon them: each is worked out once.

Names are taken as they stand, whatever object they are asked of, so that nothing that runs is missed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import NamedTuple

from ecm_parsers.source.expr import THIS
from ecm_parsers.source.facts import Constant

from ecm_extract.link.code.decorators import are_known
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.owning.mentioned import Mentions, OfName, mentions_of, mentions_of_class
from ecm_extract.resolve.aliases import Declared
from ecm_extract.shipped import shipped

_SUBCLASSES = "__subclasses__"
MAX_ALIASES = 4
"""Aliases of aliases that are followed."""


@cache
def _table() -> dict[str, frozenset[str]]:
    rows = shipped("link/owning/reach.toml")
    return {name: frozenset(row["names"]) for name, row in rows.items()}


class Asked(NamedTuple):
    """A name that code mentions; `makes`: it may make an object of a class of that name.

    `file` stands for all files of its package and language, which see the same; `around` is what a type asks it of, and
    `placed` tells that this is no parameter of a template.
    """

    name: str
    file: File
    makes: bool
    around: str = ""
    placed: bool = False


@dataclass(frozen=True, slots=True)
class Lead:
    """What something leads to.

    Attributes:
        asked: names that it mentions. funcs: functions that it names. classes: those that it may make.
        any: it calls something whose name is not known before it runs. any_method: of some object.
    """

    asked: frozenset[Asked]
    funcs: Sequence[Func] = ()
    classes: Sequence[Cls] = ()
    any: bool = False
    any_method: bool = False


class Leads:
    """Tells where names, functions and classes of a program lead."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._places: dict[tuple[str, str], File] = {}
        self._by_name: dict[Asked, Lead] = {}
        self._by_func: dict[Func, Lead] = {}
        self._by_class: dict[Cls, Lead] = {}
        self._unnamed: dict[Cls, Sequence[Func]] = {}

    def of_name(self, asked: Asked) -> Lead:
        """What code can mean that mentions a name."""
        known = self._by_name.get(asked)
        if known is None:
            known = self._by_name[asked] = self._named(asked)
        return known

    def of_func(self, func: Func) -> Lead:
        """What the body of a function, the defaults of its parameters and its decorators mention."""
        known = self._by_func.get(func)
        if known is None:
            known = self._by_func[func] = self._run(func)
        return known

    def of_class(self, cls: Cls) -> Lead:
        """What the members of a class mention."""
        known = self._by_class.get(cls)
        if known is None:
            found = mentions_of_class(cls.fact)
            known = self._by_class[cls] = _lead(found, self._outside(found, cls.file), self._all_owned(found, cls.file))
        return known

    def of_bases(self, cls: Cls) -> Lead:
        """What the bases of a class are called."""
        return Lead(frozenset(self._asked(cls.file, [last_name(plain(base)) for base in cls.fact.bases])))

    def unnamed(self, cls: Cls) -> Sequence[Func]:
        """Return the methods of a class that run without being named once there is an object of it."""
        known = self._unnamed.get(cls)
        if known is None:
            foreign = self._has_foreign_base(cls)
            known = self._unnamed[cls] = [func for func in cls.methods if foreign or _runs_unnamed(func)]
        return known

    def _asked(self, file: File, names: Iterable[str], makes: bool = True) -> Iterator[Asked]:
        """Names as code in a file mentions them, without those that nothing in the tree is called."""
        place = self._places.setdefault((file.package, file.language), file)
        program = self.program
        tables = (program.functions, program.classes, program.constants, program.aliases.last_names)
        return (Asked(name, place, makes) for name in names if any(name in table for table in tables))

    def _parts(self, found: Mentions, file: File, scope: str = "", within: Cls | None = None) -> Iterator[Asked]:
        yield from self._asked(file, found.used)
        others = [each.name for each in found.of_names if not self._owned(each, file, scope, within)]
        yield from self._asked(file, others)
        yield from self._asked(file, found.held, makes=False)
        for name, around, placed in found.within:
            yield from (each._replace(around=around, placed=placed) for each in self._asked(file, [name]))

    def _all_owned(self, found: Mentions, file: File, scope: str = "", within: Cls | None = None) -> list[Func]:
        return [func for each in found.of_names for func in self._owned(each, file, scope, within)]

    def _owned(self, asked: OfName, file: File, scope: str, within: Cls | None) -> Sequence[Func]:
        """What a name means that is asked of a known class or of the own object: a method, and none of others."""
        if asked.name not in self.program.functions:
            return ()
        if asked.owner == THIS.id:
            return self._of_object(asked.name, within)
        cls = self.program.class_named(asked.owner, file, scope) if file.language == "python" else None
        return _methods(asked.name, self.program.ancestry(cls)) if cls is not None else ()

    def _of_object(self, name: str, cls: Cls | None) -> Sequence[Func]:
        """What an object's own class calls by a name that it or a base defines: that, or what derived classes have."""
        if cls is None or not _methods(name, self.program.ancestry(cls)):
            return ()
        return _methods(name, self.program.related(cls))

    def _outside(self, found: Mentions, file: File) -> Iterator[Asked]:
        """All names of what stands outside of functions."""
        yield from self._parts(found, file)
        yield from self._asked(file, found.plain)

    # --- names -------------------------------------------------------------------------------------------

    def _named(self, asked: Asked) -> Lead:
        name, file, makes, *_ = asked
        constants = [(other, mentions_of_constant(one)) for other, one in self.program.seen_constants(name, file)]
        mentioned = {each for other, found in constants for each in self._outside(found, other)}
        owned = [func for other, found in constants for func in self._all_owned(found, other)]
        return Lead(
            frozenset(mentioned.union(self._aliased(asked))),
            [*self.program.seen_functions(name, file), *owned],
            self.program.seen_classes(name, file) if makes else (),
            any(found.any for _, found in constants),
            any(found.any_method for _, found in constants),
        )

    def _aliased(self, asked: Asked) -> Iterator[Asked]:
        for entry in self._declared(asked):
            found = Mentions()
            found.add_type(entry.alias.target)
            yield from self._parts(found, entry.file)

    def _declared(self, asked: Asked) -> Sequence[Declared]:
        """The aliases that a name can mean: of a class that a type asks for it its own, of a library's class none."""
        seen = self._seen(asked.name, asked.file)
        if not asked.around:
            return seen
        family = set(self._family(asked.around, asked.file))
        own = [entry for entry in seen if last_name(entry.scope) in family]
        return own if own or self._is_foreign_name(asked.around, asked.placed, asked.file) else seen

    def _seen(self, name: str, file: File) -> Sequence[Declared]:
        return [entry for entry in self.program.aliases.called(name) if self.program.sees(file, entry.file)]

    def _family(self, name: str, file: File) -> Iterator[str]:
        """What the classes of a name are called, those that it stands for, and their bases."""
        meant = [last_name(plain(entry.alias.target)) for entry in self._seen(name, file)]
        for each in (name, *meant):
            yield each
            for cls in self.program.classes.get(each, ()):
                yield from (base.fact.name for base in self.program.ancestry(cls))

    def _is_foreign_name(self, name: str, placed: bool, file: File, depth: int = MAX_ALIASES) -> bool:
        """Tell whether a name can only be a class of a library: no class or namespace of the tree is called so."""
        if not depth or name in self.program.classes or name in self._namespaces:
            return False
        targets = [plain(entry.alias.target) for entry in self._seen(name, file)]
        if not targets:
            return placed
        return all(self._is_foreign_name(last_name(each), "::" in each, file, depth - 1) for each in targets)

    @cached_property
    def _namespaces(self) -> frozenset[str]:
        program = self.program
        scopes = {cls.fact.scope for group in program.classes.values() for cls in group}
        scopes |= {entry.scope for name in program.aliases.last_names for entry in program.aliases.called(name)}
        return frozenset(part for scope in scopes for part in scope.split("::"))

    # --- functions ---------------------------------------------------------------------------------------

    def _run(self, func: Func) -> Lead:
        """A name alone means a method of its own object, else the function of its own file, and no other."""
        found = mentions_of(func)
        methods = {name: self._unasked(name, func) for name in found.plain}
        plain_names = {name for name, meant in methods.items() if not meant}
        own = [each for each in self.program.functions_in(func.file) if each.fact.name in plain_names]
        asked = {
            *self._parts(found, func.file, func.scope, func.cls),
            *self._asked(func.file, plain_names - {each.fact.name for each in own if each.cls is None}),
            *self._asked(func.file, _imported(func.file, plain_names)),
            *self._asked(func.file, _imported(func.file, found.held), makes=False),
        }
        if _SUBCLASSES in found.used.union(each.name for each in found.of_names):
            asked.update(self._asked(func.file, self._derived_names(found)))
        meant = [each for group in methods.values() for each in group]
        return _lead(found, asked, [*own, *meant, *self._all_owned(found, func.file, func.scope, func.cls)])

    def _unasked(self, name: str, func: Func) -> Sequence[Func]:
        """What a name that stands alone in a method of C++ means before all others, unless a macro or class has it."""
        program = self.program
        hidden = name in program.classes or name in program.constants or name not in program.functions
        return () if hidden or func.file.language != "cpp" else self._of_object(name, func.cls)

    def _derived_names(self, known: Mentions) -> Iterator[str]:
        """`Part.__subclasses__()` gives all classes that derive from one."""
        for group in self.program.classes.values():
            for cls in group:
                if any(base.fact.name in known.held for base in self.program.ancestry(cls)):
                    yield cls.fact.name

    # --- classes -----------------------------------------------------------------------------------------

    def _has_foreign_base(self, cls: Cls) -> bool:
        """A base outside of the tree can call what its derived classes define."""
        return any(self._is_foreign(base, entry) for entry in self.program.ancestry(cls) for base in entry.fact.bases)

    def _is_foreign(self, base: str, cls: Cls) -> bool:
        written = plain(base)
        known = last_name(written) in _table()["bases"]
        return not known and self.program.class_named(written, cls.file, cls.fact.scope) is None


def _methods(name: str, classes: Iterable[Cls]) -> list[Func]:
    return [func for cls in classes for func in cls.methods if func.fact.name == name]


def _lead(found: Mentions, asked: Iterable[Asked], funcs: Sequence[Func] = ()) -> Lead:
    return Lead(frozenset(asked), funcs, any=found.any, any_method=found.any_method)


def mentions_of_constant(constant: Constant) -> Mentions:
    """What stands outside of functions is run when it is named: macros, tables of callbacks, global objects."""
    found = Mentions()
    found.add_type(constant.type)
    if constant.value is not None:
        found.add(constant.value)
    return found


def _imported(file: File, names: Iterable[str]) -> Iterator[str]:
    """What names are called where a Python file imports them from."""
    targets = (file.imported.get(name) for name in names)
    return (last_name(target) for target in targets if target is not None)


def _runs_unnamed(func: Func) -> bool:
    name = func.fact.name
    special = name.startswith("__") and name.endswith("__")  # `__mine` is private and needs to be named
    if func.is_constructor or special or name.startswith(("~", "operator")) or name in _table()["unnamed"]:
        return True
    return not are_known(func)
