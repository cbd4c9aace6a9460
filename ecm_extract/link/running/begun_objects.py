"""What the attributes of an object of Python are before its constructor runs: what its class says of them.

Source: docs.python.org, "Data model", "Class instances": an attribute is looked up in the object, then in its class. As
long as nobody gives the class something else, that is as if each object was given it first.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Constant, Expr, Member, Name, Number, Op, Template, Text

from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.held import Held, State
from ecm_extract.link.code.units import Cls
from ecm_extract.link.code.walk import dotted
from ecm_extract.link.index.implied_makers import is_plain as is_plain_class
from ecm_extract.link.running.class_attributes import ClassAttributes
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_NAMES: Final = 4
"""Names that stand for each other, of which the last one tells a value."""


class Attribute(NamedTuple):
    """What a class says of an attribute, and which of its bases does."""

    owner: Cls
    value: Expr


class BegunObjects:
    """Tells the attributes of a class that nobody changes; each class is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.attributes = ClassAttributes(folder.program)
        self._known: dict[Cls, Mapping[str, Attribute]] = {}

    def state(self, env: Env) -> State:
        """Return the state in which a function begins: that of an object that is being made, where it is one."""
        cls = env.this
        if cls is None or cls.file.language != "python" or not env.func.is_constructor:
            return State()
        hidden = self.folder.redefined.is_hidden
        begun = {name: each for name, each in self.of(cls).items() if not hidden(name, cls, env)}
        return State().having({f".{name}": (self._held(name, each, cls, env),) for name, each in begun.items()})

    def _held(self, name: str, begun: Attribute, cls: Cls, env: Env) -> Held:
        return Held("value", f".{name}", begun.value, self.folder.names.at_class(begun.owner, cls, env))

    def of(self, cls: Cls) -> Mapping[str, Attribute]:
        """Return the attributes of a class that are known, each as the nearest of its bases says it."""
        known = self._known.get(cls)
        if known is None:
            known = self._known[cls] = dict(self._found(cls)) if is_plain_class(cls, self.folder.program) else {}
        return known

    def _found(self, cls: Cls) -> Iterator[tuple[str, Attribute]]:
        seen: set[str] = set()
        for owner in self.folder.program.ancestry(cls):
            methods = {method.fact.name for method in owner.methods}
            own = self.attributes.of(owner)
            for name, value in own.items():
                if name not in seen | methods and self._stays(value, owner) and self._is_known(name, value, owner, cls):
                    yield name, Attribute(owner, value)
            seen |= {*own, *methods}

    def _is_known(self, name: str, value: Expr, owner: Cls, cls: Cls) -> bool:
        """Whether a class has what its body says of an attribute, as nobody decides that, or changes it later."""
        plain = isinstance(value, Text | Number | Constant)
        once = plain or sum(each.name == name for each in owner.fact.fields) == 1
        attributes = self.attributes
        return once and not attributes.is_chosen(name, owner) and not attributes.may_change(name, cls, owner)

    def _stays(self, value: Expr | None, owner: Cls, depth: int = 0) -> bool:
        """Whether a value is one that nobody can change in place: a text, a number, or what names such a one."""
        if isinstance(value, Text | Number | Constant | Template):
            return True
        if isinstance(value, Op):
            added = value.op == "+" and any(self._stays(each, owner, depth) for each in value.operands)
            return added or is_plain(value)
        named = dotted(value) if isinstance(value, Name | Member) and depth < MAX_NAMES else None
        stated = self.folder.program.constant_named(named, owner.file) if named else None
        return stated is not None and self._stays(stated.constant.value, owner, depth + 1)
