"""Methods of nodes of Python that are called by the name of their class: `Node.create_publisher(self, String, "x")`."""

from __future__ import annotations

from ecm_parsers.source.expr import THIS, Call, Name, Text
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.index.module_kinds import is_node_base


def bound(call: Invocation) -> Invocation:
    """Return a call as one on the object that it is given first, where it names a class of a client library."""
    owner = call.path.rpartition(".")[0]
    if call.func.file.language != "python" or call.receiver is not None or not call.args or not is_node_base(owner):
        return call
    own = call.args[0] == THIS  # whatever its class has by that name
    receiver = Call(Name("super"), (Text(owner),), line=call.line) if own else call.args[0]
    return replace(call, path=call.last, receiver=receiver, args=call.args[1:])
