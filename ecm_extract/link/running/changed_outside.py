"""Members that functions change which have the object of a node: `node->names.push_back(x)` in `main`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Expr, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import all_ways
from ecm_extract.infer.places import as_written, chosen
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class ChangedOutside:
    """Tells which members others change; each member of a class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[str, Cls], bool] = {}

    def is_changed(self, name: str, cls: Cls) -> bool:
        """Tell whether a function changes a member, or a part of it, of another object of a class, or may do it."""
        known = self._known.get((name, cls))
        if known is None:
            self._known[name, cls] = False  # who asks in a circle
            known = self._known[name, cls] = any(True for _ in self.changing(name, cls))
        return known

    def changing(self, name: str, cls: Cls) -> Iterator[Func]:
        """Yield the functions that change a member, or a part of it, of another object of a class, or may do it."""
        return (func for func, owner in self._changing.get(name, ()) if self.owns(func, owner, cls))

    def may_be_changed(self, name: str, cls: Cls) -> bool:
        """Tell whether a function changes such a member of an object that is of a class, or of which that is open."""
        return any(self._may_own(func, owner, cls) for func, owner in self._changing.get(name, ()))

    def is_pointed_to(self, name: str, cls: Cls) -> bool:
        """Tell whether C++ has a pointer to a member of any object of a class, or of one that it derives from."""
        owners = self._pointed.get(name, frozenset())
        return bool(owners) and any(each.fact.name in owners for each in self.folder.program.ancestry(cls))

    @cached_property
    def _pointed(self) -> Mapping[str, Set[str]]:
        """Name of a member -> the last names of the classes whose member pointers are to: `&Row::name`."""
        found: dict[str, set[str]] = defaultdict(set)
        for func in (each for each in self.functions if each.file.language == "cpp"):
            for expr in _addressed(func):
                owner, _, name = expr.id.rpartition("::") if isinstance(expr, Name) else ("", "", "")
                if owner:
                    found[name].add(last_name(owner))
        return found

    def is_handed_out(self, expr: Expr, env: Env) -> bool:
        """Tell whether a field of Python lies in an object that a function was handed which changes it."""
        if env.func.file.language != "python" or not isinstance(expr, Member):
            return False
        ways = self.folder.flow.ways(expr.base, env)
        return any(held.how in {"out", "lost"} for way in ways for held in all_ways(way))

    def owns(self, func: Func, owner: Expr, cls: Cls) -> bool:
        """Whether an object that a function changes is of a class, or of one that derives from it."""
        if _is_element(func, owner):
            return self._may_own(func, owner, cls)
        known = self._class_of(func, owner) is not None or _is_of_any_type(func, owner)
        return self._may_own(func, owner, cls) if known else self._is_passed(func, owner, cls)

    def _is_passed(self, func: Func, owner: Expr, cls: Cls) -> bool:
        """Whether a caller hands an object of a class to a function of Python, which need not say what it gets.

        It may keep it in a member, by which another method changes it.
        """
        if not func.file.language == cls.file.language == "python":
            return False
        if isinstance(owner, Member) and owner.base == THIS and func.cls is not None:
            givers = self.folder.scope.changing(owner.name, func.cls)
            kept = ((giver, entry.value) for giver in givers for entry in giver.fact.body if entry.target == owner)
            return any(isinstance(value, Name) and self._is_passed(giver, value, cls) for giver, value in kept)
        if not isinstance(owner, Name) or not any(owner.id == entry.name for entry in func.fact.params):
            return False
        of = func.cls.fact.name if func.cls is not None and func.is_constructor else ""
        calls = self._making[of] if of else self.folder.states.callers.all(func)
        given = (bind(func, call, place).get(owner.id) for call, place in calls)
        return any(bound is not None and self._is_of(bound, cls) for bound in given)

    def _is_of(self, given: Bound, cls: Cls) -> bool:
        own = given.env.this or given.env.func.cls if given.expr == THIS else None
        of = own or self.folder.objects.class_of(given.expr, given.env)
        return of is not None and (cls in self.folder.program.ancestry(of) or of in self.folder.program.ancestry(cls))

    def _may_own(self, func: Func, owner: Expr, cls: Cls) -> bool:
        if func.file.language != cls.file.language:
            return False
        of, program = self._class_of(func, owner), self.folder.program
        return of is None or cls in program.ancestry(of) or of in program.ancestry(cls)

    def _class_of(self, func: Func, owner: Expr) -> Cls | None:
        return self.folder.objects.class_of(owner, Env(func, len(func.fact.body)))

    @cached_property
    def _making(self) -> Mapping[str, Sequence[tuple[Invocation, Env]]]:
        """Name of a class -> the calls of Python that make an object of one of that name."""
        found: dict[str, list[tuple[Invocation, Env]]] = defaultdict(list)
        for func in (func for func in self.functions if func.file.language == "python"):
            for at, calls in enumerate(func.calls):
                for call in (invocation_of(call, Env(func, at)) for call in calls):
                    if call.last in self.folder.program.classes:
                        found[call.last].append((call, Env(func, at)))
        return found

    @cached_property
    def functions(self) -> Sequence[Func]:
        """All functions of the program."""
        return [func for group in self.folder.program.functions.values() for func in group]

    @cached_property
    def _changing(self) -> Mapping[str, Sequence[tuple[Func, Expr]]]:
        """Name of a field -> the functions that change it, or a part of it, with the object that it lies in."""
        found: dict[str, list[tuple[Func, Expr]]] = defaultdict(list)
        for func in self.functions:
            for target in (entry.target for entry in func.fact.body if entry.kind != "do"):
                if isinstance(target, Member) and isinstance(target.base, Op):
                    owners = (target.base,) if func.file.language == "python" else chosen(target.base)
                    found[target.name] += [(func, owner) for owner in owners]
            for part in self._lent(func):
                for owner, name in _fields(part):
                    found[name].append((func, owner))
        kept = ((each.func, each.key) for each in self.folder.kept_parts.all())
        for func, key in (*self._changed_keys(), *kept):
            for owner, field in _fields(as_written(key)):
                found[field].append((func, owner))
        return found

    def _changed_keys(self) -> Iterator[tuple[Func, str]]:
        for func in self.functions:
            outline = self.folder.flow.outline(func)
            lent = map(self.folder.flow.effects(func).root, self._lent(func))
            yield from ((func, key) for key in {*outline.changes, *outline.altered, *lent})

    def _lent(self, func: Func) -> Iterator[Expr]:
        """Yield what a function of C++ binds to a reference, or takes the address of."""
        if func.file.language == "cpp":
            referring = (each for each in func.fact.body if _refers(each))
            yield from (
                each.value
                for each in referring
                if each.value is not None and (each.kind == "let" or self._is_written(each, func))
            )
            yield from _addressed(func)

    def _is_written(self, each: Statement, func: Func) -> bool:
        """Whether a function changes what a loop gives it, or hands it to somebody who may."""
        outline = self.folder.flow.outline(func)
        bound = set(outline.bound_keys(each.target))
        within = any(key.partition(".")[0] in bound for key in (*outline.altered, *outline.escaped))
        return within or any(
            key.partition(".")[0] in bound and (count > 1 or "." in key) for key, count in outline.changes.items()
        )


def _addressed(func: Func) -> Iterator[Expr]:
    """Yield what a function of C++ takes the address of."""
    for expr in (expr for statement in func.fact.body for expr, _ in expressions(statement)):
        if isinstance(expr, Op) and expr.op == "&" and len(expr.operands) == 1:
            yield expr.operands[0]


def _is_of_any_type(func: Func, owner: Expr) -> bool:
    """Whether C++ states no type of an object, or what its template gives: `template <class T> void f(T & x)`."""
    while isinstance(owner, Member):
        owner = owner.base
    types = (plain(entry.type) for entry in func.fact.params if owner == Name(entry.name))
    return func.file.language == "cpp" and any(each == "auto" or each in func.fact.template for each in types)


def _is_element(func: Func, owner: Expr) -> bool:
    """Whether an object is an element of something of Python, of which nobody needs to say the class."""
    looped = (entry.target for entry in func.fact.body if entry.kind == "each")
    return func.file.language == "python" and (isinstance(owner, Op) or owner in {*looped})


def _refers(statement: Statement) -> bool:
    written = statement.type
    return statement.kind in {"let", "each"} and written.endswith("&") and "const" not in written.split()


def _fields(part: Expr) -> Iterator[tuple[Expr, str]]:
    """Yield the objects that something lies in, other than the one at hand, each with its field: `rows[0].name`."""
    while isinstance(part, Member):
        if part.base != THIS:
            yield part.base, part.name
        part = part.base
