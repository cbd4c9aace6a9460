"""What constructors of profiles of QoS are given: a queue, a profile of rmw, keywords, or fields one by one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.calls import spreads
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.endpoints.qos_presets import UNSEEN
from ecm_extract.link.endpoints.qos_values import policy_word
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

Policies = dict[str, Any]
"""Policy -> its value."""
QUEUE = ("history", "depth")
_FIELDS = (*QUEUE, "reliability", "durability", "deadline", "lifespan", "liveliness", "liveliness_lease_duration")
"""Fields of the struct of rmw; those of its queue are arguments of `QoSInitialization`, too. Source: rmw/types.h."""
PROFILE = "rmw_qos_profile_t"
QUEUE_OF = "from_rmw"
"""Takes the queue of a profile of rmw, and nothing else of it."""
_ZERO = dict.fromkeys(("reliability", "durability", "history"), "system_default")
"""Fields that an initialiser of the struct leaves out are zero."""
_BY_FIELD = frozenset({"QoSInitialization", PROFILE})


class Evaluating(Protocol):
    """Evaluates profiles."""

    def policies(self, expr: Expr, env: Env, level: int) -> Policies:
        """Return what an expression sets; `level` is the nesting of evaluations."""

    def assigned(self, key: str, value: Expr, env: Env) -> Policies:
        """Return what the assignment of a field sets."""

    def number(self, expr: Expr, env: Env) -> int | None:
        """Return the whole number that an expression is."""


class QosMade:
    """Tells what a profile is that is made with arguments."""

    def __init__(self, folder: Folder, profiles: Evaluating) -> None:
        self.folder = folder
        self.profiles = profiles

    def of_call(self, name: str, expr: Call, env: Env, level: int) -> Policies:
        """Return the policies of a profile by what its constructor is called and given."""
        call, env = self.folder.spreading.whole(expr, env)
        if spreads(call):
            return {**UNSEEN}
        if name == "KeepAll":
            return {"history": "keep_all"}
        if name == "KeepLast" and call.args:
            return {"history": "keep_last", "depth": self.profiles.number(call.args[0], env)}
        if name == QUEUE_OF:
            return self.queue(call.args, env, level)
        policies = self._of_arguments(name, call.args, env, level)
        for key, value in call.keywords:
            policies.update(self.profiles.assigned(key, value, env))
        return policies

    def of_items(self, items: Sequence[Expr], env: Env, level: int) -> Policies:
        """Return what a braced initialiser or a list of arguments sets: fields of a struct, or those of a profile."""
        if env.func.file.language == "python":
            return self.profiles.policies(items[0], env, level)
        words = [bool(policy_word(item)) for item in items]
        kind = PROFILE if words[2:3] == [True] else "QoSInitialization" if words[0] and len(items) > 1 else "QoS"
        return self._of_arguments(kind, items, env, level)

    def is_member(self, callee: Expr, env: Env) -> bool:
        """Tell whether a constructor makes a member, a profile, of what it seems to call: `: qos_(KeepLast(1), p)`."""
        cls = env.this or env.func.cls
        if not isinstance(callee, Name) or cls is None or not env.func.is_constructor:
            return False
        owners = (each for each in self.folder.program.ancestry(cls) if callee.id in each.fields)
        return any(last_name(plain(each.fields[callee.id].type)).endswith("QoS") for each in owners)

    def queue(self, args: Sequence[Expr], env: Env, level: int) -> Policies:
        """Return the queue that a preset is made with: `SensorDataQoS(KeepLast(1))` is one in all but that."""
        given = self.profiles.policies(args[0], env, level) if args else {}
        return {key: given[key] for key in QUEUE if key in given}

    def field(self, key: str, value: Expr, env: Env) -> Policies:
        """Return the policy that a field of another profile has; nothing for what is no such field."""
        if not isinstance(value, Member) or value.name != key:
            return {}
        written = last_name(plain(self.folder.objects.type_of(value.base, env)))
        found = self.profiles.policies(value.base, env, 1) if written == PROFILE else {}
        return {key: found[key]} if key in found else {}

    def _of_arguments(self, name: str, args: Sequence[Expr], env: Env, level: int) -> Policies:
        if name in _BY_FIELD:
            return (dict(_ZERO) if name == PROFILE else {}) | self._by_field(args, env)
        if name == "QoS" and len(args) > 1:
            return self._with_queue(self.profiles.policies(args[1], env, level), self.queue(args, env, level))
        policies: Policies = {}
        for arg in args:
            word = policy_word(arg)
            policies |= {"history": word} if word.startswith("keep_") else self.profiles.policies(arg, env, level)
        return policies

    def _by_field(self, args: Sequence[Expr], env: Env) -> Policies:
        policies: Policies = {}
        for key, value in zip(_FIELDS, args, strict=False):
            policies |= self.profiles.assigned(key, value, env)
        return policies

    def _with_queue(self, profile: Policies, queue: Policies) -> Policies:
        """A profile of rmw with a queue of its own: `QoS(KeepLast(1), rmw_qos_profile_sensor_data)`."""
        rest = {key: value for key, value in profile.items() if key not in queue}
        if queue.get("history") == "keep_all":
            rest.pop("depth", None)
        return rest | queue
