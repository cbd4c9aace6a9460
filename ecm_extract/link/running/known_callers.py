"""Methods of which all callers are known: nobody gets them by name, overrides them, or calls them from outside."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import cache
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Opaque, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import children, given_to
from ecm_extract.link.index.bases_outside import bases_outside
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

Calling = tuple[Invocation, Env]
"""A call with its place."""


@cache
def _hosts() -> Mapping[str, Set[str]]:
    return {name: frozenset(methods) for name, methods in shipped("link/running/hosts.toml")["calls"].items()}


class KnownCallers:
    """Finds the callers of methods; who indexes calls sets `find`, for functions, and `making`, for classes."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.find: Callable[[Func], Iterator[Calling]] | None = None
        self.making: Callable[[Cls], Iterator[Calling]] | None = None
        self._of: dict[Func, tuple[Calling, ...] | None] = {}
        self._handed: dict[File, Set[str]] = {}
        self._kept: dict[tuple[Func, str], bool] = {}

    def all(self, func: Func) -> Iterator[Calling]:
        """Yield the calls of a function that the tree has, whoever else may call it."""
        yield from self.find(func) if self.find is not None else ()

    def making_by(self, func: Func) -> Iterator[Calling]:
        """Yield the calls by which a constructor is run, where it is the one that they mean."""
        made = self.making(func.cls) if self.making is not None and func.cls is not None else ()
        for call, place in made:
            if func.cls is not None and self.folder.objects.constructor(func.cls, call) is func:
                yield call, place

    def of(self, func: Func) -> Sequence[Calling] | None:
        """Return all calls of a method with their places; None where somebody else may call it."""
        if self.find is None:
            return None
        if func not in self._of:
            self._of[func] = self._found(func, tuple(self.find(func))) if self._is_closed(func) else None
        return self._of[func]

    def _found(self, func: Func, calls: tuple[Calling, ...]) -> tuple[Calling, ...] | None:
        straight = all(self.is_straight(call) for call, _ in calls)
        itself = (Name(func.fact.name), Member(THIS, func.fact.name))
        recursive = any(call.callee in itself for group in func.calls for call in group)
        return calls if calls and straight and not recursive else None

    def is_straight(self, call: Invocation) -> bool:
        """Tell whether a call runs where it stands, and not in a function that runs who knows when."""
        return not call.statement.deferred and self._is_plain(call.func)

    def _is_plain(self, func: Func) -> bool:
        """Whether a function is none that another one declares, which runs who knows when."""
        return "lambda" not in func.fact.traits and self.folder.nesting.enclosing(func) is None

    def _is_closed(self, func: Func) -> bool:
        cls, name = func.cls, func.fact.name
        if cls is None or func.fact.decorators or name.startswith(("__", "~", "operator")):
            return False
        lineage = (*self.folder.program.ancestry(cls), *self.folder.program.derived(cls))
        same = [method for entry in lineage for method in entry.methods if method.fact.name == name]
        single = all(method is func or (method.cls is cls and "declaration" in method.fact.traits) for method in same)
        if not single or self.folder.flow.keeps(name) or "override" in func.fact.traits:
            return False
        return not self.may_be_called_outside(name, cls) and not self.is_handed(func)

    def may_be_called_outside(self, name: str, cls: Cls) -> bool:
        """Tell whether a base outside of the tree may call a method of a class."""
        known = (_hosts().get(last_name(base)) for base in bases_outside(cls, self.folder.program))
        return any(called is None or name in called for called in known)

    def is_handed(self, func: Func) -> bool:
        """Tell whether a file that sees the method mentions its name without calling it."""
        program = self.folder.program
        return any(func.fact.name in self._handed_in(file) for file in program.files if program.sees(file, func.file))

    def _handed_in(self, file: File) -> Set[str]:
        known = self._handed.get(file)
        if known is None:
            funcs = self.folder.program.functions_in(file)
            statements = [entry for func in funcs for entry in func.fact.body]
            known = self._handed[file] = frozenset(name for entry in statements for name in _handed(entry))
        return known

    def may_be_written_outside(self, name: str, func: Func) -> bool:
        """Tell whether some function assigns a field of that name of an object other than its own."""
        return bool(self.folder.scope.assigned_outside(name, func.file.language))

    def keeps_to_itself(self, name: str, func: Func) -> bool:
        """Tell whether nobody but a function has an object in a variable: it calls its methods, or hands it outside."""
        known = self._kept.get((func, name))
        if known is None:
            own = name in self.folder.flow.effects(func).own
            body = enumerate(func.fact.body)
            kept = own and not any(self._gives(statement, name, func, at) for at, statement in body)
            known = self._kept[func, name] = kept and not self.is_changed_inside(name, func)
        return known

    def is_changed_inside(self, name: str, func: Func) -> bool:
        """Tell whether a function within another one may change an object that is in a variable of that."""
        inner = self.folder.nesting.inner(func)
        return any(
            self._may_change(call, name, each, at)
            for each in inner
            if name in self.folder.shifting.names(each) and name not in self.folder.flow.effects(each).own
            for at, calls in enumerate(each.calls)
            for call in calls
        )

    def _may_change(self, call: Call, name: str, func: Func, at: int) -> bool:
        """Whether a call gives an object away, or is one of a method that may change it."""
        if any(arg == Name(name) for arg in given_to(call)):
            return True
        root = call.callee
        while isinstance(root, Member):
            root = root.base
        if root != Name(name) or root == call.callee:
            return False
        callee = self.folder.flow.target(call, func, at)
        return callee is None or any(key.startswith(".") for key in self.folder.flow.outline(callee).changes)

    def _gives(self, statement: Statement, name: str, func: Func, at: int) -> bool:
        if self._is_copied(statement, name, func):
            return False
        pending = [statement.value] if statement.value is not None else []
        while pending:
            expr = pending.pop()
            if isinstance(expr, Name) and expr.id == name:
                return True
            if isinstance(expr, Member) and isinstance(expr.base, Name):
                continue
            if isinstance(expr, Call) and not self.folder.flow.own.is_own(expr, func, at):
                pending += [part for part in children(expr) if not isinstance(part, Name)]
            elif isinstance(expr, Call):
                lent = self._lent(expr, func, at)
                pending += [part for part in children(expr) if not any(part is each for each in lent)]
            else:
                pending += children(expr)
        return False

    def _is_copied(self, statement: Statement, name: str, func: Func) -> bool:
        """Whether a statement of C++ makes another object of what is in a variable."""
        if func.file.language != "cpp" or statement.value != Name(name) or statement.kind not in {"let", "set"}:
            return False
        is_value = self.folder.objects.is_value(func.written_types.get(name, ""), Env(func))
        return is_value and not statement.type.endswith(("&", "*"))

    def _lent(self, call: Call, func: Func, at: int) -> Sequence[Expr]:
        """The arguments of C++ that a function of the tree gets copies of, or only looks at."""
        callee = self.folder.flow.target(call, func, at) if func.file.language == "cpp" else None
        params = callee.params if callee is not None else ()
        taken = zip(call.args, params, strict=False)
        place = Env(callee or func)
        is_value = self.folder.objects.is_value
        return [arg for arg, param in taken if is_value(param.type, place) or _is_looked_at(param.type)]


def _is_looked_at(written: str) -> bool:
    """Whether who gets an object by a type cannot change it."""
    return written.startswith("const ") and written.endswith("&")


def _handed(statement: Statement) -> Iterator[str]:
    """The names that a statement mentions without calling them."""
    pending: list[Expr] = [expr for expr in (statement.value, statement.target) if expr is not None]
    while pending:
        expr = pending.pop()
        if isinstance(expr, Name):
            yield last_name(expr.id)
        elif isinstance(expr, Member):
            yield expr.name
        elif isinstance(expr, Text) and expr.value.isidentifier():
            yield expr.value
        elif isinstance(expr, Opaque):
            yield from expr.text.replace(".", " ").replace("(", " ").replace(">", " ").split()
        if isinstance(expr, Call):
            callee = expr.callee
            pending += [*expr.args, *(value for _, value in expr.keywords)]
            pending += [callee.base] if isinstance(callee, Member) else [] if isinstance(callee, Name) else [callee]
        else:
            pending += children(expr)
