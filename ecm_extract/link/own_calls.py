"""Which calls run functions of the tree, and with them perhaps methods of the object at hand."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_parsers.source.expr import Call, Expr, Lambda, Name

from ecm_extract.link.env import Env, invocation_of
from ecm_extract.link.objects import is_super
from ecm_extract.link.program import Program
from ecm_extract.link.units import Cls, Func
from ecm_extract.link.walk import children

_THIS = Name("this")


class OwnCalls:
    """Tells of calls whether they stay in the tree; of a statement it is worked out once for each class of object."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._reaching: dict[tuple[Func, int, Cls | None], bool] = {}

    def is_own(self, call: Call, func: Func, at: int) -> bool:
        """Tell whether a call in a statement of a function may run a function of the tree."""
        last = invocation_of(call, Env(func, at)).last
        return bool(last) and bool(self.program.seen_functions(last, func.file))

    def reaches_object(self, calls: Sequence[Call], env: Env) -> bool:
        """Tell whether those calls of a statement that stay in the tree may run a method of the object at hand."""
        key = (env.func, env.at, env.this)
        known = self._reaching.get(key)
        if known is None:
            known = self._reaching[key] = any(self._reaches(call, env) for call in calls)
        return known

    def _reaches(self, call: Call, env: Env) -> bool:
        found = invocation_of(call, env)
        if found.receiver == _THIS or is_super(found.receiver):
            return True
        handed = (*call.args, *(value for _, value in call.keywords))
        return any(_hands_on(arg) for arg in handed) or (found.receiver is None and self._is_method(found.last, env))

    def _is_method(self, name: str, env: Env) -> bool:
        cls = env.this or env.func.cls
        if cls is None or env.func.file.language == "python":
            return False
        lineage = (*self.program.ancestry(cls), *self.program.derived(cls))
        return any(method.fact.name == name for entry in lineage for method in entry.methods)


def _hands_on(arg: Expr) -> bool:
    """Whether an argument gives the object at hand, or a function that may use it."""
    return arg == _THIS or isinstance(arg, Lambda) or any(_hands_on(part) for part in children(arg))
