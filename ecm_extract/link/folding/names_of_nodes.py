"""What nodes say of themselves: `get_name()`, `get_namespace()`, and what ROS 1 has instead.

Sources: rclcpp/node.hpp, rclpy/node.py, ros/this_node.h, ros/node_handle.h, rospy/names.py, nodelet/nodelet.h.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.naming_calls import searches
from ecm_extract.link.code.spelling import is_node_interface, plain, pointee
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.library_functions import library_function
from ecm_extract.link.index.module_kinds import class_kind, is_node_base
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.object_states import is_own
from ecm_extract.link.running.own_names import node_name, node_namespace
from ecm_extract.link.running.values import Value, joined, literal, lowered

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_NAMES: Final = frozenset({"ros::this_node::getName", "rospy.get_name"})
_NAMESPACES: Final = frozenset({"ros::this_node::getNamespace"})
_CLOSED_NAMESPACES: Final = frozenset({"rospy.get_namespace"})
"""What ends them with a slash (rosgraph/names.py)."""
_OWN_NAMES: Final = frozenset({"get_name", "get_fully_qualified_name"})
_WITH_SUB_NODES: Final = "get_effective_namespace"
_OF_NODELETS: Final = "getName"
_NAMESPACE_OF_HANDLE: Final = "getNamespace"
_RESOLVED_BY_HANDLE: Final = "resolveName"


def resolved(call: Invocation, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return a name as it is passed; `nh.resolveName(name)` gives it below the handle, whatever other one gets it."""
    values = folder.fold(call.args[0], env)
    if searches(call.path):
        return lowered(values, "default")
    of_handle = call.receiver is not None and call.last == _RESOLVED_BY_HANDLE
    space = namespace_of(call.receiver, env, folder) if of_handle and call.receiver is not None else None
    if space is None or any(value.text.startswith(("/", "~")) for value in values):
        return values
    return joined([(space,), (literal("/"),), values])


def told_by_node(call: Invocation, env: Env, folder: Folder) -> Value | None:
    """Return what a call of no function of the tree gives that a node answers; None where no node does."""
    named = library_function(call, _NAMES | _NAMESPACES | _CLOSED_NAMESPACES, env.scope, folder.program)
    if named in _NAMES or (call.last in _OWN_NAMES and _may_be_node(call.receiver, env, folder)):
        return node_name()
    if named in _CLOSED_NAMESPACES:
        return joined([(node_namespace(),), (literal("/"),)])[0]
    if named in _NAMESPACES or (call.last == "get_namespace" and _may_be_node(call.receiver, env, folder)):
        return node_namespace()
    if call.last == _WITH_SUB_NODES and _may_be_node(call.receiver, env, folder):
        return _effective_namespace(call.receiver, env, folder)
    if call.last == _NAMESPACE_OF_HANDLE and call.receiver is not None:
        return namespace_of(call.receiver, env, folder)
    own = env.this or env.func.cls
    is_nodelet = own is not None and is_own(call.receiver) and class_kind(own, folder.program) == "nodelet"
    return node_name() if call.last == _OF_NODELETS and is_nodelet else None


def _effective_namespace(node: Expr | None, env: Env, folder: Folder) -> Value | None:
    """The namespace of a node and below it that of the sub node which it is asked of."""
    below = literal("") if node is None or is_own(node) else folder.prefixes(node, env)
    if below is None or not any(below.parts):
        return below and node_namespace()
    return joined([(node_namespace(),), (literal("/"),), (below,)])[0]


def namespace_of(handle: Expr, env: Env, folder: Folder) -> Value | None:
    """Return the namespace of a handle of roscpp, with what it puts before names: of a private one the node's name."""
    prefix = folder.prefixes(handle, env)
    if prefix is None or prefix.text.startswith("/"):
        return prefix
    begins = node_name() if prefix.text.startswith("~") else node_namespace()
    first, *rest = [part for part in prefix.parts if part] or [""]
    below = (first.removeprefix("~").lstrip("/") if isinstance(first, str) else first, *rest)
    return joined([(begins,), (literal("/"),), (Value(below, prefix.confidence),)])[0] if any(below) else begins


def _may_be_node(receiver: Expr | None, env: Env, folder: Folder) -> bool:
    """Whether an object is a node, or nothing shows what it is: parameters, joints and plugins have names too."""
    if is_own(receiver) or receiver is None:
        own = env.this or env.func.cls
        return own is None or _derives(own, folder)
    cls = folder.objects.class_of(receiver, env)
    if cls is not None:
        return _derives(cls, folder)
    written = folder.objects.type_of(receiver, env)
    bare = plain(pointee(written))
    is_open = env.func.file.language == "python" or bare in {"", "auto", *env.func.fact.template}
    return is_open or is_node_base(bare) or is_node_interface(written)


def _derives(cls: Cls, folder: Folder) -> bool:
    """Whether a class is a node, or may be one by a base that is not of the tree and of no other kind."""
    module_kind = class_kind(cls, folder.program)
    known = {entry.fact.name for entry in folder.program.ancestry(cls)}
    others = (plain(name).rpartition("::")[2].rpartition(".")[2] for name in folder.program.base_names(cls))
    return module_kind == "node" or (module_kind is None and any(name not in known for name in others))
