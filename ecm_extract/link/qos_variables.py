"""The profile of QoS that a variable holds at a place: what it is given, what is set on it, and by whom."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import Held, State
from ecm_extract.link.env import Env
from ecm_extract.link.qos_presets import UNSEEN, agreed
from ecm_extract.link.scope import Definition

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

MAX_STEPS = 40
"""Statements after the making of a member that are looked at."""
Policies = dict[str, Any]
"""Policy -> its value."""


class Profiles(Protocol):
    """Evaluates profiles."""

    def policies(self, expr: Expr, env: Env, level: int) -> Policies:
        """Return what an expression sets; `level` is the nesting of evaluations."""

    def chain(self, expr: Expr, env: Env) -> Policies:
        """Return what setters set, one after the other."""

    def set_by(self, expr: Call, env: Env) -> Policies:
        """Return what one setter sets."""

    def assigned(self, key: str, value: Expr, env: Env) -> Policies:
        """Return what the assignment of a field sets."""


class _Steps(NamedTuple):
    """What follows the making of a profile, and how many branches enclose it."""

    statements: Sequence[Statement]
    depth: int = 0


class QosVariables:
    """Tells what variables hold: as the run of their function has it, or else as all methods leave a member."""

    def __init__(self, folder: Folder, profiles: Profiles) -> None:
        self.folder = folder
        self.profiles = profiles

    def at(self, expr: Name | Member, env: Env, level: int) -> Policies | None:
        """Return the policies of a variable at a place; None for a variable that nobody gives a profile."""
        key = self.folder.flow.effects(env.func).key(expr)
        parts = [each for each in self.folder.flow.outline(env.func).changes if key and each.startswith(f"{key}.")]
        if parts:
            return self._in_states(key, parts, env, level)
        ways = self.folder.flow.ways(expr, env)
        found = [self._any_of(helds, env, level) for helds in ways]
        if not found or None in found:
            return self._of_member(expr, env, level)
        return agreed([policies for policies in found if policies is not None])

    def _in_states(self, key: str, parts: Iterable[str], env: Env, level: int) -> Policies | None:
        found: list[Policies] = []
        for state in self.folder.flow.states(env):
            whole = self._any_of(state.holds.get(key, ()), env, level)
            if whole is None:
                return None
            found.append(whole | self._of_parts(parts, state))
        return agreed(found) if found else None

    def _of_parts(self, parts: Iterable[str], state: State) -> Policies:
        """What fields of a profile are given; one that somebody may have given anything is unknown."""
        found: Policies = {}
        for part in parts:
            field = part.rpartition(".")[2]
            for held in self.folder.flow.decisions.ways(state.holds.get(part, ())):
                known = held.how == "value" and held.expr is not None and held.env is not None
                told = self.profiles.assigned(field, held.expr, held.env) if known and held.expr and held.env else None
                found = agreed([found, told]) if field in found and told else found | (told or _unknown(field))
        return found

    # --- what a variable holds -----------------------------------------------------------------------------

    def _any_of(self, helds: tuple[Held, ...], env: Env, level: int) -> Policies | None:
        """The policies that all things have which a variable may hold; None where not all of them are known."""
        found = [self._held(held, env, level) for held in self.folder.flow.decisions.ways(helds)]
        known = [policies for policies in found if policies is not None]
        return agreed(known) if known and len(known) == len(found) else None

    def _held(self, held: Held, env: Env, level: int) -> Policies | None:
        inner = held.env if held.env is not None else env
        if held.how == "value" and held.expr is not None:
            return None if isinstance(held.expr, Constant) else self.profiles.policies(held.expr, inner, level + 1)
        if held.how == "made":
            return {}
        if held.how == "changed" and isinstance(held.expr, Call):
            before = self._any_of(held.before, env, level)
            return None if before is None else before | self.profiles.set_by(held.expr, inner)
        if held.how in {"looped", "handed", "entered"}:
            return self._any_of(held.before, inner, level)
        if held.how == "after":
            left = self.folder.held.left(held, inner)
            return self._any_of(left[0], left[1], level) if left is not None else None
        return dict(UNSEEN) if held.how in {"lost", "out", "stored", "read"} else None

    # --- members -------------------------------------------------------------------------------------------

    def _of_member(self, expr: Name | Member, env: Env, level: int) -> Policies | None:
        """What all methods leave a member with, and what it is declared with."""
        name = expr.id if isinstance(expr, Name) else expr.name
        given = self.folder.assignments.definitions(expr, env)
        found = [self._defined(definition, name, inner, level) for definition, inner in given]
        known = [policies for policies in found if policies is not None]
        sure = any(definition.statement.depth == 0 for definition, _ in given)
        declared = None if known and sure else self._declared(name, expr, env, level)
        return (
            agreed([*known, *([declared] if declared is not None else [])]) if known or declared is not None else None
        )

    def _defined(self, definition: Definition, name: str, env: Env, level: int) -> Policies | None:
        value = definition.statement.value
        if value is None or definition.statement.kind == "each" or isinstance(value, Constant):
            return None
        later = definition.func.fact.body[definition.at :]
        return self._mutated(
            self.profiles.policies(value, env, level + 1), name, _Steps(later, definition.statement.depth), env
        )

    def _declared(self, name: str, expr: Name | Member, env: Env, level: int) -> Policies | None:
        """What a data member, its own or of a base, is declared with, and what methods set on it; None for no such."""
        cls = env.this or env.func.cls
        if cls is None or (isinstance(expr, Member) and expr.base != Name("this")):
            return None
        ancestry = self.folder.program.ancestry(cls)
        default = next((own.fields[name].default for own in ancestry if name in own.fields), None)
        if default is None:
            return None
        policies = self.profiles.policies(default, Env(env.func, depth=env.depth + 1, this=cls), level + 1)
        for method in (method for own in ancestry for method in own.methods):
            inner = Env(method, this=cls, depth=env.depth + 1)
            policies = self._mutated(policies, name, _Steps(method.fact.body), inner)
        return policies

    def _mutated(self, policies: Policies, name: str, steps: _Steps, env: Env) -> Policies:
        """What a profile is after `qos.reliable();` and `qos.depth = 5`; where a branch does so, it may be either."""
        for statement in steps.statements[:MAX_STEPS]:
            changed = {**policies, **self._mutation(name, statement, env)}
            policies = changed if statement.depth <= steps.depth else agreed([policies, changed])
        return policies

    def _mutation(self, name: str, statement: Statement, env: Env) -> Policies:
        value, target = statement.value, statement.target
        if statement.kind == "do" and isinstance(value, Call) and _root(value) == name:
            return self.profiles.chain(value, env)
        if statement.kind == "set" and isinstance(target, Member) and _root(target) == name and value is not None:
            return self.profiles.assigned(target.name, value, env)
        return {}


def _unknown(field: str) -> Policies:
    return {field: UNSEEN[field]} if field in UNSEEN else {}


def _root(expr: Expr) -> str:
    while isinstance(expr, Call | Member):
        if isinstance(expr, Member) and expr.base == Name("this"):
            return expr.name
        expr = expr.callee if isinstance(expr, Call) else expr.base
    return expr.id if isinstance(expr, Name) else ""
