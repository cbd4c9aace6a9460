"""Methods of C++ that are called by a pointer to them: `std::thread(&Base::run, &object, "x")` calls `object.run("x")`.

Source: [expr.mptr.oper] and [class.virtual] of the C++ standard: a virtual method is that of the object, any other one
that of the class which is written. A file does not tell which it is, and whether a variable that stands behind the
method is the object, or the first argument of a function that needs none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ecm_parsers.source.cpp_invoking import PERHAPS, makes_element, runs_function
from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Number, Op
from ecm_parsers.source.rewriting import rewritten
from msgspec.structs import replace

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.early_binding import is_virtual
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects

POINTED = "->*"


def settle_bound_methods(objects: Objects) -> None:
    """Read such calls of a tree as the calls of methods that they are."""
    found = [(func, _Bound(objects, func)) for func in _functions(objects.program)]
    for func, fact in [(func, rewritten(func.fact, bound.meant)) for func, bound in found]:
        func.read_as(fact)


def _functions(program: Program) -> Iterator[Func]:
    """The functions that may call a method so, where a line takes the address of what is called like one."""
    methods = {func.fact.name for func in program.every_function() if func.cls is not None}
    for file in (file for file in program.files if file.language == "cpp"):
        lines = {each.line for each in file.facts.mentions if each.arguments < 0 and last_name(each.name) in methods}
        for func in program.functions_in(file):
            written = any(func.fact.line <= line <= func.fact.end_line for line in lines)
            if written or any(call.callee == PERHAPS for group in func.calls for call in group):
                yield func


class _Bound:
    """What calls of one function mean."""

    def __init__(self, objects: Objects, func: Func) -> None:
        self.objects = objects
        self.program = objects.program
        self.func = func

    def meant(self, part: Any) -> Any:
        """Return what stands for a part of facts; None of what stays."""
        if not isinstance(part, Call):
            return None
        callee, args = part.callee, part.args
        if callee == PERHAPS:
            return rewritten(args[1], self.meant) if self._runner(args[0]) else Items(args[2:])
        if made := self._thread(part):
            return made
        if isinstance(callee, Op) and callee.op == POINTED:
            object_, named = callee.operands
        elif isinstance(callee, Name) and "::" in callee.id and args and self._needs_object(callee.id, len(args)):
            object_, named, args = args[0], callee, args[1:]
        else:
            return None
        return replace(part, callee=self._method(object_, named), args=rewritten(args, self.meant))

    def _runner(self, made: Expr) -> str:
        """The type of an object that runs the function which it is made with; empty of others."""
        written = self.objects.type_of(made, Env(self.func, len(self.func.fact.body)))
        meant = self.program.alias(plain(written), self.func.file, self.func.scope) if written else None
        return next(filter(runs_function, (written, meant or "")), "")

    def _thread(self, call: Call) -> Call | None:
        """A call that begins such an object, of a container or of the object at hand, with the object as it is made."""
        callee, args = call.callee, call.args
        if len(args) < 2 or not is_address(args[0]):
            return None
        if isinstance(callee, Member) and makes_element(callee):
            made = self._runner(Op("[]", (callee.base, Number(0))))
            return replace(call, args=(Call(Name(made), args, (), (), call.line),)) if made else None
        made = self._runner(Member(THIS, callee.id)) if isinstance(callee, Name) and "::" not in callee.id else ""
        return replace(call, callee=Name(made)) if made else None

    def _method(self, object_: Expr, named: Expr) -> Member:
        path = named.id if isinstance(named, Name) else ""
        last = last_name(path)
        own = self.objects.class_of(object_, Env(self.func, len(self.func.fact.body)))
        cls, methods = self._named(path)
        nearer = own is not None and own is not cls and any(each.fact.name == last for each in self._own(own, cls))
        hidden = nearer and methods and not any(is_virtual(each, self.program) for each in methods)
        return Member(object_, path if hidden else last)

    def _own(self, cls: Cls, base: Cls | None) -> Iterator[Func]:
        """The methods of a class and of its bases that derive from one."""
        for entry in self.program.ancestry(cls):
            if entry is not base and base in self.program.ancestry(entry):
                yield from entry.methods

    def _named(self, path: str) -> tuple[Cls | None, Sequence[Func]]:
        """The class in front of a name, and its methods of that name."""
        cls = self.program.class_named(path.rpartition("::")[0], self.func.file, self.func.scope)
        lineage = self.program.ancestry(cls) if cls is not None else ()
        return cls, [each for entry in lineage for each in entry.methods if each.fact.name == last_name(path)]

    def _needs_object(self, path: str, given: int) -> bool:
        """Tell whether what is called with some arguments is a method, of which the first one is the object."""
        cls, methods = self._named(path)
        needing = [each for each in methods if each.holder is not None and not each.is_constructor]
        fits = [each.arity[0] <= given - 1 <= each.arity[1] for each in needing]
        own = cls in self.program.ancestry(self.func.cls) if self.func.cls is not None else False
        as_own = own and any(each.arity[0] <= given <= each.arity[1] for each in methods)
        return len(needing) == len(methods) and any(fits) and not as_own
