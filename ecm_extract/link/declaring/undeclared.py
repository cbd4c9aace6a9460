"""Nodes that take parameters which they do not declare: what they read is a parameter all the same."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant, Expr, Op, Table, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in, children
from ecm_extract.link.index.module_kinds import takes_undeclared

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OPTIONS: Final = frozenset({"allow_undeclared_parameters", "automatically_declare_parameters_from_overrides"})
"""Options of `rclcpp::NodeOptions` and of the nodes of rclpy."""
_KEYS: Final = frozenset(map(Text, _OPTIONS))
MAX_DEPTH: Final = 2
"""Objects within objects that are looked at: a helper is a member of its node, or of what that has."""
MAX_CALLS: Final = 3
"""Functions without an object that are looked through, each called by the next."""
_TRUE: Final = Constant("true")


class Undeclared:
    """Knows which nodes take what they do not declare.

    `makers` gives the functions that make objects of a class, `callers` those that call one; who indexes calls sets
    both.
    """

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.makers: Callable[[Cls], Iterable[Func]] | None = None
        self.callers: Callable[[Func], Iterable[Func]] | None = None
        self._taking: dict[Func, bool] = {}

    def takes_any(self, func: Func) -> bool:
        """Tell whether the node of a function takes what it does not declare, as its class, file or maker says."""
        known = self._taking.get(func)
        if known is None:
            known = self._taking[func] = self._is_told(func)
        return known

    def _is_told(self, func: Func) -> bool:
        own = self.folder.nesting.object_of(func)
        if any(takes_undeclared(cls, self.folder.program) for cls in (self._around(own) if own is not None else ())):
            return True
        return any(_says_so(each) for each in dict.fromkeys(self._saying(func)))

    def _saying(self, func: Func) -> Iterator[Func]:
        """Yield the functions in which options of the node can stand."""
        for user in self._users(func):
            yield from self._beside(user)

    def _users(self, func: Func) -> Sequence[Func]:
        """A function, and of one without an object those that call it, which give it the node."""
        found = {func: None}
        for _ in range(MAX_CALLS):
            free = [each for each in found if self._is_free(each)]
            found |= dict.fromkeys(caller for each in free for caller in self._callers(each))
        return list(found)

    def _callers(self, func: Func) -> Iterable[Func]:
        return self.callers(func) if self.callers is not None else ()

    def _is_free(self, func: Func) -> bool:
        return "static" in func.fact.traits or self.folder.nesting.object_of(func) is None

    def _beside(self, func: Func) -> Iterator[Func]:
        """Yield the functions of the file and of the class of one, and those that make its objects."""
        yield from self.folder.program.functions_in(func.file)
        own = self.folder.nesting.object_of(func)
        for cls in self._around(own) if own is not None else ():
            yield from (method for entry in self.folder.program.ancestry(cls) for method in entry.methods)
            for each in (cls, *self.folder.program.derived(cls)):
                yield from self.makers(each) if self.makers is not None else ()

    def _around(self, cls: Cls) -> Sequence[Cls]:
        """A class, and those that have an object of it as a member, which are handed its node or are it."""
        found = {cls: None}
        for _ in range(MAX_DEPTH):
            found |= dict.fromkeys(holder for each in list(found) for holder in self._holders.get(each, ()))
        return list(found)

    @cached_property
    def _holders(self) -> Mapping[Cls, Sequence[Cls]]:
        """The classes of C++ that have a member of a class."""
        program, found = self.folder.program, defaultdict[Cls, list[Cls]](list)
        for holder in (cls for group in program.classes.values() for cls in group if cls.file.language == "cpp"):
            for field in holder.fact.fields:
                held = program.class_named(plain(pointee(field.type)), holder.file, holder.fact.scope)
                if held is not None and held is not holder:
                    found[held].append(holder)
        return found


def _says_so(func: Func) -> bool:
    by_default = (calls_in(default) for _, default in func.defaults)
    if any(_is_option(call) for calls in (*func.calls, *by_default) for call in calls):
        return True
    return func.file.language == "python" and any(_is_set(step) or _has_option(step.value) for step in func.fact.body)


def _is_set(step: Statement) -> bool:
    """`options["allow_undeclared_parameters"] = True`."""
    target = step.target
    named = isinstance(target, Op) and target.op == "[]" and target.operands[-1] in _KEYS
    return named and step.value == _TRUE


def _has_option(expr: Expr | None) -> bool:
    """Tell whether a table of options in an expression is of a node that takes any."""
    if isinstance(expr, Table) and any(key in _KEYS and value == _TRUE for key, value in expr.entries):
        return True
    return expr is not None and any(map(_has_option, children(expr)))


def _is_option(call: Call) -> bool:
    name = getattr(call.callee, "name", "")
    by_name = any(key in _OPTIONS and value == _TRUE for key, value in call.keywords)
    return by_name or (name in _OPTIONS and call.args == (_TRUE,))
