"""Functions of Python that may not get what calls of them write: others of the tree stand around them.

Sources: docs.python.org, "Data model" (`object.__new__`, "Metaclasses") and "Function definitions" (decorators). Who
hands on all that he gets (`return f(*args, **kwargs)`) changes nothing of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.link.code.left_alone import SPREAD
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import dotted, last_of

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program

_CALL, _NEW, _INIT = "__call__", "__new__", "__init__"
_METACLASS = "type"


def settle_wrapped(program: Program) -> None:
    """Tell functions whether somebody of the tree may give them others than the arguments that a call writes."""
    functions = [func for func in program.every_function() if func.file.language == "python"]
    replaced = frozenset(_replaced(functions))
    metaclasses = [cls for group in program.classes.values() for cls in group if _METACLASS in cls.fact.bases]
    for func in functions:
        func.is_wrapped = any(_replaces(each, func.file, program) for each in func.fact.decorators) or (
            func.is_constructor and func.cls is not None and _is_made_anew(func.cls, metaclasses, replaced, program)
        )


def _is_made_anew(cls: Cls, metaclasses: Sequence[Cls], replaced: Set[str], program: Program) -> bool:
    """Whether calls of a class, or of one that derives from it, may give its constructor something else."""
    for entry in (*program.ancestry(cls), *program.derived(cls)):
        written = (dotted(each.callee if isinstance(each, Call) else each) or "" for each in entry.fact.decorators)
        if entry.fact.name in replaced or any(_replaces(each, entry.file, program) for each in written):
            return True
        if any(each.fact.name == _NEW and not _makes_one(each) for each in entry.methods):
            return True
        remade = "remade" in entry.fact.traits
        if remade and any(_changes_calls(each) for each in metaclasses if program.sees(entry.file, each.file)):
            return True
    return False


def _changes_calls(metaclass: Cls) -> bool:
    """Whether a metaclass makes objects with anything else than what a call of the class gives."""
    callers = [each for each in metaclass.methods if each.fact.name == _CALL]
    made = [(call, func) for func in callers for group in func.calls for call in group if last_of(call.callee) == _CALL]
    return bool(callers) and not (made and all(_hands_on(call, func) for call, func in made))


def _makes_one(func: Func) -> bool:
    """Whether `__new__` gives an object of its class, as far as that is seen: none that it calls another class for."""
    given = (entry.value for entry in func.fact.body if entry.kind == "return")
    return all(not isinstance(value, Call) or last_of(value.callee) == _NEW for value in given)


def _replaced(functions: Sequence[Func]) -> Iterator[str]:
    """The names of the classes that are given another constructor: `Topic.__init__ = other`."""
    targets = (entry.target for func in functions for entry in func.fact.body if entry.kind == "set")
    named = (each for each in targets if isinstance(each, Member) and each.name in {_INIT, _NEW})
    return (last_of(each.base) for each in named)


def _replaces(decorator: str, file: File, program: Program) -> bool:
    """Whether a decorator of the tree makes something of a function, or a class, that is not called as it is."""
    written, is_made, _ = decorator.partition("(")
    name = last_name(written.strip().replace(".", "::"))
    found = [each for each in program.seen_functions(name, file) if each.cls is None and not each.fact.scope]
    makers = found if not is_made else [inner for each in found for inner in _given_back(each, program)]
    if not found:
        return bool(program.seen_classes(name, file))
    return not makers or not all(_leaves_calls(each, program) for each in makers)


def _given_back(func: Func, program: Program) -> Sequence[Func]:
    """The functions declared within one that it returns."""
    names = {last_of(entry.value) for entry in func.fact.body if entry.kind == "return"}
    inner = (each for each in program.functions_in(func.file) if each.fact.scope == func.inner_scope)
    return [each for each in inner if each.fact.name in names]


def _leaves_calls(decorator: Func, program: Program) -> bool:
    """Whether a decorator gives back what it gets, or what calls that with all that it is called with."""
    if not decorator.fact.params:
        return False
    given = Name(decorator.fact.params[0].name)
    scope = f"{decorator.inner_scope}::"
    inner = [each for each in program.functions_in(decorator.file) if f"{each.fact.scope}::".startswith(scope)]
    calls = [(call, func) for func in inner for group in func.calls for call in group if call.callee == given]
    results = [entry.value for entry in decorator.fact.body if entry.kind == "return"]
    itself = bool(results) and all(value == given for value in results)
    return all(_hands_on(call, func) for call, func in calls) and (itself or bool(calls))


def _hands_on(call: Call, func: Func) -> bool:
    """Whether a call gets what its function got, in order: `f(*args, **kwargs)`, `f(self, name)`."""
    own = [param.name for param in func.fact.params]
    placed = [name for name in own if not name.startswith(SPREAD)]
    named = [(SPREAD, Name(name.lstrip("*"))) for name in own if name.startswith(SPREAD)]
    changed = {name for entry in func.fact.body for name in _assigned(entry.target)}
    kept = not changed.intersection(name.lstrip("*") for name in own)
    return kept and list(map(_as_written, call.args)) == placed and list(call.keywords) == named


def _as_written(arg: Expr) -> str:
    """A parameter as its function declares it; empty of any other argument."""
    if isinstance(arg, Op) and arg.op == "*" and len(arg.operands) == 1:
        return f"*{last_of(arg.operands[0])}"
    return arg.id if isinstance(arg, Name) else ""


def _assigned(target: Expr | None) -> Iterator[str]:
    while isinstance(target, Op | Member):
        target = target.operands[0] if isinstance(target, Op) else target.base
    if isinstance(target, Name):
        yield target.id
