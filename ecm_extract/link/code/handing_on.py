"""Whether a call gives others the object at hand, or a function that may use it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.walk import calls_in, children

Asked = Callable[[str], bool]
"""What is asked of a method by its name."""


def hands_on(
    call: Call | Invocation,
    is_method: Asked,
    changes: Asked = lambda name: True,
    leaves: Callable[[Lambda], bool] = lambda made: False,
) -> bool:
    """Tell whether the arguments of a call are, or hold, the object at hand, a method of it, or a lambda that uses it.

    Args:
        call: the call.
        is_method: tells whether the object has a method of a name.
        changes: tells whether a method of a name may change what is a part of the object.
        leaves: tells whether a lambda of several statements does nothing to the object.
    """
    given = _Given(is_method, changes, leaves)
    return any(map(given.gives, (*call.args, *(value for _, value in call.keywords))))


@dataclass(frozen=True, slots=True)
class _Given:
    """What arguments give of the object at hand."""

    is_method: Asked
    changes: Asked
    leaves: Callable[[Lambda], bool]

    def gives(self, expr: Expr) -> bool:
        """Tell whether an argument gives the object, or a way to it."""
        if isinstance(expr, Lambda):
            return not self.leaves(expr) if expr.body is None else any(map(self._reaches, calls_in(expr.body)))
        if expr == THIS:
            return True
        if is_own_member(expr):
            return self.is_method(expr.name)
        if isinstance(expr, Call) and isinstance(expr.callee, Member) and _is_own(expr.callee.base):
            return self._hands_on(expr)
        return any(map(self.gives, children(expr)))

    def _hands_on(self, call: Call) -> bool:
        return any(map(self.gives, (*call.args, *(value for _, value in call.keywords))))

    def _reaches(self, call: Call) -> bool:
        """Whether a call in a lambda runs a method of the object at hand, changes a part of it, or hands it on."""
        callee = call.callee
        if isinstance(callee, Name) and self.is_method(callee.id):
            return True  # in C++ one of the object at hand
        if isinstance(callee, Member) and _is_own(callee.base):
            return self.is_method(callee.name) or self._hands_on(call)
        root = callee
        while isinstance(root, Member):
            root = root.base
        part = root == THIS and isinstance(callee, Member) and self.changes(callee.name)
        return part or self._hands_on(call)


def _is_own(expr: Expr) -> bool:
    """Whether a method is called on the object at hand, as one of its base too: `super(Arm, self).name()`."""
    return expr == THIS or (isinstance(expr, Call) and expr.callee == Name("super"))
