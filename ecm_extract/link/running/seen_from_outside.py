"""Functions that know the object at hand as one of a class outside of the tree only, as `rclcpp::Node * node`.

They cannot name the members of the class of the tree that it is. One that hands it on, or turns it into something
else, is none of them: only functions that do nothing but call its methods are.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Opaque

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.handing_on import hands_on
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def leaves_members(call: Invocation, env: Env, folder: Folder) -> bool:
    """Tell whether a call that is given the object at hand runs a function that cannot change its members."""
    if call.receiver is not None or call.func.file.language != "cpp":
        return False
    callee = folder.returns.meant(call, env)
    if callee is None or callee.cls is not None or not callee.fact.body:
        return False
    given = bind(callee, call, env)
    own = _Methods(env, folder).has
    if hands_on(_rest(call), own):
        return False
    names = [name for name, bound in given.items() if bound.expr == THIS]
    return bool(names) and all(_is_foreign(name, callee, folder) and _Asked(name, own).of(callee) for name in names)


class _Methods:
    """The methods that the tree gives the object at hand."""

    def __init__(self, env: Env, folder: Folder) -> None:
        self.cls = env.this or env.func.cls
        self.program = folder.program

    def has(self, name: str) -> bool:
        """Tell whether one has a name; of an object that is not known any may."""
        if self.cls is None:
            return True
        lineage = (*self.program.ancestry(self.cls), *self.program.derived(self.cls))
        return any(method.fact.name == name for entry in lineage for method in entry.methods)


def _rest(call: Invocation) -> Call:
    """The call without the object at hand."""
    return Call(Name(call.last), tuple([arg for arg in call.args if arg != THIS]))


def _is_foreign(name: str, callee: Func, folder: Folder) -> bool:
    """Whether a parameter is declared as a pointer or reference to a class that the tree does not have."""
    written = next((entry.type for entry in callee.fact.params if entry.name == name), "")
    kind = plain(pointee(written))
    if not kind or kind == "auto" or kind in callee.fact.template:
        return False
    program = folder.program
    return not program.seen_classes(last_name(kind), callee.file) and not program.alias(kind, callee.file, callee.scope)


class _Asked:
    """Whether a function only calls methods of a parameter, none of which a class of the tree overrides."""

    def __init__(self, name: str, is_own: Callable[[str], bool]) -> None:
        self.name = name
        self.is_own = is_own

    def of(self, callee: Func) -> bool:
        parts = (part for entry in callee.fact.body for part in (entry.target, entry.value) if part is not None)
        return not any(map(self._escapes, parts))

    def _escapes(self, expr: Expr) -> bool:
        if isinstance(expr, Opaque):
            return expr.may_name(self.name)
        if isinstance(expr, Name):
            return expr.id == self.name
        if isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.base == Name(self.name):
            given = (*expr.args, *(value for _, value in expr.keywords))
            return self.is_own(expr.callee.name) or any(map(self._escapes, given))
        return any(map(self._escapes, children(expr)))
