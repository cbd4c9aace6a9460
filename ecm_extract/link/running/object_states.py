"""What the members of an object hold when a method begins: what its callers left there, where all callers are known."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from typing import TYPE_CHECKING, Final

import msgspec
from ecm_parsers.source.expr import THIS, Call, Expr, Name

from ecm_extract.infer.held import MAX_WAYS, Held, State
from ecm_extract.infer.places import owners
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.pointed import given_to_pointed, pointed
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, Instance, invocation_of
from ecm_extract.link.running.implicit_makers import ImplicitMakers
from ecm_extract.link.running.kept_members import KeptMembers
from ecm_extract.link.running.known_callers import KnownCallers

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


MAX_NESTED: Final = 1
"""Members whose beginning is sought within that of another; beyond, what callers left is not known: programs of many
classes would be run again and again."""


class ObjectStates:
    """Follows the state of an object from the methods that call to the methods that are called."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.callers = KnownCallers(folder)
        self.kept_members = KeptMembers(folder)
        self._implicit = ImplicitMakers(folder.program)
        self._known: dict[Hashable, Held | None] = {}
        self._meanwhile: dict[Hashable, Held | None] = {}
        self._nested = 0

    def forget(self) -> None:
        """Drop what was found, since more of the parameters is known now."""
        self._known.clear()

    def entered(self, key: str, env: Env) -> Held | None:
        """Return what a member holds when the method at a place begins; None where that is not known.

        Args:
            key: the member (see `places`).
            env: a place in the method.
        """
        func = env.func
        if func.cls is None or func.is_constructor or not key.startswith("."):
            return None
        found = self.folder.object_fields.at_caller(key, env)
        if found is not None or key.count(".") > 2:
            return found
        within = key.count(".") == 2
        if within and (self._is_other_by_now(key, env) or not self.kept_members.is_followed(key, env)):
            return None
        if not within and not self._may_differ(key[1:], env.this or func.cls, env):
            return None
        if env.depth > MAX_DEPTH:
            self.folder.cuts += 1
            return None
        if not self.folder.flow.running:
            self._meanwhile.clear()
        asked = (key, self.folder.flow.keys.of(env))
        if asked in self._known:
            return self._known[asked]
        if asked not in self._meanwhile:
            self._meanwhile[asked] = None  # who asks in a circle does not know
            cuts = self.folder.cuts
            found = self._within_bounds(key, env)
            (self._known if cuts == self.folder.cuts else self._meanwhile)[asked] = found
            return found
        return self._meanwhile[asked]

    def _is_other_by_now(self, key: str, env: Env) -> bool:
        """Whether the method itself has given the member something, or done something to it, in which a field lies."""
        return any(whole in state.holds for state in self.folder.flow.states(env) for whole in owners(key))

    def _within_bounds(self, key: str, env: Env) -> Held | None:
        if self._nested >= MAX_NESTED:
            self.folder.cuts += 1
            return None
        self._nested += 1
        try:
            return self._entered(key, env)
        finally:
            self._nested -= 1

    def _may_differ(self, name: str, cls: Cls, env: Env) -> bool:
        """Whether it matters who calls: for a member that shifts, or that is what the object was made with."""
        made = env.made is not None and env.made.maker is not None
        if self.folder.shifting.member(name, cls) or self.folder.object_fields.is_given(name, cls):
            return True
        return not made and self.folder.shifting.is_passed(name, cls)

    def _entered(self, key: str, env: Env) -> Held | None:
        outside = key.count(".") == 1 and self.callers.may_be_written_outside(key[1:], env.func)
        if outside and not self.folder.object_fields.is_known(env):
            return None
        places = [env.caller] if env.caller is not None else list(self._calling(env))
        found = [self._left(key, place, env) for place in places]
        known = [held for held in found if held is not None]
        if not known or len(known) < len(found) or len(known) > MAX_WAYS:
            return None
        return known[0] if len(known) == 1 else Held("entered", key, env=env, before=tuple(known))

    def _calling(self, env: Env) -> Iterator[Bound]:
        """The objects that a method is called on, as its callers write them; none where it may have other callers."""
        for call, place in self.callers.of(env.func) or ():
            if is_own(call.receiver):
                same = env.this is not None and call.func.cls in self.folder.program.ancestry(env.this)
                this, made = (env.this, env.made) if same else (call.func.cls, None)
                yield Bound(THIS, Env(call.func, place.at, this=this, made=made, depth=env.depth + 1))
            elif call.receiver is not None:
                yield Bound(call.receiver, place.deeper(env.depth + 1))

    def _left(self, key: str, caller: Bound, env: Env) -> Held | None:
        """What a member of an object holds at a call on it."""
        place = caller.env
        part = None if is_own(caller.expr) else self._made_at(caller.expr, place)
        if part is not None:
            made = self._as_made(key, part)
            return made[0] if made else None
        prefix = "" if is_own(caller.expr) else self.folder.flow.effects(place.func).key(caller.expr)
        if not prefix and not is_own(caller.expr):
            return None
        ways: dict[Held, None] = {}
        flow = self.folder.flow
        for state in flow.states(place):
            found = self._in_state(key, prefix, state, place, env) if flow.decisions.is_live(state.route) else ()
            if found is None:
                return None
            ways.update(dict.fromkeys(found))
        return Held("entered", key, env=place, before=tuple(ways)) if 0 < len(ways) <= MAX_WAYS else None

    def _in_state(self, key: str, prefix: str, state: State, place: Env, env: Env) -> Sequence[Held] | None:
        made = self._maker(prefix, state, place) if prefix else None
        if prefix and (made is None or not _may_be(made.made, env.made)):
            return None
        helds = self.folder.flow.decisions.ways(state.holds.get(prefix + key, ()))
        if helds:
            return helds
        if state.called or any(prefix + whole in state.holds for whole in owners(key)):
            return None
        return (Held("given", key),) if made is None else self._as_made(key, made)

    def _as_made(self, key: str, maker: Env) -> Sequence[Held] | None:
        """What a constructor leaves a member with."""
        run = self.folder.flow.run(maker)
        if run is None or run.end is None or run.end.called:
            return None
        if key.count(".") > 1 and not self.folder.flow.left(run, key):
            return self.kept_members.as_made(key, maker, run)
        return (Held("entered", key, env=maker, before=self.folder.flow.left(run, key) or (Held("given", key),)),)

    # --- objects -------------------------------------------------------------------------------------------

    def instance(self, receiver: Expr, env: Env) -> Instance | None:
        """Return how an object is made: where it is asked, for a variable of the function, or as a part of others."""
        place = self._made_at(receiver, env)
        if place is not None:
            return place.made
        key = self.folder.flow.effects(env.func).key(receiver)
        made = [self._maker(key, state, env) for state in self.folder.flow.states(env)] if key else []
        known = [entry.made for entry in made if entry is not None and entry.made is not None]
        alike = bool(known) and len(known) == len(made) and all(_may_be(known[0], other) for other in known)
        return known[0] if alike else None

    def _made_at(self, expr: Expr, env: Env) -> Env | None:
        """The beginning of the constructor that makes a part of an object, or one where it is asked."""
        place = self.folder.parts.maker(expr, env)
        return self.constructor(expr, env) if place is None and isinstance(expr, Call) else place

    def _maker(self, key: str, state: State, env: Env) -> Env | None:
        """The beginning of the constructor that made the object in a local variable which nobody else has."""
        if "." in key or not self.callers.keeps_to_itself(key, env.func):
            return None
        helds = self.folder.flow.decisions.ways(state.holds.get(key, ()))
        held = helds[0] if len(helds) == 1 else None
        if held is None or held.env is None:
            return None
        if held.how == "made":
            return self._declared(key, held.env)
        return self.constructor(held.expr, held.env) if held.how == "value" and isinstance(held.expr, Call) else None

    def _declared(self, name: str, env: Env) -> Env | None:
        """The beginning of the constructor that `Topic topic;` runs."""
        written = self.folder.scope.declared_type(name, env)
        return self.constructor(Call(Name(written), ()), env) if by_value(written) else None

    def constructor(self, call: Call, env: Env) -> Env | None:
        """Return the beginning of the constructor that a call runs, or of what it makes behind a pointer; else None."""
        made = invocation_of(call, env)
        written = pointed(call) or (made.path.replace(".", "::") if made.receiver is None else "")
        made = msgspec.structs.replace(made, args=given_to_pointed(made.last, made.args))
        cls = self.folder.objects.class_written(written, env) if written else None
        maker = self._maker_of(cls, made) if cls is not None else None
        if cls is None or maker is None:
            return None
        args = bind(maker, made, env)
        return Env(maker, 0, args, this=cls, made=Instance(cls, args, {}, maker), depth=env.depth + 1)

    def _maker_of(self, cls: Cls, call: Invocation) -> Func | None:
        """The constructor with a body that a call runs; without arguments also the one that nobody writes."""
        maker = self.folder.objects.constructor(cls, call)
        if maker is None:
            return self._implicit.of(cls) if not call.args else None
        return maker if maker.fact.body or "declaration" not in maker.fact.traits else None


def is_own(receiver: Expr | None) -> bool:
    """Tell whether a call is one on the object at hand, or what is called on is the object at hand."""
    return receiver is None or receiver == THIS or is_super(receiver)


def _may_be(one: Instance | None, other: Instance | None) -> bool:
    """Tell whether two ways of making an object are the same, or one of them is any."""
    if one is None or other is None or not (one.maker and other.maker):
        return True
    if one.maker is not other.maker or one.args.keys() != other.args.keys():
        return False
    return all(bound.expr is other.args[name].expr for name, bound in one.args.items())
