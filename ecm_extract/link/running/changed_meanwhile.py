"""Members that objects change which were given the object that has them: `helper_(this)`, `helper_.fill()`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Op

from ecm_extract.infer.places import as_written
from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import last_of
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ITSELF: Final = frozenset({"shared_from_this", "weak_from_this"})
"""en.cppreference.com, std::enable_shared_from_this."""


class ChangedMeanwhile:
    """Tells which members may change while an object calls others; each member of a class is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[str, Cls], bool] = {}
        self._given_to: dict[Cls, Set[str]] = {}

    def is_changed(self, name: str, env: Env) -> bool:
        """Tell whether somebody to whom the object at hand was given changes a member of it, or calls who does."""
        cls = env.this or env.func.cls
        if cls is None:
            return False
        known = self._known.get((name, cls))
        if known is None:
            self._known[name, cls] = False  # who asks in a circle
            known = self._known[name, cls] = any(self._has(func, cls) for func in self._changing(name, cls))
        return known

    def _changing(self, name: str, cls: Cls) -> Iterator[Func]:
        """Yield the functions that change a member of another object, themselves or by a method of that."""
        outside = self.folder.changed_outside
        yield from outside.changing(name, cls)
        lineage = self.folder.program.ancestry(cls)
        methods = {each.fact.name for entry in lineage for each in self.folder.scope.changing(name, entry)}
        for func, owner in (each for method in sorted(methods) for each in self._asking.get(method, ())):
            if outside.owns(func, owner, cls):
                yield func

    def _has(self, func: Func, cls: Cls) -> bool:
        """Whether an object of a class gives itself to objects that have a function as their method."""
        program = self.folder.program
        if func.cls is None or func.cls in program.ancestry(cls):
            return False
        given = self._takers(cls)
        return any(each.fact.name in given for each in (*program.ancestry(func.cls), *program.derived(func.cls)))

    def _takers(self, cls: Cls) -> Set[str]:
        """The names of the classes to whose objects an object of a class gives itself."""
        known = self._given_to.get(cls)
        if known is None:
            methods = [each for entry in self.folder.program.ancestry(cls) for each in entry.methods]
            within = [func for method in methods for func in (method, *self.folder.nesting.inner(method))]
            known = self._given_to[cls] = frozenset(name for func in within for name in self._given_by(func))
        return known

    def _given_by(self, func: Func) -> Iterator[str]:
        for call in invocations(func):
            if any(map(_gives_itself, (*call.args, *(value for _, value in call.keywords)))):
                yield from self._class_names(call, Env(func, call.at))

    def _class_names(self, call: Invocation, env: Env) -> Iterator[str]:
        """The class that a call makes an object of, or whose method it is."""
        yield call.last
        if call.statement.kind == "init":
            yield last_name(plain(pointee(self.folder.scope.member_type(call.last, env.func.cls))))
        of = self.folder.objects.class_of(call.receiver, env) if call.receiver is not None else None
        if of is not None:
            yield of.fact.name

    @cached_property
    def _asking(self) -> Mapping[str, Sequence[tuple[Func, Expr]]]:
        """Name of a method -> the functions that call it on what a member of theirs has, with that member."""
        found: dict[str, list[tuple[Func, Expr]]] = defaultdict(list)
        for func in self.folder.changed_outside.functions:
            for callee in (call.callee for calls in func.calls for call in calls):
                key = self.folder.flow.effects(func).key(callee.base) if isinstance(callee, Member) else ""
                if isinstance(callee, Member) and key.startswith("."):
                    found[callee.name].append((func, as_written(key)))
        return found


def _gives_itself(arg: Expr) -> bool:
    """Tell whether an argument is the object at hand, or a pointer to it."""
    if isinstance(arg, Op) and arg.op in {"*", "&"} and len(arg.operands) == 1:
        return _gives_itself(arg.operands[0])
    return arg == THIS or (isinstance(arg, Call) and last_of(arg.callee) in _ITSELF)
