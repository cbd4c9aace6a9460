"""Functions of libraries, and methods of nodes, in whose place somebody of Python gives another one.

`rospy.get_param = read`, `Node.create_publisher = other`, `setattr(Node, name, other)`: what a call of it does is open.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Text

from ecm_extract.infer.places import ALL_FIELDS
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import dotted
from ecm_extract.link.index.module_kinds import is_node_base
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ANY: Final = "*"
"""Stands for every name."""
_CLASS_OF_OBJECT: Final = "__class__"


class _Given(NamedTuple):
    """What a function gives something: the class, module or object that has it from then on."""

    owner: Expr
    func: Func


class ReplacedCalls:
    """Looks through the functions of Python once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.program = folder.program

    def may_be(self, call: Invocation, env: Env) -> bool:
        """Tell whether a call of a library may run what somebody gave in its place."""
        if call.func.file.language != "python":
            return False
        given = (*self._given.get(call.last, ()), *self._given.get(_ANY, ()))
        return any(self._is_meant(each, call, env) for each in given if self._sees(each.func, call.func))

    def _sees(self, giver: Func, caller: Func) -> bool:
        return self.program.sees(giver.file, caller.file) or self.program.sees(caller.file, giver.file)

    @cached_property
    def _given(self) -> Mapping[str, Sequence[_Given]]:
        found: dict[str, list[_Given]] = defaultdict(list)
        for func in (each for each in self.program.every_function() if each.file.language == "python"):
            for statement in func.fact.body:
                for name, owner in _given_by(statement.target) if statement.kind == "set" else ():
                    found[name].append(_Given(owner, func))
        return found

    def _is_meant(self, given: _Given, call: Invocation, env: Env) -> bool:
        if call.receiver is None and not call.simple:
            holder = self._full(call.path, call.func).rpartition(".")[0]
            return self._full(dotted(given.owner) or "", given.func) == holder
        return self._is_of_method(given, call, env)

    def _full(self, written: str, func: Func) -> str:
        return self.program.canonical(written, func.file) if written else ""

    def _is_of_method(self, given: _Given, call: Invocation, env: Env) -> bool:
        """Whether what is given something is the object of a call, its class, or a base of that."""
        own = call.receiver in {None, THIS}
        nesting, objects = self.folder.nesting, self.folder.objects
        cls = nesting.object_of(call.func) if own else objects.class_of(call.receiver, env) if call.receiver else None
        if given.owner == THIS or _is_of_own_class(given.owner):
            holder = nesting.object_of(given.func)
            return holder is not None and cls is not None and self._are_related(holder, cls)
        written = self._full(dotted(given.owner) or "", given.func)
        if given.owner == call.receiver and given.func.file is call.func.file:
            return True
        bases = self.program.base_names(cls) if cls is not None else []
        names = {each.fact.name for each in self.program.ancestry(cls)} if cls is not None else set[str]()
        last = last_name(written.replace(".", "::"))
        return last in names or written in bases or (cls is None and bool(written) and is_node_base(written))

    def _are_related(self, one: Cls, other: Cls) -> bool:
        return one in self.program.ancestry(other) or other in self.program.ancestry(one)


def _given_by(target: Expr | None) -> Iterator[tuple[str, Expr]]:
    """Yield the name of what a target gives something, and what has it; of an object no name that is put together."""
    if isinstance(target, Member):
        yield target.name, target.base
    elif isinstance(target, Op) and target.op == "[]" and isinstance(target.operands[0], Member):
        table, key = target.operands[0], target.operands[1]
        if table.name == ALL_FIELDS and (isinstance(key, Text) or table.base != THIS):
            yield key.value if isinstance(key, Text) else _ANY, table.base


def _is_of_own_class(owner: Expr) -> bool:
    """Whether something is the class of the object at hand: `type(self)`, `self.__class__`."""
    if isinstance(owner, Call):
        return owner.callee == Name("type") and owner.args == (THIS,)
    return isinstance(owner, Member) and owner.base == THIS and owner.name == _CLASS_OF_OBJECT
