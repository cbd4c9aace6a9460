"""Node handles and sub-nodes: the namespace that a name is relative to."""

from __future__ import annotations

from typing import NamedTuple

from ecm_checker.match.generated import snake
from ecm_parsers.source.expr import Call, Expr, Member, Name, Text

from ecm_extract.link.calls import Invocation
from ecm_extract.link.carriers import carriers
from ecm_extract.link.env import Env, invocation_of
from ecm_extract.link.fold import Folder
from ecm_extract.link.spelling import last_name, plain, pointee
from ecm_extract.link.texts import is_text
from ecm_extract.link.values import Value, joined, literal

MAX_DEPTH = 12
_PRIVATE = frozenset({"getPrivateNodeHandle", "getMTPrivateNodeHandle"})
_PUBLIC = frozenset({"getNodeHandle", "getMTNodeHandle"})
_HANDLE_WORDS = frozenset({"nh", "n", "node", "handle"})
_NODES = frozenset({"Node", "LifecycleNode"})


class Handle(NamedTuple):
    """What a handle makes of names.

    Attributes:
        prefix: put before relative names; starts with `~` for a private handle, empty for the node itself.
        node: name of a node made on the spot, to which `~` then belongs; None for the module's own node.
    """

    prefix: Value
    node: Value | None = None


OWN = Handle(literal(""))


class Handles:
    """Evaluates receivers of endpoint calls."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, expr: Expr | None, env: Env, depth: int = 0) -> Handle:
        """Return the handle that an expression is; what is not known is the module's own node."""
        if expr is None or expr == Name("this") or depth > MAX_DEPTH:
            return OWN
        if isinstance(expr, Call):
            return self._call(invocation_of(expr, env), env, depth)
        if isinstance(expr, Name):
            bound = env.args.get(expr.id)
            if bound is not None:
                return self.of(bound.expr, bound.env, depth + 1)
            made = self._constructor_argument(expr.id, env, depth)
            if made is not None:
                return made
        if isinstance(expr, Name | Member):
            return self._variable(expr, env, depth)
        return OWN

    def _constructor_argument(self, name: str, env: Env, depth: int) -> Handle | None:
        if not env.func.is_constructor or env.made is None or env.func.cls is None:
            return None
        part = self.folder.objects.part(env.made, env.func.cls)
        bound = part.args.get(name) if part is not None else None
        return self.of(bound.expr, bound.env, depth + 1) if bound is not None else None

    def _variable(self, expr: Name | Member, env: Env, depth: int) -> Handle:
        for definition, inner in self.folder.assignments.definitions(expr, env):
            value, kind = definition.statement.value, definition.statement.kind
            if value is None or kind == "each":
                continue
            if kind == "init" and (not isinstance(value, Call) or value.callee == definition.statement.target):
                return self._member(expr, value, inner, depth)
            return self.of(value, inner, depth + 1)
        return self._undefined(expr, env, depth)

    def _undefined(self, expr: Name | Member, env: Env, depth: int) -> Handle:
        """A handle that a caller or a class outside the tree gives: by its default, else by how it is called."""
        if isinstance(expr, Name):
            for parameter in env.func.fact.params:
                if parameter.name == expr.id and parameter.default is not None:
                    return self.of(parameter.default, Env(env.func, 0), depth + 1)
        name = expr.id if isinstance(expr, Name) else expr.name
        return Handle(literal("~")) if env.func.file.ros == 1 and _says_private(name) else OWN

    def _member(self, expr: Name | Member, value: Expr, env: Env, depth: int) -> Handle:
        """`nh_("~x")` and `nh_(parent)` in an initialiser list carry one argument without a constructor call.

        `loader_(parent, "name")` is written as a call of the member.
        """
        name = expr.id if isinstance(expr, Name) else expr.name
        written = self.folder.scope.member_type(name, env.this or env.func.cls)
        if isinstance(value, Call) and last_name(plain(pointee(written))) in carriers() and value.args:
            return self.of(value.args[0], env, depth + 1)
        if "NodeHandle" in written and is_text(value, env.func):
            return Handle(self.folder.fold(value, env)[0])
        return self.of(value, env, depth + 1)

    def _call(self, call: Invocation, env: Env, depth: int) -> Handle:
        last = call.last
        if last in _PRIVATE:
            return Handle(literal("~"))
        if last in _PUBLIC:
            return OWN
        if last == "NodeHandle" or _is_handle(call, self.folder, env):
            return self._node_handle(call, env, depth)
        if last == "create_sub_node" and call.args:
            return self._nested(self.of(call.receiver, env, depth + 1), call.args[0], env)
        if last in _NODES and call.args and not isinstance(call.args[0], Name):
            return self._new_node(call, env)
        if last in _NODES and len(call.args) >= 2:
            return self._new_node(call, env)
        if last in carriers() and call.args:
            return self.of(call.args[0], env, depth + 1)
        if last in {"dynamic_pointer_cast", "static_pointer_cast", "lock", "get", "shared_from_this"}:
            return self.of(call.args[0] if call.args else call.receiver, env, depth + 1)
        return OWN

    def _node_handle(self, call: Invocation, env: Env, depth: int) -> Handle:
        if not call.args:
            return OWN
        first = call.args[0]
        if isinstance(first, Text):
            return Handle(literal(first.value))
        parent = self.of(first, env, depth + 1)
        if len(call.args) >= 2:
            return self._nested(parent, call.args[1], env)
        if parent is OWN and self._stringy(first, env):
            return Handle(self.folder.fold(first, env)[0])
        return parent

    def _stringy(self, expr: Expr, env: Env) -> bool:
        return not isinstance(expr, Name | Member) or "string" in self.folder.objects.type_of(expr, env)

    def _nested(self, parent: Handle, name: Expr, env: Env) -> Handle:
        value = self.folder.fold(name, env)[0]
        return Handle(under(parent.prefix, value), parent.node)

    def _new_node(self, call: Invocation, env: Env) -> Handle:
        name = self.folder.fold(call.args[0], env)[0]
        if len(call.args) >= 2 and self._is_namespace(call.args[1], env):
            name = under(self.folder.fold(call.args[1], env)[0], name)
        return Handle(literal(""), name)

    def _is_namespace(self, expr: Expr, env: Env) -> bool:
        if isinstance(expr, Text):
            return True
        if isinstance(expr, Call):
            return invocation_of(expr, env).last in {
                "get_fully_qualified_name",
                "get_namespace",
                "get_effective_namespace",
            }
        written = self.folder.objects.type_of(expr, env)
        return "string" in written or (isinstance(expr, Name) and "ns" in expr.id.split("_"))


def under(prefix: Value, name: Value) -> Value:
    """Return `prefix/name`; an empty prefix changes nothing, an absolute name drops the prefix."""
    if not prefix.parts or prefix.text == "" or name.text.startswith("/"):
        return name
    if prefix.text == "~":
        return joined([(prefix,), (name,)])[0]
    return joined([(prefix,), (literal("/"),), (name,)])[0]


def _says_private(name: str) -> bool:
    """`pnh_`, `private_nh`, `nh_private_`, `privateNodeHandle`."""
    words = set(snake(last_name(name)).split("_"))
    return bool(words & {"pnh", "nhp"}) or (bool(words & {"private", "priv"}) and bool(words & _HANDLE_WORDS))


def _is_handle(call: Invocation, folder: Folder, env: Env) -> bool:
    if call.statement.kind == "let" and call.statement.type:
        return last_name(plain(pointee(call.statement.type))) in {"NodeHandle", "NodeHandlePtr"} and call.made
    return False
