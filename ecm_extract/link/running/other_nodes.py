"""Objects that read the parameters of another node: what they name is none of their own node's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped_names

if TYPE_CHECKING:
    from ecm_extract.link.running.objects import Objects

_CLIENTS: Final = shipped_names("link/code/library_values.toml", "parameter_clients")


def asks_another_node(call: Invocation, env: Env, objects: Objects) -> bool:
    """Tell whether a call is on a client of the parameters of another node: `client->get_parameter<bool>("debug")`."""
    if call.receiver is None:
        return False
    written = objects.type_of(call.receiver, env)
    return bool(written) and last_name(plain(pointee(written))) in _CLIENTS
