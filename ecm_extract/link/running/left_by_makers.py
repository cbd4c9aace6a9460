"""What a constructor of Python leaves as it got it, and keeps nowhere: `Talker("a", profile)` reads its profile."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Lambda, Name

from ecm_extract.infer.bare_names import bare_names
from ecm_extract.infer.reading_calls import leaves_arguments
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import dotted, expressions, given_to, last_of, names_in
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class LeftByMakers:
    """Tells it; each parameter of a constructor is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._kept: dict[tuple[Func, str], bool] = {}

    def is_left(self, call: Call, arg: Expr, func: Func, at: int) -> bool:
        """Tell whether the class that a call makes an object of leaves an argument alone, and keeps it nowhere."""
        env = Env(func, at, this=func.cls)
        maker = self.of(call, env)
        if maker is None:
            return False
        names = [name for name, bound in bind(maker, invocation_of(call, env), env).items() if bound.expr is arg]
        return bool(names) and not any(self._takes(maker, name) for name in names)

    def _takes(self, maker: Func, name: str) -> bool:
        """Whether a constructor may change a parameter, or keeps it."""
        return self.folder.methods.parameters.may(maker, name) or self._keeps(maker, name)

    def of(self, call: Call, env: Env) -> Func | None:
        """Return the constructor that a call of a class runs; None of other calls."""
        name = (dotted(call.callee) or "").replace(".", "::")
        own = isinstance(call.callee, Name) and call.callee.id in self.folder.flow.effects(env.func).own
        cls = self.folder.program.class_named(name, env.func.file, env.func.scope) if name and not own else None
        return self.folder.objects.constructor(cls, invocation_of(call, env)) if cls is not None else None

    def _keeps(self, maker: Func, name: str) -> bool:
        """Whether anything else may have a parameter from then on."""
        known = self._kept.get((maker, name))
        if known is None:
            key = self.folder.flow.effects(maker).key
            held = any(key(each) == name for part in self._holding(maker) for each in bare_names(part))
            known = self._kept[maker, name] = held or name in _in_lambdas(maker)
        return known

    def _holding(self, maker: Func) -> Iterator[Expr]:
        """What variables are given, and what calls get that are none of a library which leaves it alone."""
        for each in maker.fact.body:
            if each.value and each.kind != "do" and not self._is_of_client_library(each.value):
                yield each.value
        for call in (call for group in maker.calls for call in group):
            if not leaves_arguments(call.callee, maker) and not self._is_of_client_library(call):
                yield from given_to(call)

    def _is_of_client_library(self, value: Expr) -> bool:
        return isinstance(value, Call) and self.folder.flow.keeps(last_of(value.callee))


def _in_lambdas(func: Func) -> frozenset[str]:
    """The names in lambdas of a function, which whoever gets them can ask for."""
    parts = (part for each in func.fact.body for part, _ in expressions(each))
    return frozenset([name for part in parts if isinstance(part, Lambda) for name in names_in(part.body)])
