"""Functions that somebody gets, by a form that is not read as a call: who has one may call it with anything.

In C++ their address, `threads.emplace_back(&Node::run, this, "x")`; in Python they themselves, or variables that hold
them: `later(self.run)`, `jobs = [(self.run, "x")]`, `return self.run`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.cpp_invoking import called_by
from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Table

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.callables import callable_of, element_of
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import children, expressions, given_to, last_of
from ecm_extract.link.index.program import Program

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ANY: Final = Name("")


class GivenFunctions:
    """Tells which they are, by name; each file is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.program = folder.program

    def has(self, func: Func) -> bool:
        """Tell whether a file that sees a function gives it, or one that is called so, to somebody."""
        return self._gives(_as_given(func), func.file)

    def has_class(self, cls: Cls) -> bool:
        """Tell whether a file of Python that sees a class names it, or one that is called so, without calling it."""
        name = cls.fact.name
        return self._gives(Name(name), cls.file) or self._gives(Member(_ANY, name), cls.file)

    def _gives(self, mentioned: Expr, file: File) -> bool:
        return any(self.program.sees(each, file) for each in self._giving.get(mentioned, ()))

    @cached_property
    def _giving(self) -> Mapping[Expr, Sequence[File]]:
        """The files that give somebody a function, by how they mention it."""
        found: dict[Expr, list[File]] = defaultdict(list)
        for file in self.program.files:
            named = _addresses(file, self.program) if file.language == "cpp" else self._mentions(file)
            for each in frozenset(named):
                found[each].append(file)
        return found

    def _mentions(self, file: File) -> Iterator[Expr]:
        """The functions of Python that a file names without calling them, but for where they are only called later."""
        for func in self.program.functions_in(file):
            inner = self.folder.nesting.inner(func)  # who gets one of these is read with it (`declaring.closures`)
            for entry in func.fact.body:
                settled = (
                    entry.kind != "do" and self._is_settled(entry.target, func) and not isinstance(entry.value, Call)
                )
                made = entry.kind == "return" and any(entry.value == Name(each.fact.name) for each in inner)
                for part in (None if settled or made else entry.value, _within(entry.target)):
                    yield from self._named_in(part, func) if part is not None else ()

    def _named_in(self, expr: Expr, func: Func) -> Iterator[Expr]:
        """What an expression names that is no callee, nor a function within the one at hand that is read as called."""
        if isinstance(expr, Name):
            held = func.callables.variables.get(expr.id)
            own = expr.id in self.folder.flow.effects(func).own
            yield from _stood_for(held) if held is not None else [] if own else [expr]
        elif isinstance(expr, Member):
            held = func.callables.members.get(expr.name) if expr.base == THIS else None
            yield from [Member(_ANY, expr.name)] if held is None else _stood_for(held)
            yield from self._named_in(expr.base, func)
        elif isinstance(expr, Call):
            given = given_to(expr)
            partial = int(callable_of(expr, func.file.imported) is not None)  # what that is of is read as called
            callee = expr.callee.base if isinstance(expr.callee, Member) else expr.callee
            parts = [arg for at, arg in enumerate(given[partial:], partial) if not self._is_read(expr, func, at, arg)]
            for part in (*parts, *([] if isinstance(expr.callee, Name) or func.meant(expr) != expr else [callee])):
                yield from self._named_in(part, func)
        else:
            for part in children(expr):
                yield from self._named_in(part, func)

    def _is_settled(self, target: Expr | None, func: Func) -> bool:
        """Whether a statement gives a variable or member of Python a function by which that is only called."""
        if isinstance(target, Name):
            held = func.callables.variables.get(target.id)
            return held is not None and not (isinstance(held, Table) and target.id in self._taken)
        return isinstance(target, Member) and target.base == THIS and target.name in func.callables.members

    @cached_property
    def _taken(self) -> Set[str]:
        """What functions of Python name otherwise than to call an element of it: `for make in KINDS.values()`."""
        bodies = (func.fact.body for func in self.program.every_function() if func.file.language == "python")
        values = (entry.value for body in bodies for entry in body if entry.value is not None)
        return frozenset(name for value in values for name in _taken_in(value))

    def _is_read(self, call: Call, func: Func, index: int, arg: Expr) -> bool:
        """Whether an argument is a function within the one at hand that is only called, which is read as a call."""
        named = {each.fact.name for each in self.folder.nesting.inner(func)} if isinstance(arg, Name) else ()
        return isinstance(arg, Name) and arg.id in named and self.folder.lent.is_lent(call, func, index)


def _taken_in(expr: Expr) -> Iterator[str]:
    """Yield what an expression names, but for the tables of which it calls an element: `KINDS["a"](x)`."""
    pending = [expr]
    while pending:
        each = pending.pop()
        callee = each.callee if isinstance(each, Call) else None
        if isinstance(each, Call) and isinstance(callee, Op | Call) and element_of(callee)[1] is not None:
            pending += given_to(each)
            continue
        if isinstance(each, Name | Member):
            yield last_of(each)
        pending += children(each)


def _within(target: Expr | None) -> Expr | None:
    """What is named in what a statement gives something: of a variable, or a field of one, nothing."""
    return None if isinstance(target, Name | Member) else target


def _stood_for(held: Expr) -> Iterator[Expr]:
    """The functions that a variable holds, through partials, or in a table."""
    while isinstance(held, Call) and held.args:
        held = held.args[0]
    if isinstance(held, Table):
        for _, value in held.entries:
            yield from _stood_for(value)
    else:
        yield Member(_ANY, held.name) if isinstance(held, Member) else held


def _as_given(func: Func) -> Expr:
    """How a function is mentioned: a method of Python by an object, whichever that is."""
    own = func.file.language == "python" and func.cls is not None
    return Member(_ANY, func.fact.name) if own else Name(func.fact.name)


def _addresses(file: File, program: Program) -> Iterator[Expr]:
    """The functions of C++ whose address a file takes, but for what is read as a call."""
    begun = (field.default for cls in file.facts.classes for field in cls.fields if field.default is not None)
    held = (part for func in program.functions_in(file) for each in func.fact.body for part, _ in expressions(each))
    parts = [*held, *(part for value in begun for part in children(value))]
    read = [called_by(part) for part in parts if isinstance(part, Call)]
    for part in parts:
        if isinstance(part, Op) and is_address(part) and not any(part is each for each in read):
            yield Name(last_of(part.operands[0]))
