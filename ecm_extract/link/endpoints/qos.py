"""QoS of an endpoint from the expression that gives it: presets, chains of setters, keywords, variables.

Policies that source does not set keep the default of rclcpp and rclpy (reliable, volatile, keep last 10) and are
named in `Qos.defaulted`. What source sets to a value that the tree does not show is `unknown`, a depth None.
"""

from __future__ import annotations

from typing import Any

from ecm_checker.contract import Qos
from ecm_parsers.numbers import real, truncated
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Member, Name, Number, Op

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.endpoints.qos_changed import ChangedProfiles
from ecm_extract.link.endpoints.qos_made import PROFILE, QUEUE, QUEUE_OF, QosMade
from ecm_extract.link.endpoints.qos_own import OwnProfiles
from ecm_extract.link.endpoints.qos_picked import PRESETS, PickedProfiles
from ecm_extract.link.endpoints.qos_presets import DEFAULT, UNSEEN, agreed, preset_of, presets
from ecm_extract.link.endpoints.qos_values import BY_KEY, milliseconds, policy_of_number
from ecm_extract.link.endpoints.qos_variables import QosVariables
from ecm_extract.link.endpoints.qos_words import QosWords
from ecm_extract.link.folding.data import declared_type, plain_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.folding.fold_names import is_lacking
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.resolve.cpp_constants import Stated

_FLAGS: dict[str, tuple[str, str]] = {
    "reliable": ("reliability", "reliable"),
    "best_effort": ("reliability", "best_effort"),
    "reliability_best_available": ("reliability", "best_available"),
    "transient_local": ("durability", "transient_local"),
    "durability_volatile": ("durability", "volatile"),
    "volatile": ("durability", "volatile"),
    "durability_best_available": ("durability", "best_available"),
    "keep_all": ("history", "keep_all"),
}
_POLICIES = ("reliability", "durability", "history", "liveliness")
_TIMES = {"deadline": "deadline_ms", "lifespan": "lifespan_ms", "liveliness_lease_duration": "lease_ms"}
_WRAPPERS = frozenset({"QoS", "QoSProfile", "QoSInitialization", QUEUE_OF, "KeepLast", "KeepAll", "shared_ptr"}) | {
    PROFILE,
    "copy.copy",
    "copy.deepcopy",
}
_BASIC = ("reliability", "durability", *QUEUE)
_SETTERS = frozenset({*_FLAGS, *_POLICIES, *_TIMES, "keep_last", "avoid_ros_namespace_conventions"}) | {
    "get_rmw_qos_profile",
    "value",
    "get",
}
MAX_DEPTH = 12
"""Nesting of evaluations."""
_LATCHED = "transient_local"
_WITHOUT_DEPTH = frozenset({"keep_all", "system_default", "unknown"})


class QosReader:
    """Evaluates QoS expressions."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.variables = QosVariables(folder, self)
        self.changed = ChangedProfiles(folder)
        self.picked = PickedProfiles(folder)
        self.made = QosMade(folder, self)
        self.words = QosWords(folder, self.picked)
        self.own = OwnProfiles(folder, self.variables, self.made)

    def read(self, expr: Expr | None, env: Env) -> Qos:
        """Return the profile of a ROS 2 endpoint; without an expression the default one."""
        policies = self.policies(expr, env, 0) if expr is not None else {}
        known = policies or {}
        default = presets()[DEFAULT][1]
        filled = {key: known.get(key, default[key]) for key in _BASIC}
        if filled["history"] in _WITHOUT_DEPTH and "depth" not in known:
            filled["depth"] = None
        missing = tuple(key for key in _BASIC if key not in known)
        rest = {key: value for key, value in known.items() if key not in _BASIC}
        return Qos(**filled, **rest, defaulted=missing)

    def depth(self, expr: Expr | None, latch: Expr | None, env: Env, implied: Name | None = None) -> Qos | None:
        """Return the profile of a ROS 1 endpoint: its queue size and, of a publisher, whether it is latched.

        `implied` is the preset of a library that makes it, whose queue size counts where none is given.

        A latched publisher gives its last message to whoever comes later, as one that is transient local does.
        """
        preset = self.read(implied, env) if implied is not None else Qos()
        number = self.number(expr, env) if expr is not None else preset.depth
        kept = preset.durability if preset.durability == _LATCHED else None
        durability = self._latched(latch, env) if latch is not None else kept
        return Qos(depth=number, durability=durability) if number is not None or durability is not None else None

    def _latched(self, expr: Expr, env: Env) -> str | None:
        words = {value.text.lower() if value.confidence != "pattern" else "" for value in self.folder.fold(expr, env)}
        if words <= {"false", "0"}:
            return None
        return _LATCHED if words <= {"true", "1"} else "unknown"

    def policies(self, expr: Expr, env: Env, level: int) -> dict[str, Any]:
        """Return what an expression sets; `level` is the nesting of evaluations."""
        if level > MAX_DEPTH or not self.folder.steps.take(env):
            return {**UNSEEN}
        with self.folder.steps:
            return self._of_kind(expr, env, level)

    def _of_kind(self, expr: Expr, env: Env, level: int) -> dict[str, Any]:
        if isinstance(expr, Number):
            return {"history": "keep_last", "depth": truncated(expr.value)}
        listed = self.picked.element(expr, env)
        if listed is not None:
            changed = self.changed.by_other_name(expr, env)
            return {**UNSEEN} if changed else self.policies(listed.expr, listed.env.deeper(env.depth + 1), level + 1)
        if isinstance(expr, Call):
            return self._call(expr, env, level)
        preset = self._preset(expr, env, level)
        if preset is not None:
            return preset
        if isinstance(expr, Name | Member):
            return self._variable(expr, env, level)
        if isinstance(expr, Op) and expr.op == "?:":
            return agreed([self.policies(branch, env, level + 1) for branch in self.picked.likely_side(expr, env)])
        if isinstance(expr, Op) and expr.op == "||":
            return self._first(expr, env, level)
        if isinstance(expr, Items) and expr.items:
            return self.made.of_items(expr.items, env, level + 1)
        return {} if isinstance(expr, Items | Lambda | Constant) else self._unseen(expr, env)

    def _first(self, expr: Op, env: Env, level: int) -> dict[str, Any]:
        """`given or QoSProfile(depth=1)`: the first that is anything, each that may be the first."""
        found: list[dict[str, Any]] = []
        for operand in expr.operands:
            holds = self.folder.flow.truth(operand, env)
            if holds is not False:
                found.append(self.policies(operand, env, level + 1))
            if holds:
                break
        return agreed(found)

    def _unseen(self, expr: Expr, env: Env) -> dict[str, Any]:
        """A depth where the value is a number, else a profile of which nothing is known."""
        depth = self._depth_alone(expr, env)
        return {**UNSEEN} if depth is None else depth

    def _depth_alone(self, expr: Expr, env: Env) -> dict[str, Any] | None:
        """What a number says, or a variable of which only is known that it is one; None of everything else."""
        returned = _returned(expr) if isinstance(expr, Call) else ""
        kind = plain_type(returned or self.folder.objects.type_of(expr, env))
        written = declared_type(kind)
        if kind not in {"", "auto"} and written is None:
            return None  # an object that is made of a number
        number = self.number(expr, env) if len(self.folder.fold(expr, env)) == 1 else None
        if number is not None:
            return {"history": "keep_last", "depth": number}
        return {"history": "keep_last", "depth": None} if written == "integer" else None

    def _preset(self, expr: Expr, env: Env, level: int) -> dict[str, Any] | None:
        """A profile of a client library by its name; None for what the tree gives the same name."""
        if isinstance(expr, Member) and expr.name == "value":  # `QoSPresetProfiles.SENSOR_DATA.value`
            expr = expr.base
        written = self.picked.enumerator(expr, env) or dotted_name(expr)
        found = presets().get(self._spelled(written, env)) if written else None
        if found is None or self._is_of_tree(written, env):
            return None
        is_own = isinstance(expr, Name) and self.variables.at(expr, env, level) is not None
        return {**found[1], "profile": found[0]} if not is_own else None

    def _is_of_tree(self, written: str, env: Env) -> bool:
        stated = self.folder.scope.constant(written, env)
        return stated is not None and not is_lacking(Stated(stated[1], stated[0]), written, env.func.file)

    def _spelled(self, written: str, env: Env) -> str:
        """The last part of a name, with the enumeration before it: of Python as the library calls it, not an alias."""
        if env.func.file.language != "python":
            return last_name(written)
        *around, name = (self.folder.program.outside(written, env.func.file) or written).split(".")
        return f"{around[-1]}.{name}" if around and name.isupper() else name

    def _call(self, expr: Call, env: Env, level: int) -> dict[str, Any]:
        callee = expr.callee
        if isinstance(callee, Member) and not (dotted_name(callee) and env.func.file.language == "python"):
            return self._method(callee, expr, env, level)
        name = last_name(dotted_name(callee) or (callee.id if isinstance(callee, Name) else ""))
        own = self.own.of_call(expr, env, level)
        if own is not None:
            return own
        if name == BY_KEY and expr.args:
            named = presets().get(f"{PRESETS}.{self.folder.fold(expr.args[0], env)[0].text.upper()}")
            return {**named[1], "profile": named[0]} if named is not None else {**UNSEEN}
        found = presets().get(name)
        if found is not None:
            return {**found[1], **self.made.queue(expr.args, env, level + 1), "profile": found[0]}
        if self.made.is_member(callee, env):
            return self.made.of_items(expr.args, env, level + 1)
        if name in _WRAPPERS or name.endswith("QoS") or self._path(expr, env) in _WRAPPERS:
            return self.made.of_call(name, expr, env, level + 1)
        return self._function(expr, env, level)

    def _path(self, call: Call, env: Env) -> str:
        """What a function of Python is called in the module that has it."""
        return self.folder.program.canonical(dotted_name(call.callee), env.func.file)

    def _method(self, callee: Member, expr: Call, env: Env, level: int) -> dict[str, Any]:
        """A setter on a profile, or a method that returns a profile or a number."""
        if callee.name in _SETTERS:
            return {**self.policies(callee.base, env, level + 1), **self.set_by(expr, env)}
        return self._function(expr, env, level)

    def set_by(self, expr: Call, env: Env) -> dict[str, Any]:
        """Return what one setter sets."""
        callee = expr.callee
        name = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
        if name == "keep_last" and expr.args:
            return {"history": "keep_last", "depth": self.number(expr.args[0], env)}
        if name in _FLAGS:
            key, value = _FLAGS[name]
            return {key: value}
        return self.assigned(name, expr.args[0], env) if expr.args else {}

    def assigned(self, key: str, value: Expr, env: Env) -> dict[str, Any]:
        """Return what the assignment of a field sets."""
        copied = self.made.field(key, value, env)
        if copied:
            return copied
        if key == "depth":
            return {"depth": self.number(value, env)}
        if key in _POLICIES:
            words = {policy_of_number(key, value)} if isinstance(value, Number) else self.words.of(value, env)
            return {key: words.pop() if len(words) == 1 else "unknown"}
        if key in _TIMES:
            duration = milliseconds(value)
            return {_TIMES[key]: duration} if duration is not None else {}
        return {}

    def _variable(self, expr: Name | Member, env: Env, level: int) -> dict[str, Any]:
        stated = self.folder.module_objects.each(expr, env) if isinstance(expr, Member) else []
        if len(stated) == 1:
            return self.policies(stated[0].expr, stated[0].env.deeper(env.depth + 1), level + 1)
        name = expr.id if isinstance(expr, Name) else expr.name
        read = self.folder.properties.read(expr, env)
        found = self._function(read, env, level) if read is not None else self.variables.at(expr, env, level)
        if found is not None:
            return (self._depth_alone(expr, env) if found == UNSEEN else None) or found
        around = self.variables.of_function_around(expr, env)
        if around is None and self.variables.is_own(expr, env):
            return self._unseen(expr, env)
        return self.policies(expr, around, level + 1) if around is not None else self._constant(expr, name, env, level)

    def _constant(self, expr: Name | Member, name: str, env: Env, level: int) -> dict[str, Any]:
        constant = self.folder.scope.constant(dotted_name(expr).removesuffix(".value") or name, env)
        begun = preset_of(constant[0].type) if constant is not None else {}
        if constant is None or constant[0].value is None:
            return begun or self._unseen(expr, env)
        if self.changed.elsewhere(expr, *constant, env):
            return {**UNSEEN}
        scope, own = last_name(constant[0].scope), constant[0].name
        whole = Member(Name(scope), own) if scope else Name(own)
        left = self.variables.left_by_module(whole, constant[1], env, level)
        place = self.folder.names.stated_at(*constant, env)
        return left or begun | self.policies(constant[0].value, place, level + 1)

    def _function(self, expr: Call, env: Env, level: int) -> dict[str, Any]:
        """What a function of the tree gives back: at each return that is reached as long as nobody sets a parameter."""
        call = invocation_of(expr, env)
        meant = self.folder.returns.meant(call, env)
        callees = [meant] if meant is not None else self.folder.objects.callees(call, env)
        if not callees:
            return self._unseen(expr, env)
        if any(self.folder.redefined.may_be(callee, call, env) for callee in callees):
            return {**UNSEEN}
        found = [
            preset_of(callee.fact.returns) | self.policies(value, place, level + 1)
            for callee in callees
            for value, place in self.folder.returns.expected(callee, call, env)
        ]
        return agreed(found) if found else {**UNSEEN}

    def number(self, expr: Expr, env: Env) -> int | None:
        """Return the whole number that an expression is; of several nobody knows which it is."""
        numbers = {real(value.text) for value in self.folder.fold(expr, env)}
        number = numbers.pop() if len(numbers) == 1 else None
        return truncated(number) if number is not None else None


def _returned(call: Call) -> str:
    """The type that a call writes: `declare_parameter<int>("depth")`, `size_t(depth)`."""
    return call.types[0] if call.types else call.callee.id if isinstance(call.callee, Name) else ""
