"""The profile of QoS that a variable holds at a place: what it is given, what is set on it, and by whom."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Set
from typing import TYPE_CHECKING, Any, Protocol

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import Held, State
from ecm_extract.infer.places import ALL_FIELDS
from ecm_extract.infer.run import Run
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import expressions, last_of
from ecm_extract.link.endpoints.qos_handed import stays
from ecm_extract.link.endpoints.qos_presets import UNSEEN, agreed, preset_of
from ecm_extract.link.folding.declared_members import is_surely_made
from ecm_extract.link.running.env import Env, Instance

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_REMADE = "emplace"
"""The method of an optional that makes what it holds."""
Policies = dict[str, Any]
_End = tuple[Run | None, Env]
"""Policy -> its value."""


class Profiles(Protocol):
    """Evaluates profiles."""

    def policies(self, expr: Expr, env: Env, level: int) -> Policies:
        """Return what an expression sets; `level` is the nesting of evaluations."""

    def set_by(self, expr: Call, env: Env) -> Policies:
        """Return what one setter sets."""

    def assigned(self, key: str, value: Expr, env: Env) -> Policies:
        """Return what the assignment of a field sets."""


class QosVariables:
    """Tells what variables hold: as the run of their function has it, or else as all methods leave a member."""

    def __init__(self, folder: Folder, profiles: Profiles) -> None:
        self.folder = folder
        self.profiles = profiles
        self._begun: dict[tuple[Cls, str, Instance | None], Policies | None] = {}
        self._asked: set[Hashable] = set()

    def at(self, expr: Name | Member, env: Env, level: int) -> Policies | None:
        """Return the policies of a variable at a place; None for a variable that nobody gives a profile."""
        key = self.folder.flow.effects(env.func).key(expr)
        found, cls = self._at(expr, key, env, level), env.this or env.func.cls
        if found is None or cls is None or not _is_member(key):
            return found
        return preset_of(self._type_of(key[1:], cls)) | found

    def _at(self, expr: Name | Member, key: str, env: Env, level: int) -> Policies | None:
        states = self.folder.flow.decisions.likely(self.folder.flow.states(env))
        parts = {each for state in states for each in state.holds if key and each.startswith(f"{key}.")}
        if parts:
            return self._in_states(key, sorted(parts), states, env, level)
        ways = self.folder.flow.ways(expr, env, likely=True)
        found = [self._any_of(helds, env, level) for helds in ways]
        if not found or None in found:
            return self._around(expr, key, env, level)
        return agreed([policies for policies in found if policies is not None])

    def left_of_base(self, end: State, env: Env, level: int) -> Policies:
        """Return what a constructor of C++ leaves the base of its object with, as which it is a profile."""
        key = self.folder.flow.effects(env.func).base
        found = self._any_of(end.holds.get(key) or (Held("given", key),), env, level)
        return dict(UNSEEN) if found is None else found

    def _base_begun(self, held: Held, env: Env, level: int) -> Policies | None:
        """What the base of an object is where a method begins: what its caller had, or what makes it by itself."""
        if not env.func.is_constructor or env.func.cls is None:
            entered = self.folder.states.entered(held.name, env)
            return self._any_of((entered,), env, level) if entered is not None else None
        return self.profiles.policies(Call(Name(env.func.cls.fact.bases[0]), ()), env.entry(), level + 1)

    def with_fields(self, whole: Policies, end: State) -> Policies:
        """Return a profile of Python with what its constructor gives the fields of its object."""
        fields = [key for key in end.holds.within("") if _is_member(key)]
        return dict(UNSEEN) if f".{ALL_FIELDS}" in fields else self._with_parts(whole, fields, end)

    def is_own(self, expr: Name | Member, env: Env) -> bool:
        """Tell whether a name is a variable of the function at hand, which hides what stands outside of it."""
        outline = self.folder.flow.outline(env.func)
        return isinstance(expr, Name) and not outline.is_module and expr.id in outline.effects.own

    def of_function_around(self, expr: Name | Member, env: Env) -> Env | None:
        """Return the place in the function around the one at hand that has a variable; None for none of its own.

        A function that others call has what is left in the end: of a variable that is given its value once. A lambda
        of C++ may hold a copy of what the variable was where the lambda was made: it counts if nobody changed it since.
        """
        place = self.folder.names.captured_at(expr.id, env) if isinstance(expr, Name) else None
        if place is None or not isinstance(expr, Name):
            return None
        is_called = place is env.outer or self.folder.flow.is_bound_once(place.func, expr.id)
        fixed = env.func.file.language == "python" or not self._changes_behind(expr.id, env.func, place.func)
        return place if is_called and fixed else None

    def _changes_behind(self, name: str, inner: Func, outer: Func) -> bool:
        """Whether a function may change its variable once it has made the lambda that another one is, or stands in."""
        names = {each.fact.name for each in (inner, *self.folder.nesting.around(inner))}
        body, outline = outer.fact.body, self.folder.flow.outline(outer)
        made = next((at for at, statement in enumerate(body) if _makes_lambda(statement, names)), -1)
        return any(name in outline.changed_by(at) for at in range(made + 1, len(body)))

    def _in_states(
        self, key: str, parts: Iterable[str], states: Iterable[State], env: Env, level: int
    ) -> Policies | None:
        found: list[Policies] = []
        for state in states:
            given = (Held("given", key),) if key in env.func.given else ()
            whole = self._any_of(state.holds.get(key, given), env, level)
            if whole is None:
                return None
            found.append(self._with_parts(whole, parts, state))
        return agreed(found) if found else None

    def _with_parts(self, whole: Policies, parts: Iterable[str], state: State) -> Policies:
        """A profile with what its fields are given; one that somebody may have given anything is unknown."""
        found = dict(whole)
        for part in parts:
            helds = self.folder.flow.decisions.ways(state.holds.get(part, ()), likely=True)
            told = [self._of_part(part.rpartition(".")[2], held, whole) for held in helds]
            found |= agreed(told) if told else {}
        return found

    def _of_part(self, field: str, held: Held, whole: Policies) -> Policies:
        """What a field holds, by its policy: one that is left alone is as the whole profile has it."""
        if held.how == "given":
            return {field: whole[field]} if field in whole else {}
        left = self.folder.behind_calls.left(held, held.env) if held.how == "after" and held.env is not None else None
        if left is not None:
            ways = self.folder.flow.decisions.ways(tuple(left[0]), likely=True)
            return agreed([self._of_part(field, each, whole) for each in ways])
        known = held.how == "value" and held.expr is not None and held.env is not None
        told = self.profiles.assigned(field, held.expr, held.env) if known and held.expr and held.env else None
        return told or _unknown(field)

    # --- what a variable holds -----------------------------------------------------------------------------

    def _any_of(self, helds: Iterable[Held], env: Env, level: int) -> Policies | None:
        """The policies that all things have which a variable may hold; None where not all of them are known."""
        ways = self.folder.flow.decisions.ways(tuple(helds), likely=True)
        found = [self._held(held, env, level) for held in ways if not _is_nothing(held)]
        known = [policies for policies in found if policies is not None]
        return agreed(known) if known and len(known) == len(found) else None

    def _held(self, held: Held, env: Env, level: int) -> Policies | None:
        inner = held.env if held.env is not None else env
        if held.how == "value" and held.expr is not None:
            return self.profiles.policies(held.expr, inner, level + 1)
        if held.how == "made":
            return preset_of(self.folder.objects.type_of(Name(held.name.removeprefix(".")), inner))
        if held.how == "changed" and isinstance(held.expr, Call):
            if last_of(held.expr.callee) == _REMADE:
                return self.profiles.policies(Items(held.expr.args), inner, level + 1)
            before = self._any_of(held.before, env, level)
            return None if before is None else before | self.profiles.set_by(held.expr, inner)
        if held.how == "handed":  # a function may change it; what is no profile stays none
            before = self._any_of(held.before or (Held("given", held.name),), inner, level)
            return before if before is None or stays(held, self.folder) else dict(UNSEEN)
        if held.how in {"looped", "reached", "entered"}:
            return self._once(held, held.before, inner, level)
        if held.how == "after":
            return self._behind_call(held, env, level)
        if held.how == "out":
            return self._handed_out(held, inner, level)
        if held.how in {"given", "shared"}:
            return self._left_alone(held, inner, level)
        return dict(UNSEEN) if held.how in {"lost", "stored", "read"} else None

    def _behind_call(self, held: Held, env: Env, level: int) -> Policies | None:
        """What a method of the tree leaves a member with."""
        place = held.env or env
        left, what = self.folder.behind_calls.left(held, place), (place.func, held.expr, held.name)
        return self._once(what, left[0], left[1].deeper(env.depth + 1), level + 1) if left is not None else None

    def _once(self, what: Hashable, helds: Iterable[Held], env: Env, level: int) -> Policies | None:
        """What some things are; of what depends on itself, by a loop or a method that calls itself, all is unknown."""
        if what in self._asked:
            return dict(UNSEEN)
        self._asked.add(what)
        try:
            return self._any_of(helds, env, level)
        finally:
            self._asked.discard(what)

    def _left_alone(self, held: Held, env: Env, level: int) -> Policies | None:
        """What a variable is that the function at hand has given nothing yet."""
        first, cls = held.how == "given", env.this or env.func.cls
        if first and held.name in env.func.given:
            return self._passed(held.name, env, level)
        if first and held.name == self.folder.flow.effects(env.func).base:
            return self._base_begun(held, env, level)
        if cls is None or not _is_member(held.name):
            return None
        begun = self._as_begun(held.name[1:], cls, env, level) if first else None
        return begun if begun is not None else self._of_member(held.name, cls, env, level)

    def _handed_out(self, held: Held, env: Env, level: int) -> Policies:
        """What a function makes of a profile that it is handed, as a whole or field by field."""
        left = self.folder.behind_calls.out(held, env)
        run = self.folder.flow.run(left[1]) if left is not None else None
        if left is None or run is None or run.end is None:
            return dict(UNSEEN)
        ways, inner = left[0], left[1].deeper(env.depth + 1)
        whole = self._any_of(ways, inner, level + 1)
        parts = [key for key in run.end.holds if key.startswith(f"{held.name}.")]
        return self._with_parts(whole, parts, run.end) if whole is not None else dict(UNSEEN)

    def _passed(self, name: str, env: Env, level: int) -> Policies | None:
        """What a function is called with, or what its parameter is by default; None where that is no profile."""
        bound = self.folder.names.argument(name, env)
        given = self.profiles.policies(bound.expr, bound.env, level + 1) if bound is not None else {}
        default = next((each.default for each in env.func.fact.params if each.name == name), None)
        if given or default is None:
            return given or None
        return self.profiles.policies(default, env.entry(), level + 1) or None

    def _around(self, expr: Name | Member, key: str, env: Env, level: int) -> Policies | None:
        """What a variable is where the function at hand leaves it alone."""
        cls = env.this or env.func.cls
        if _is_member(key) and cls is not None:
            begun = self._as_begun(key[1:], cls, env, level)
            return begun if begun is not None else self._of_member(key, cls, env, level)
        if key in env.func.given:
            return self._passed(key, env, level)
        ways = self.folder.flow.ways(expr, env)
        found = self._any_of(self.folder.origins.held(expr, env), env, level) if not ways else None
        return found if found is not None or not isinstance(expr, Member) else self._of_object(expr, env, level)

    def _of_object(self, expr: Member, env: Env, level: int) -> Policies | None:
        """A member of another object: what it is where that is handed on, or what the class of that makes of it."""
        structures = self.folder.structures
        kept = self.folder.kept.is_kept(expr.base, env)
        handed = (structures.handed(expr, env) or structures.part(expr, env)) if not kept else None
        if handed is not None:
            return self.profiles.policies(handed.expr, handed.env.deeper(env.depth + 1), level + 1)
        made = structures.constructed_at(expr.base, env) if not kept else []
        if made:
            return self._constructed(expr.name, made, level)
        cls = self.folder.kept.class_of(expr, env) if kept else self.folder.objects.class_of(expr.base, env)
        if cls is None or self.folder.members.is_given(expr.name, cls):
            return None
        place = Env(env.func, env.at, this=cls, depth=env.depth + 1)
        return self._of_member(f".{expr.name}", cls, place, level)

    def _constructed(self, name: str, places: Iterable[Env], level: int) -> Policies | None:
        """What constructors make of a member with the arguments that they are given."""
        found: list[Policies] = []
        for place in places:
            cls = place.this
            changed = cls is None or self.folder.changed_outside.is_changed(name, cls)
            made = self._of_member(f".{name}", cls, place, level) if cls is not None and not changed else None
            if made is None:
                return dict(UNSEEN) if changed else None
            found.append(made)
        return agreed(found)

    def _of_member(self, key: str, cls: Cls, env: Env, level: int) -> Policies | None:
        """What its constructor makes of a member, or declares it with, beside what methods give it before."""
        asked = (cls, key, env.made)
        if asked in self._begun:
            return self._begun[asked]
        if self.folder.changed_outside.is_changed(key[1:], cls):
            return dict(UNSEEN)
        self._begun[asked] = self._declared(key[1:], cls, env, level)
        try:
            ends = list(self.folder.members.ends(key[1:], cls, env))
            made = self._left(key, self._begun[asked], [end for end in ends if end[1].func.is_constructor], level)
            self._begun[asked] = agreed(made) if made else self._begun[asked]
            later = self._left(key, self._begun[asked], [end for end in ends if not end[1].func.is_constructor], level)
            declared = self._begun[asked] if not made else None
            stays = declared is not None and not (later and is_surely_made(key[1:], cls, env, self.folder))
            found = [*made, *later, *([declared] if declared is not None and stays else [])]
            return preset_of(self._type_of(key[1:], cls)) | agreed(found) if found else None
        finally:
            del self._begun[asked]

    def _left(self, key: str, begun: Policies | None, ends: Iterable[_End], level: int) -> list[Policies]:
        """What methods leave a member with that they give something."""
        found = [self._at_end(key, begun, run, place, level) for run, place in ends]
        return [policies for policies in found if policies is not None]

    def _at_end(self, key: str, begun: Policies | None, run: Run | None, place: Env, level: int) -> Policies | None:
        if run is None or run.end is None:
            return dict(UNSEEN) if run is None else None
        helds = self.folder.flow.shown(run, key)
        parts = [each for each in run.end.holds if each.startswith(f"{key}.")]
        given = any(held.how not in {"given", "shared"} for held in helds)
        whole = self._any_of(helds, place, level) if given else begun if parts else None
        return None if whole is None else self._with_parts(whole, parts, run.end)

    def _as_begun(self, name: str, cls: Cls, env: Env, level: int) -> Policies | None:
        """What a member of C++ is declared with, in the constructor of its class, which has left it alone so far."""
        owner = next((each for each in self.folder.program.ancestry(cls) if name in each.fields), None)
        if owner is None or env.func.file.language != "cpp" or not env.func.is_constructor or owner is not env.func.cls:
            return None
        return self._declared(name, cls, env, level)

    def _type_of(self, name: str, cls: Cls) -> str:
        return next((each.fields[name].type for each in self.folder.program.ancestry(cls) if name in each.fields), "")

    def _declared(self, name: str, cls: Cls, env: Env, level: int) -> Policies | None:
        """What a data member, its own or of a base, is declared with; None for no such."""
        owner = next((each for each in self.folder.program.ancestry(cls) if name in each.fields), None)
        field = owner.fields[name] if owner is not None else None
        if owner is None or field is None or field.default is None or isinstance(field.default, Constant):
            return (preset_of(field.type) or None) if field is not None else None
        left = self.left_by_module(Member(Name(owner.fact.name), name), owner.file, env, level)
        place = self.folder.names.at_class(owner, cls, env)
        return left or self.profiles.policies(field.default, place, level + 1)

    def left_by_module(self, expr: Name | Member, file: File, env: Env, level: int) -> Policies | None:
        """Return what the body of a module of Python leaves a profile of it with, of which it changes fields."""
        place = self.folder.names.module_end(file, env) if file.language == "python" else None
        key = dotted_name(expr)
        changed = self.folder.flow.outline(place.func).changes if place is not None else ()
        return self.at(expr, place, level) if place and any(each.startswith(f"{key}.") for each in changed) else None


def _unknown(field: str) -> Policies:
    return {field: UNSEEN[field]} if field in UNSEEN else {}


def _is_member(key: str) -> bool:
    return key.startswith(".") and key.count(".") == 1


def _makes_lambda(statement: Statement, names: Set[str]) -> bool:
    """Tell whether a statement has a lambda that is read as a function of one of the names."""
    named = {statement.target.id if isinstance(statement.target, Name) else ""}
    return any(isinstance(expr, Lambda) and names & (named | {expr.name}) for expr, _ in expressions(statement))


def _is_nothing(held: Held) -> bool:
    """Tell whether a variable is given no object."""
    return held.how == "value" and isinstance(held.expr, Constant)
