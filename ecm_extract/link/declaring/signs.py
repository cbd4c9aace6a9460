"""Objects of a type that no source here shows, told by what is made with them: `ros::Subscriber s = nh.subscribe(...)`.

A member of a base class of another package has no declaration in the tree. What its calls give, and the message types
that they are called with, say what it is; then it is that for its other calls in the same class as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

from ecm_parsers.source.expr import Call, Member, Name, Text

from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.declaring.forms import Form, FormTable
from ecm_extract.link.declaring.instead import is_asked
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env

_Place = Cls | Func
_WITHOUT: Final = 2
"""Arguments of a call that names a parameter, and the variable that takes it; a condition asks whether it is there."""
_WITH_OTHERWISE: Final = 3
"""The same, with what the variable is otherwise: of an object of any unknown type that says enough."""


class Signs:
    """Tells whether objects of unknown types are of a class of a row.

    Args:
        forms: the rows.
        folder: gives types.
    """

    def __init__(self, forms: FormTable, folder: Folder) -> None:
        self.forms = forms
        self.folder = folder
        self._shown: dict[tuple[_Place, str], frozenset[str]] = {}

    def show(self, form: Form, call: Invocation, env: Env) -> bool:
        """Tell whether a call, or another one on the same object, shows that it is of a class of the row."""
        return self._shows(form, call, env) or not self._classes(call, env).isdisjoint(form.receiver)

    def _shows(self, form: Form, call: Invocation, env: Env) -> bool:
        if (call.types and "template:" in form.type) or _reads(form, call, _WITH_OTHERWISE):
            return True
        if _reads(form, call, _WITHOUT) and is_asked(call) and self._is_given_by_base(call):
            return True
        statement = call.statement
        value = statement.value
        if not form.gives or statement.target is None or not isinstance(value, Call) or not _is(value, call):
            return False
        written = statement.type or self.folder.objects.type_of(statement.target, env)
        meant = self.folder.program.alias(plain(written), env.func.file, env.scope) or written
        return plain(meant) == form.gives

    def _is_given_by_base(self, call: Invocation) -> bool:
        """Whether a receiver is a member of a base outside of the tree, or what a method of that gives."""
        receiver = call.receiver.callee if isinstance(call.receiver, Call) else call.receiver
        name, own = own_name(receiver), self.folder.nesting.object_of(call.func)
        given = name in self.folder.flow.effects(call.func).own or name in call.func.given
        is_own_member = own is not None and name and "::" not in name and not given
        lineage = self.folder.program.ancestry(own) if own is not None and is_own_member else ()
        if any(name in entry.fields or any(method.fact.name == name for method in entry.methods) for entry in lineage):
            return False
        program = self.folder.program
        bases = ((base, entry) for entry in lineage for base in entry.fact.bases)
        return any(program.class_named(plain(base), entry.file, entry.fact.scope) is None for base, entry in bases)

    def _classes(self, call: Invocation, env: Env) -> frozenset[str]:
        """The classes of which a receiver is by what the other calls on it show."""
        name = own_name(call.receiver)
        if not name:
            return frozenset()
        local = name in self.folder.flow.effects(call.func).own
        place: _Place = call.func if local or call.func.cls is None else call.func.cls
        known = self._shown.get((place, name))
        if known is None:
            self._shown[place, name] = frozenset()  # who asks in a circle
            known = self._shown[place, name] = frozenset(self._found(place, name, env))
        return known

    def _found(self, place: _Place, name: str, env: Env) -> Iterator[str]:
        for call in _calls(place, self.forms):
            inner = Env(call.func, call.at, this=env.this)
            for form in self.forms[call.last] if own_name(call.receiver) == name else ():
                if form.receiver and not form.row.value and self._shows(form, call, inner):
                    yield from form.receiver


def _calls(place: _Place, wanted: FormTable) -> Iterator[Invocation]:
    functions: Iterable[Func] = place.methods if isinstance(place, Cls) else (place,)
    for func in functions:
        yield from invocations(func, wanted)


def _reads(form: Form, call: Invocation, count: int) -> bool:
    """Whether a call of so many arguments reads what a text names into a variable."""
    if not (form.row.value and form.out) or bool(form.default) != (count == _WITH_OTHERWISE) or len(call.args) != count:
        return False
    name, out = call.args[:2]
    return isinstance(name, Text) and isinstance(out, Name | Member)


def _is(value: Call, call: Invocation) -> bool:
    """Whether a value is a call itself, and none that it stands in."""
    name = value.callee.name if isinstance(value.callee, Member) else ""
    return name == call.last and value.line == call.line and value.args == call.args
