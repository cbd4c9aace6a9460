"""Which calls run functions of the tree, and with them perhaps methods of the object at hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.link.code.handing_on import hands_on
from ecm_extract.link.code.own import is_own_member, is_super
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import given_to
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.lambdas import leaves_object

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class OwnCalls:
    """Tells of calls whether they stay in the tree; which methods the objects of a class have is worked out once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.program = folder.program
        self._methods: dict[Cls, frozenset[str]] = {}
        self._known: dict[tuple[Func, int], tuple[Call, ...]] = {}
        self._reaching: dict[tuple[Func, int, Cls | None, Call], bool] = {}

    def of(self, env: Env) -> tuple[Call, ...]:
        """Return the calls of a statement that may run functions of the tree; of each statement it is asked often."""
        key = (env.func, env.at)
        known = self._known.get(key)
        if known is None:
            found = [call for call in env.func.calls[env.at] if self.is_own(call, env.func, env.at)]
            known = self._known[key] = tuple(found)
        return known

    def is_own(self, call: Call, func: Func, at: int) -> bool:
        """Tell whether a call in a statement of a function may run a function of the tree."""
        last = invocation_of(call, Env(func, at)).last
        if last in calls_of(func.file.language).calling and any(map(_is_own_function, given_to(call))):
            return True
        return bool(last) and bool(self.program.seen_functions(last, func.file))

    def reaches_object(self, call: Call, env: Env) -> bool:
        """Tell whether a call that stays in the tree may run a method of the object at hand; often asked as well."""
        key = (env.func, env.at, env.this, call)
        known = self._reaching.get(key)
        if known is None:
            known = self._reaching[key] = self._reaches_object(call, env)
        return known

    def _reaches_object(self, call: Call, env: Env) -> bool:
        found = invocation_of(call, env)
        if found.receiver == THIS or is_super(found.receiver):
            return True
        implied = found.receiver is None and env.func.file.language != "python"
        makes = found.statement.kind != "init" and self._is_class(found.last, env)  # another object, not this one
        return self.hands_on(call, env) or (implied and not makes and self._is_method(found.last, env))

    def hands_on(self, call: Call, env: Env) -> bool:
        """Tell whether a call gives others the object at hand, or a function that may change it."""
        file = env.func.file
        changing = calls_of(file.language).changing
        return hands_on(
            call,
            lambda name: self._may_change(name, env),
            lambda name: name in changing or bool(self.program.seen_functions(name, file)),
            lambda made: leaves_object(made, env, self.folder),
        )

    def _may_change(self, name: str, env: Env) -> bool:
        """Whether some method of that name of the object at hand may change its members."""
        cls = env.this or env.func.cls
        if cls is None or not self._is_method(name, env):
            return False
        lineage = (*self.program.ancestry(cls), *self.program.derived(cls))
        named = [each for entry in lineage for each in entry.methods if each.fact.name == name and each.fact.body]
        return not named or not all(self.folder.methods.leaves(each, cls) for each in named)

    def _is_class(self, name: str, env: Env) -> bool:
        cls = env.this or env.func.cls
        return cls is not None and any(entry.fact.name == name for entry in self.program.ancestry(cls))

    def _is_method(self, name: str, env: Env) -> bool:
        cls = env.this or env.func.cls
        if cls is None:
            return False
        known = self._methods.get(cls)
        if known is None:
            lineage = (*self.program.ancestry(cls), *self.program.derived(cls))
            known = self._methods[cls] = frozenset(each.fact.name for entry in lineage for each in entry.methods)
        return name in known


def _is_own_function(arg: Expr) -> bool:
    """Whether an argument is a method of the object at hand, or a lambda, that whoever gets it calls at once."""
    return isinstance(arg, Lambda) or arg == THIS or is_own_member(arg)
