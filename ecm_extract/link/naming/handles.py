"""Node handles and sub-nodes: the namespace that a name is relative to."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Op

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import by_value, is_pointer, last_name, plain, pointee
from ecm_extract.link.code.texts import is_text
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.naming.begun_handles import begun_handle
from ecm_extract.link.naming.carriers import carriers
from ecm_extract.link.naming.derived_handles import base_handles, derives_from_handle
from ecm_extract.link.naming.given_handles import given_namespace
from ecm_extract.link.naming.handle import OWN, Handle, agreed, of_any, under
from ecm_extract.link.naming.host_arguments import HostArguments
from ecm_extract.link.naming.new_nodes import NewNodes
from ecm_extract.link.naming.nodes_handed import NodesHanded
from ecm_extract.link.naming.sole_objects import SoleObjects
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, Instance, invocation_of
from ecm_extract.link.running.values import Value, is_known, literal, unknown

MAX_DEPTH = 12
_PRIVATE = frozenset({"getPrivateNodeHandle", "getMTPrivateNodeHandle"})
_PUBLIC = frozenset({"getNodeHandle", "getMTNodeHandle"})
_NODES = frozenset({"Node", "LifecycleNode"})
_CREATE: Final = "rclpy.create_node"
_SAME = frozenset(
    {"dynamic_pointer_cast", "static_pointer_cast", "lock", "get", "shared_from_this", "move", "ref", "cref"}
)
"""Calls that give the object they are given, or that they are called on."""
_TEXTS: Final = ("string", "char")

_REMAPPINGS: Final = frozenset({"M_string", "map"})


class Handles:
    """Evaluates receivers of endpoint calls. A handle that nothing in the tree makes is None within, and is told.

    Args:
        folder: gives values and types.
        hosts: tells what hosts in the tree give to plugins.
        sole: tells how objects are made of which there is one.
    """

    def __init__(self, folder: Folder, hosts: HostArguments, sole: SoleObjects) -> None:
        self.folder = folder
        self.hosts = hosts
        self.sole = sole
        self.new = NewNodes(folder)
        self._handing: set[tuple[Func, str]] = set()
        self._callers: NodesHanded | None = None

    def of(self, expr: Expr | None, env: Env, only: bool = False) -> Handle:
        """Return the handle that an expression is; where `only` handles are taken, a text makes one of its namespace.

        In ROS 1 one of which nothing is known has a namespace that is not known either; in ROS 2 a node is itself.
        """
        is_call = isinstance(expr, Call) and not self.folder.objects.type_of(expr, env)
        if only and expr is not None and not is_call and self._says_text(expr, env):
            return of_any(self.folder.fold(expr, env))
        known = self._known(expr, env, 0)
        if known is not None:
            return known
        return Handle(unknown(_label(expr))) if env.func.file.ros == 1 else OWN

    def within(self, callers: NodesHanded) -> Handles:
        """Return the same of one module: what parameters of its functions are, its own calls tell."""
        view = copy(self)
        view._callers = callers
        return view

    def prefix(self, expr: Expr, env: Env) -> Value | None:
        """Return what a handle puts before names; None of one that is not known."""
        known = self._known(expr, env, 0)
        return known.prefix if known is not None and known.node is None and not known.others else None

    def _known(self, expr: Expr | None, env: Env, depth: int) -> Handle | None:
        if expr is None or expr == THIS:
            return self._derived(env.this or env.func.cls, env.made, depth)
        if depth > MAX_DEPTH:
            return None
        if isinstance(expr, Call):
            known = self._call(invocation_of(expr, env), env, depth)
            return known or self._made(expr, env, depth) or self._of_other(expr, env)
        if isinstance(expr, Op) and expr.op in {"&", "?:", "[]"}:  # one of several elements nobody tells apart
            chosen = () if expr.op == "[]" else expr.operands[expr.op == "?:" :]
            return agreed([self._known(each, env, depth + 1) for each in chosen])
        if isinstance(expr, Name):
            return self._name(expr, env, depth)
        if isinstance(expr, Items) and env.func.file.language == "cpp":  # braces make the handle that is asked for
            return self._node_handle(expr.items, env, depth)
        return self._member(expr, env, depth) if isinstance(expr, Member) else OWN

    def _derived(self, cls: Cls | None, made: Instance | None, depth: int) -> Handle:
        """What an object is as a handle: that of the node, unless its class derives from one that is made otherwise."""
        if cls is None or not derives_from_handle(cls, self.folder.program):
            return OWN
        given = list(base_handles(cls, made, self.folder.objects))
        found = [self._node_handle(args, env, depth + 1) for args, env in given]
        return (agreed(found) or Handle(unknown("handle"))) if found else OWN

    def _made(self, expr: Call, env: Env, depth: int) -> Handle | None:
        """The node, or the handle, that an object of a class of the tree is which a call makes."""
        made = self.new.made(expr, env)
        if made is not None and derives_from_handle(made.cls, self.folder.program):
            return self._derived(made.cls, made, depth)
        return self.new.of_object(made) if made is not None else None

    def _of_other(self, expr: Call, env: Env) -> Handle | None:
        """What makes something else than a handle, as a duration that stands in its place, has no namespace."""
        written = self.folder.objects.type_of(expr, env)
        return OWN if written and plain(written) != "auto" and not self._is_handle(written, env) else None

    def _name(self, expr: Name, env: Env, depth: int) -> Handle | None:
        bound = env.args.get(expr.id) or self._given_to_constructor(expr.id, env)
        if bound is not None:
            return self._known(bound.expr, bound.env, depth + 1)
        place = self.folder.names.captured_at(expr.id, env)
        return self._name(expr, place, depth + 1) if place is not None else self._variable(expr, env, depth)

    def _given_to_constructor(self, name: str, env: Env) -> Bound | None:
        if not env.func.is_constructor or env.made is None or env.func.cls is None:
            return None
        part = self.folder.objects.part(env.made, env.func.cls)
        return part.args.get(name) if part is not None else None

    def _member(self, expr: Member, env: Env, depth: int) -> Handle | None:
        """A member of the object at hand, or of another one, as its class makes it."""
        if expr.base == THIS:
            return self._variable(expr, env, depth)
        made = self.folder.makers.of(expr.base, env)
        cls = made.cls if made is not None else self.folder.objects.class_of(expr.base, env)
        if cls is None:
            return self._declared(expr, env, depth)
        made = made or self.sole.of(cls)
        place = Env(env.func, env.at, this=cls, made=made, depth=env.depth + 1)
        return self._variable(Member(THIS, expr.name), place, depth)

    def _variable(self, expr: Name | Member, env: Env, depth: int) -> Handle | None:
        """What all that may have made a variable agree on, and else what it is as it is declared."""
        makers = self.folder.origins.makers(expr, env)
        if makers is None:
            return None
        if not makers:
            return self._declared(expr, env, depth)
        here = self._made_here(expr, env) or makers
        found = [self._given(expr, each, depth) for each in here]
        begun = self._begun(expr, env) if here is makers else None
        if begun is not None and not all(each.env.func.is_constructor for each in makers):
            found.append(self._known(begun, env, depth + 1))
        return agreed(found)

    def _made_here(self, expr: Name | Member, env: Env) -> list[Bound]:
        """What the function at hand itself has given a variable; nothing where it may be as others left it."""
        ways = [held for way in self.folder.flow.ways(expr, env) for held in way]
        made = [Bound(held.expr, held.env) for held in ways if held.how == "value" and held.expr and held.env]
        return made if len(made) == len(ways) else []

    def _begun(self, expr: Name | Member, env: Env) -> Expr | None:
        """What makes the handle that a member of the object at hand is declared with."""
        if not self.folder.flow.effects(env.func).key(expr).startswith("."):
            return None
        is_handle = self._is_handle(self.folder.objects.type_of(expr, env), env)
        return begun_handle(expr, env, self.folder.program) if is_handle else None

    def _given(self, expr: Name | Member, made: Bound, depth: int) -> Handle | None:
        """`nh_("~x")` and `nh_(parent, "x")` in an initialiser list make a handle without naming it."""
        value, env = made.expr, made.env
        written = self.folder.objects.type_of(expr, env)
        if last_name(plain(pointee(written))) in carriers() and isinstance(value, Call):
            return self._known(next(iter(_initialised_with(expr, value)), None), env, depth + 1)
        if by_value(written) and last_name(plain(written)) in _NODES and isinstance(value, Call) and value.args:
            return self.new.of_cpp(value.args, env)
        if not by_value(written) or last_name(plain(written)) != "NodeHandle":
            return self._known(value, env, depth + 1)
        return self._node_handle(_initialised_with(expr, value), env, depth)

    def _declared(self, expr: Name | Member, env: Env, depth: int) -> Handle | None:
        """A parameter is its default; a handle that is held and never made otherwise is the node's, as is no handle."""
        if isinstance(expr, Name):
            for parameter in env.func.fact.params:
                handed = self._by_callers(expr.id, env, depth) if parameter.name == expr.id else None
                if handed is not None:
                    return handed
                if parameter.name == expr.id and parameter.default is not None:
                    return self._known(parameter.default, Env(env.func, 0), depth + 1)
                if parameter.name == expr.id and self._is_handle(parameter.type, env):
                    return self._handed(expr.id, env)
        written = self.folder.objects.type_of(expr, env)
        cls = self._class_of(written, env) if by_value(written) else None
        if cls is not None:
            return self._derived(cls, None, depth)
        begun = self._begun(expr, env)
        if begun is not None:
            return self._known(begun, env, depth + 1)
        if not written or plain(written) == "auto":
            return None if not self._is_text(expr, env) else OWN
        return OWN if by_value(written) or not self._is_handle(written, env) else None

    def _by_callers(self, parameter: str, env: Env, depth: int) -> Handle | None:
        """Any of the nodes that the module hands a function of ROS 2; None where it hands none that is known."""
        if self._callers is None or env.func.file.ros != 2:
            return None
        return self._callers.of(
            env.func, parameter, env.this, lambda given: self._known(given.expr, given.env, depth + 1)
        )

    def _handed(self, parameter: str, env: Env) -> Handle | None:
        """What a library, or the hosts in the tree, give a method that they call without knowing its class."""
        func = env.func
        below = given_namespace(func, parameter, self.folder.program)
        if below is not None:
            return Handle(below)
        if (func, parameter) in self._handing:
            return None
        self._handing.add((func, parameter))
        try:
            return agreed([self._known(bound.expr, bound.env, 0) for bound in self.hosts.of(func, parameter, env.this)])
        finally:
            self._handing.discard((func, parameter))

    def _is_handle(self, written: str, env: Env) -> bool:
        bare = plain(pointee(written))
        meant = self.folder.program.alias(bare, env.func.file, env.scope) or bare
        named = last_name(plain(pointee(meant))).removesuffix("Ptr") in {"NodeHandle", *carriers()}
        return named or self._class_of(written, env) is not None

    def _class_of(self, written: str, env: Env) -> Cls | None:
        """The class of the tree that a type means, where its objects are handles."""
        cls = self.folder.program.class_named(plain(pointee(written)), env.func.file, env.scope) if written else None
        return cls if cls is not None and derives_from_handle(cls, self.folder.program) else None

    def _is_text(self, expr: Expr, env: Env) -> bool:
        return is_known(self.folder.fold(expr, env)[0])

    def _call(self, written: Invocation, place: Env, depth: int) -> Handle | None:
        call, env = self.folder.spreading.out(written, place)
        last = call.last
        if call.func.file.language == "python" and (last in _NODES or call.path == _CREATE) and call.receiver is None:
            return self.new.of_python(call, env)
        if last in _PRIVATE | _PUBLIC and self.folder.objects.callee(call, env) is None:
            return Handle(literal("~")) if last in _PRIVATE else OWN
        if last == "NodeHandle" or _makes_handle(call):
            return self._node_handle(call.args, env, depth)
        if last == "create_sub_node" and call.args:
            return self._nested(self._known(call.receiver, env, depth + 1) or OWN, call.args[0], env)
        if last in _NODES and call.args and (len(call.args) >= 2 or not isinstance(call.args[0], Name)):
            return self.new.of_cpp(call.args, env)
        if last in carriers() and call.args:
            return self._known(call.args[0], env, depth + 1)
        same = last in _SAME and self.folder.objects.callee(call, env) is None
        if same or (len(call.args) == 1 and _is_pointer(last)):
            return self._known(call.args[0] if call.args else call.receiver, env, depth + 1)
        return self._returned(call, env, depth)

    def _returned(self, call: Invocation, env: Env, depth: int) -> Handle | None:
        """What a function of the tree returns, where all its returns agree."""
        callee = self.folder.objects.callee(call, env)
        if callee is None:
            return None
        made = self.folder.makers.of(call.receiver, env) if call.receiver is not None else env.made
        known = self.folder.objects.class_of(call.receiver, env) if call.receiver is not None else env.this
        this, args = made.cls if made is not None else known or callee.cls, bind(callee, call, env)
        found = [
            self._known(statement.value, Env(callee, at, args, this=this, made=made, depth=env.depth + 1), depth + 1)
            for at, statement in enumerate(callee.fact.body)
            if statement.kind == "return"
        ]
        return agreed(found)

    def _node_handle(self, args: tuple[Expr, ...], env: Env, depth: int) -> Handle | None:
        if not args:
            return OWN
        first = args[0]
        if self._remaps(args[1:], env):
            return Handle(unknown("remapped"))
        if not isinstance(first, Name | Member | Call | Op) or self._says_text(first, env):
            return of_any(self.folder.fold(first, env))
        parent = self._known(first, env, depth + 1)
        if len(args) < 2:
            return parent
        return self._nested(parent or Handle(unknown(_label(first))), args[1], env)

    def _remaps(self, args: Sequence[Expr], env: Env) -> bool:
        """Tell whether a handle is given names that stand for others below it (ros/node_handle.h, `M_string`)."""
        given = [arg for arg in args if last_name(plain(self.folder.objects.type_of(arg, env))) in _REMAPPINGS]
        named = [arg for arg in given if not isinstance(arg, Call) or arg.args]
        return any(self.folder.tables.entries(arg, env) != [] for arg in named)

    def _says_text(self, expr: Expr, env: Env) -> bool:
        """Tell whether a handle is made of a namespace, and not of another handle."""
        if isinstance(expr, Op):
            return expr.op != "&"
        if is_text(expr, env.func):
            return True
        written = self.folder.objects.type_of(expr, env)
        is_named = bool(written) and plain(written) != "auto"
        return any(word in written for word in _TEXTS) if is_named else self._is_text(expr, env)

    def _nested(self, parent: Handle, name: Expr, env: Env) -> Handle:
        names = self.folder.fold(name, env)
        return of_any([under(one.prefix, each) for one in parent.each() for each in names], parent.node)


def _initialised_with(expr: Name | Member, value: Expr) -> tuple[Expr, ...]:
    """What stands in the parentheses of a member of an initialiser list, which are written as a call of it."""
    own = Name(expr.id if isinstance(expr, Name) else expr.name)
    return value.args if isinstance(value, Call) and value.callee == own else (value,)


def _makes_handle(call: Invocation) -> bool:
    """Tell whether a declaration makes a handle: `ros::NodeHandle nh(...)`."""
    written = call.statement.type if call.statement.kind == "let" else ""
    return call.made and last_name(plain(pointee(written))) in {"NodeHandle", "NodeHandlePtr"}


def _is_pointer(last: str) -> bool:
    """Tell whether a class makes pointers to handles: `shared_ptr<ros::NodeHandle>(new ...)`, `NodeHandlePtr(...)`."""
    return is_pointer(last) or last in {f"{name}Ptr" for name in ("NodeHandle", *carriers())}


def _label(expr: Expr | None) -> str:
    """What a handle is called in source, to say which one is not known."""
    if isinstance(expr, Op) and expr.operands:
        return _label(expr.operands[0])
    if isinstance(expr, Call):
        return _label(expr.callee)
    return expr.id if isinstance(expr, Name) else expr.name if isinstance(expr, Member) else "handle"
