"""Calls of rclcpp that get interfaces of a node where others get the node: both are read with one node in front.

Source: rclcpp/create_client.hpp (base, graph, services), create_service.hpp (base, services), create_publisher.hpp and
create_subscription.hpp (parameters, topics), rclcpp_action/create_client.hpp and create_server.hpp (four of them). How
the interfaces are written says nothing: the name is the first text behind at most so many as the row has.
"""

from __future__ import annotations

from ecm_parsers.source.expr import Expr, Number, Text
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation, node_of
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.spelling import is_node_interface
from ecm_extract.link.declaring.forms import Form
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env


def with_one_node(call: Invocation, form: Form, env: Env, folder: Folder) -> Invocation:
    """Return a call as its row reads it: interfaces of a node as the node that they stand for."""
    if not form.interfaces or len(call.args) < 2:
        return call
    candidates = range(1, min(form.interfaces + 1, len(call.args)))
    at = next((each for each in candidates if _is_text(call.args[each], env, folder)), None)
    if at is None:
        at = _by_types(call, form, env, folder)
    return call if at < 2 else replace(call, args=(node_of(call.args[:at]), *call.args[at:]))


def _is_text(arg: Expr, env: Env, folder: Folder) -> bool:
    """Whether an argument is a text, by its type or by what it gives; nothing else of these calls is one."""
    if isinstance(arg, Text | Number):
        return isinstance(arg, Text)
    written = folder.objects.type_of(arg, env)
    if written and "auto" not in written:
        return kind_of_type(written) == "text"
    values = folder.fold(arg, env)
    return all(value.data is None and any(isinstance(part, str) for part in value.parts) for value in values)


def _by_types(call: Invocation, form: Form, env: Env, folder: Folder) -> int:
    """Where the name stands as far as types tell: behind all interfaces of the row where any of them is one by type."""
    first = call.args[: form.interfaces]
    known = any(is_node_interface(folder.objects.type_of(arg, env)) for arg in first)
    return form.interfaces if known and len(call.args) > form.interfaces else 1
