"""The policies of QoS that an expression can be: names of enumerations, and whatever holds, has or gives one."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

from ecm_parsers.source.expr import Call, Expr, Member, Name, Number, Op

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.endpoints.qos_picked import PickedProfiles
from ecm_extract.link.endpoints.qos_values import policy_asked, policy_called, policy_word
from ecm_extract.link.endpoints.qos_variables import QosVariables
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Bound, Env, invocation_of

MAX_DEPTH = 12
"""Nesting of evaluations."""
_UNKNOWN = "unknown"
_WORD = "word"
"""The key of the one policy that a variable holds, where a profile has a key for each."""


class QosWords:
    """Tells which policies a value can be."""

    def __init__(self, folder: Folder, picked: PickedProfiles) -> None:
        self.folder = folder
        self.picked = picked
        self.variables = QosVariables(folder, self)

    def of(self, value: Expr, env: Env, level: int = 0) -> set[str]:
        """Return the policies that a value can be, `unknown` among them for what the tree does not show."""
        word = policy_word(value) if not self._is_of_tree(value, env) else ""
        if word or level > MAX_DEPTH or not self.folder.steps.take(env):
            return {word or _UNKNOWN}
        with self.folder.steps:
            return self._of_kind(value, env, level + 1) or {_UNKNOWN}

    def policies(self, expr: Expr, env: Env, level: int) -> dict[str, Any]:
        """Return the one policy that a value is, as what a variable of it holds."""
        words = self.of(expr, env, level)
        return {_WORD: words.pop() if len(words) == 1 else _UNKNOWN}

    def chain(self, expr: Expr, env: Env) -> dict[str, Any]:
        """Return nothing: no method changes a policy."""
        return {}

    def set_by(self, expr: Call, env: Env) -> dict[str, Any]:
        """Return nothing: no method changes a policy."""
        return {}

    def assigned(self, key: str, value: Expr, env: Env) -> dict[str, Any]:
        """Return nothing: a policy has no fields."""
        return {}

    def _of_kind(self, value: Expr, env: Env, level: int) -> set[str]:
        if isinstance(value, Op) and value.op == "?:":
            return {word for branch in self.picked.likely_side(value, env) for word in self.of(branch, env, level)}
        asked = policy_asked(value)
        if asked is not None:
            return {policy_called(each.text) or _UNKNOWN for each in self.folder.fold(asked, env)}
        bound = self._bound(value, env)
        if bound is not None:
            return self.of(bound.expr, bound.env, level)
        if isinstance(value, Call):
            return self._returned(value, env, level)
        return self._variable(value, env, level) if isinstance(value, Name | Member) else set()

    def _variable(self, value: Name | Member, env: Env, level: int) -> set[str]:
        if self._may_change(value, env):
            return set()
        found = self.variables.at(value, env, level)
        if found is not None:
            return {found.get(_WORD) or _UNKNOWN}
        around = self.variables.of_function_around(value, env)
        return self.of(value, around, level) if around is not None else self._of_constant(value, env, level)

    def _is_of_tree(self, value: Expr, env: Env) -> bool:
        """Whether a name is a variable of the tree, which holds any policy whatever it is called."""
        root = self.folder.flow.effects(env.func).root(value) if isinstance(value, Member) else ""
        if self._is_own(value, env) or root.startswith(".") or root.partition(".")[0] in self._own(env):
            return True
        stated = self.folder.scope.constant(dotted_name(value), env) if isinstance(value, Name | Member) else None
        return stated is not None and not isinstance(stated[0].value, Number | None)  # else the library's enumeration

    def _is_own(self, value: Expr, env: Env) -> bool:
        return isinstance(value, Name) and value.id in self._own(env)

    def _own(self, env: Env) -> Set[str]:
        """The variables of the function at hand."""
        return self.folder.flow.effects(env.func).own

    def _of_constant(self, value: Name | Member, env: Env, level: int) -> set[str]:
        """What a module, a class or a namespace gives a variable that nobody changes."""
        if self._is_own(value, env):
            return set()
        name, names = dotted_name(value), self.folder.names
        if env.func.file.language == "python":
            place, ways = names.left_by_module(name, env)
            return {word for way in ways for held in way for word in self._held(held, place or env, level)}
        stated = self.folder.scope.constant(name, env)
        if stated is None or stated[0].value is None:
            return set()
        return self.of(stated[0].value, names.stated_at(*stated, env), level)

    def _may_change(self, value: Expr, env: Env) -> bool:
        """Whether functions of C++ assign to a variable of a namespace."""
        if not isinstance(value, Name) or env.func.file.language != "cpp" or self._is_own(value, env):
            return False
        stated = self.folder.scope.constant(value.id, env)
        return stated is not None and self.folder.names.may_change(value.id, stated[0], env)

    def _bound(self, value: Expr, env: Env) -> Bound | None:
        """What stands for it: an element of a list or a table, or the argument of a parameter that is left alone."""
        if isinstance(value, Name):
            return env.args.get(value.id) if value.id not in self.folder.flow.outline(env.func).changes else None
        tables = self.folder.tables
        element = tables.element(value, env, likely=True) if isinstance(value, Call | Op) else None
        if element is not None or not isinstance(value, Call):
            return element
        callee = value.callee
        is_get = isinstance(callee, Member) and callee.name == "get" and bool(value.args)
        return tables.element_or(callee.base, value.args, env) if isinstance(callee, Member) and is_get else None

    def _held(self, held: Held, env: Env, level: int) -> set[str]:
        if held.how != "value" or held.expr is None:
            return {_UNKNOWN}
        return self.of(held.expr, held.env or env, level)

    def _returned(self, value: Call, env: Env, level: int) -> set[str]:
        """What a function of the tree gives back, which nothing may stand in for."""
        call = invocation_of(value, env)
        meant = self.folder.returns.meant(call, env)
        if meant is None or self.folder.redefined.may_be(meant, call, env):
            return {_UNKNOWN}
        found = self.folder.returns.expected(meant, call, env)
        return {word for given, place in found for word in self.of(given, place, level)}
