"""Expressions of which nothing that is written in a tree tells what they give: to look for it is lost time.

Told is what comes from something that is written: a literal, a default, a constant. What comes from messages, from
libraries and from devices is not, and neither is what such a value decides. Whoever hears that something is untold
takes it for unknown, which is never wrong.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name, Op

from ecm_extract.link.code.member_paths import below_variable
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import given_to
from ecm_extract.link.running.assumed import Assumed
from ecm_extract.link.running.untold_returns import gives_untold
from ecm_extract.link.running.untold_variables import UntoldVariables, Variable

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_DECIDING: Final = frozenset({"&&", "||"})


class Untold:
    """Tells what is untold, each function and each variable once, wherever it is asked for."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._variables = UntoldVariables(folder, self)
        self._all = Assumed[Func | Variable](self._is_untold)  # each depends on others of both kinds

    def _is_untold(self, asked: Func | Variable) -> bool:
        return self._variables.is_untold(asked) if isinstance(asked, Variable) else gives_untold(asked, self)

    def forget(self) -> None:
        """Drop what was found, since more is known of parameters now."""
        self._all = Assumed[Func | Variable](self._is_untold)

    def has(self, expr: Expr, func: Func, at: int) -> bool:
        """Tell whether nothing tells what an expression gives.

        Args:
            expr: the expression.
            func: the function that it stands in.
            at: its statement there, by index.
        """
        if isinstance(expr, Op):
            return self._of_op(expr, func, at)
        if isinstance(expr, Call):
            return self._of_call(expr, func, at)
        return self._of_variable(expr, func, at, of_parts=False)

    def has_within(self, expr: Expr, func: Func, at: int) -> bool:
        """Tell whether nothing tells what the elements or fields of something are, as `has` does for it as a whole."""
        if isinstance(expr, Op | Call):
            return self.has(expr, func, at)
        return self._of_variable(expr, func, at, of_parts=True)

    def _of_variable(self, expr: Expr, func: Func, at: int, of_parts: bool) -> bool:
        if not isinstance(expr, Name | Member):
            return False
        effects = self.folder.flow.effects(func)
        key = effects.key(expr)
        owner = func.holder if key.startswith(".") else func if key.partition(".")[0] in effects.own else None
        if key and owner is not None and key.count(".") <= 1 and self._all.of(Variable(owner, key, of_parts)):
            return True
        return isinstance(expr, Member) and expr.base != THIS and self._of_field(expr, key, func, at)

    def _of_field(self, field: Member, key: str, func: Func, at: int) -> bool:
        """Whether a field is one of something untold, to which the function gives nothing, and no parameter's."""
        if self._variables.is_given(key, func):
            return False
        if self.folder.reads.is_declared(below_variable(field).path, func.file.package):
            return False
        return self.has_within(field.base, func, at)

    def _of_op(self, expr: Op, func: Func, at: int) -> bool:
        """Whether an operand is; of what decides by its first operand, and of what is looked up in another, that is."""
        first = expr.operands[0]
        if expr.op == "[]":
            return self.has_within(first, func, at)
        asked = (first,) if expr.op in _DECIDING else expr.operands
        return any(self.has(each, func, at) for each in asked)

    def _of_call(self, call: Call, func: Func, at: int) -> bool:
        """Whether a function of the tree gives what is untold, or one of a library is given that."""
        target = self.folder.flow.target(call, func, at)
        if target is not None:
            return not target.is_constructor and self._all.of(target)
        if isinstance(call.callee, Member):
            if self.folder.reads.knows(last_name(call.callee.name)):
                return False  # a parameter has a default
            asks = self.has_within if call.args else self.has  # for an element, or whether there is any
            if asks(call.callee.base, func, at):
                return True
        return any(self.has(each, func, at) for each in given_to(call) if not isinstance(each, Lambda))
