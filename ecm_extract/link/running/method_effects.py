"""Which members a call of a method may change, through all methods of the same object that it calls in turn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Member, Name

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.places import ALL_FIELDS
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.changed_parameters import MAX_FIELDS, ChangedParameters
from ecm_extract.link.running.env import Env, Instance, invocation_of
from ecm_extract.link.running.given_itself import GivenItself
from ecm_extract.link.running.object_states import is_own
from ecm_extract.link.running.own_pointers import OwnPointers
from ecm_extract.link.running.seen_from_outside import leaves_members

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class MethodEffects:
    """Tells what calls of methods do to the objects that they are called on."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[tuple[Func, Cls | None], Set[str] | None] = {}
        self._depending: dict[tuple[Func, Cls | None], bool] = {}
        self._calling: dict[Func, bool] = {}
        self._through: dict[Func, Set[str]] = {}
        self._pointers = OwnPointers(folder)
        self._given = GivenItself(folder)
        self.parameters = ChangedParameters(folder)

    def called_on(self, call: Call, env: Env) -> str | None:
        """Return the variable of the object that a method is called on: empty for that at hand, None for others."""
        return "" if self.folder.flow.own.reaches_object(call, env) else self.holder(invocation_of(call, env), env)

    def changed(self, call: Call, env: Env) -> Mapping[str, str] | None:
        """Return the members that a call of a method may change; None where that is not known.

        Args:
            call: a call on the object at hand, or on one that a variable of the function holds.
            env: where it stands.

        Returns:
            The member as a variable of the function that calls -> as one of the method.
        """
        found = invocation_of(call, env)
        if self._is_outside(found, env) and not self.folder.flow.own.hands_on(call, env):
            return {}
        if self._makes_base(found) or leaves_members(found, env, self.folder):
            return {}
        given = self._given.changed(call, env.func, env.this or env.func.cls) if self._is_given(call, env) else None
        if given is not None:
            return {key: key for key in sorted(given)}
        prefix = "" if is_own(found.receiver) else self.holder(found, env)
        if prefix is None:
            return None
        callee = self._meant(found, env)
        if callee is None or self.folder.flow.own.hands_on(call, env):
            return None
        members = self.members(callee, self.folder.returns.object_at(callee, found, env))
        if members is None or (members and not is_own(found.receiver) and not self._is_made(found, env)):
            return None
        return {prefix + key: key for key in sorted(members)}

    def _is_given(self, call: Call, env: Env) -> bool:
        """Whether a function of Python, and no method of the object, gets that or a method of it."""
        own = isinstance(call.callee, Name)
        return own and env.func.file.language == "python" and self.folder.flow.own.hands_on(call, env)

    def _makes_base(self, call: Invocation) -> bool:
        """Whether a call makes a base of the object at hand, whose own members begin after that."""
        cls, last = call.func.cls, call.last
        if call.statement.kind != "init" or cls is None or last == cls.fact.name:
            return False
        return any(entry.fact.name == last for entry in self.folder.program.ancestry(cls)[1:])

    def _is_outside(self, call: Invocation, env: Env) -> bool:
        """Whether a call on the object at hand means a method of a base outside of the tree."""
        cls = env.func.cls
        if call.receiver is None or cls is None:
            return False
        lineage = self.folder.program.ancestry(cls) if call.receiver == THIS else self.folder.program.ancestry(cls)[1:]
        derived = self.folder.program.derived(env.this or cls) if call.receiver == THIS else ()
        known = (method for entry in (*lineage, *derived) for method in entry.methods)
        return is_own(call.receiver) and not any(method.fact.name == call.last for method in known)

    def holder(self, call: Invocation, env: Env) -> str | None:
        """Return the variable of an object that the function has; None for other calls."""
        effects = self.folder.flow.effects(env.func)
        key = effects.key(call.receiver)
        if not key or call.receiver is None:
            return None
        own = env.func.file.language == "cpp" and key in effects.own and key not in env.func.given
        if own and self.folder.objects.class_of(call.receiver, env) is not None:
            return key
        return key if self._is_made(call, env) else None

    def _is_made(self, call: Invocation, env: Env) -> bool:
        """Whether it is known how an object was made that a method is called on, and that nobody else has it."""
        return call.receiver is not None and self.folder.states.instance(call.receiver, env) is not None

    def calls_own(self, func: Func) -> bool:
        """Tell whether a function may call methods of the object at hand."""
        known = self._calling.get(func)
        if known is None:
            own = self.folder.flow.own
            asked = ((call, Env(func, at)) for at, calls in enumerate(func.calls) for call in calls)
            known = any(own.is_own(call, func, place.at) and own.reaches_object(call, place) for call, place in asked)
            self._calling[func] = known
        return known

    def begun(self, call: Invocation, env: Env) -> Env | None:
        """Return the beginning of the method that a call runs, or of the function that is declared around the call."""
        callee = self.folder.returns.meant(call, env)
        if callee is None or callee not in self.folder.flow.outline(env.func).captured:
            return self.entry(call, env)
        return self.folder.returns.entered(callee, call, bind(callee, call, env), env)

    def entry(self, call: Invocation, env: Env) -> Env | None:
        """Return the beginning of the one method that a call runs; None where several fit."""
        callee = self._meant(call, env)
        return self.folder.returns.entered(callee, call, bind(callee, call, env), env) if callee is not None else None

    def _meant(self, call: Invocation, env: Env) -> Func | None:
        """The one method that a call runs; None where several fit, or a class that derives may have its own."""
        callee = self.folder.returns.meant(call, env)
        method = callee is not None and callee.cls is not None
        return callee if callee and method and not self.folder.redefined.may_be(callee, call, env) else None

    def members(self, func: Func, this: Cls | None) -> Set[str] | None:
        """Return the members that a method changes, or those that it calls on the same object; None: nobody knows."""
        asked = (func, this)
        if asked not in self._known:
            self._known[asked] = None  # who asks in a circle does not know
            self._known[asked] = self._reached(func, this)
        return self._known[asked]

    def leaves(self, func: Func, this: Cls) -> bool:
        """Tell whether a method changes no member of its object, through none of the methods that it calls either."""
        return self.members(func, this) == frozenset()

    def all_leave(self, name: str, func: Func) -> bool:
        """Tell whether no method of a name that a function sees changes its object."""
        methods = [each for each in self.folder.program.seen_functions(name, func.file) if each.cls is not None]
        return all(each.cls is not None and self.leaves(each, each.cls) for each in methods)

    def changed_by(self, func: Func, env: Env) -> Set[str] | None:
        """Return the members that a function declared in another one changes, or methods that it calls; None: any."""
        return self.members(func, env.this or env.func.cls)

    def depends(self, func: Func, this: Cls | None) -> bool:
        """Tell whether what a method does depends on when it is called: on members that are given several things."""
        asked = (func, this)
        if asked not in self._depending:
            self._depending[asked] = False  # who asks in a circle
            called = self._called(func, this) or () if func.cls is not None else ()
            own = self.folder.shifting.is_read(func, this) or self.folder.object_fields.reads(func, this)
            read = self.folder.properties.read_by(func, this)
            self._depending[asked] = own or any(self.depends(each, this) for each in (*called, *read))
        return self._depending[asked]

    def _reached(self, func: Func, this: Cls | None) -> Set[str] | None:
        """The members that a method changes, or those that it calls on the same object."""
        found: set[str] = set()
        seen, pending = {func}, [func]
        while pending:
            current = pending.pop()
            found |= {key for key in self.folder.flow.outline(current).changes if key.startswith(".")}
            found |= self.changed_through(current) | self._by_given(current, this)
            if f".{ALL_FIELDS}" in found:
                return None
            called = self._called(current, this)
            if called is None:
                return None
            called |= self._declared(current)
            pending += called - seen
            seen |= called
        return found

    def _declared(self, func: Func) -> set[Func]:
        """The functions that one declares and calls: what they call on the object is called by it."""
        outline = self.folder.flow.outline(func)
        return {each for calls in func.calls for call in calls for each in outline.run_by(call)}

    def _by_given(self, func: Func, this: Cls | None) -> Set[str]:
        """The members that functions change which a method gives its object, or a method of that."""
        found: set[str] = set()
        for at, calls in enumerate(func.calls):
            for call in calls:
                if self._is_given(call, Env(func, at, this=this)):
                    found |= self._given.changed(call, func, this) or set()
        return found

    def changed_through(self, func: Func) -> Set[str]:
        """Return the members, or fields of them, that methods may change which a function calls on members."""
        known = self._through.get(func)
        if known is None:
            self._through[func] = frozenset()  # who asks in a circle
            known = self._through[func] = frozenset(self._by_methods_of_members(func))
        return known

    def _by_methods_of_members(self, func: Func) -> Iterator[str]:
        effects = self.folder.flow.effects(func)
        yield from self._by_pointers(func)
        for at, calls in enumerate(func.calls):
            for call in calls:
                callee = call.callee
                key = effects.root(callee.base) if isinstance(callee, Member) else ""
                if key[:1] == "." and len(key) > 1 and self.folder.flow.own.is_own(call, func, at):
                    yield from self._changed_of(key, invocation_of(call, Env(func, at)), Env(func, at))

    def _by_pointers(self, func: Func) -> Iterator[str]:
        """The fields that a function changes by members which point to others of the same object."""
        fields = (key.split(".", 2) for key in self.folder.flow.outline(func).changes if key.count(".") > 1)
        for before, member, rest in fields:
            pointed = self._pointers.of(member, func.cls) if not before and func.cls is not None else ()
            yield from (f".{name}.{rest}" for name in pointed)

    def _changed_of(self, key: str, call: Invocation, place: Env) -> Iterator[str]:
        """The fields of a member that a method of its class may change; the member where that is not known, or many."""
        callee = self._meant(call, place)
        members = self.members(callee, None) if callee is not None else None
        fields = {member.split(".")[1] for member in members or ()}  # what lies deeper is a part of these
        if members is None or len(fields) > MAX_FIELDS:
            yield key
            return
        yield from (f"{key}.{field}" for field in fields)

    def _called(self, func: Func, this: Cls | None) -> set[Func] | None:
        """The methods that a method calls on its object; None where somebody else may change that meanwhile."""
        table, own = calls_of(func.file.language), self.folder.flow.own
        made = Instance(this, {}, {}) if this is not None else None
        found: set[Func] = set()
        for at, calls in enumerate(func.calls):
            place = Env(func, at, this=this, made=made)
            for call in calls:
                if table.waits(call) or self._hands_itself(call, func):
                    return None
                if own.is_own(call, place.func, place.at) and own.reaches_object(call, place):
                    known = self._runs(call, place)
                    if known is None:
                        return None
                    found |= known
        return found

    def _hands_itself(self, call: Call, func: Func) -> bool:
        """Whether a method gives its object to a function that it was handed, or has in a variable."""
        own = isinstance(call.callee, Name) and call.callee.id in self.folder.flow.effects(func).own
        return own and THIS in call.args

    def _runs(self, call: Call, place: Env) -> set[Func] | None:
        """The method that a call on the object at hand runs, none for one outside of the tree; None: nobody knows."""
        if self.folder.flow.own.hands_on(call, place):
            given = self._is_given(call, place) and self._given.changed(call, place.func, place.this)
            return set() if isinstance(given, Set) else None
        found = invocation_of(call, place)
        if self._is_outside(found, place):
            return set()
        callee = self._meant(found, place)
        return {callee} if callee is not None else None
