"""Where the parameters of dynamic_reconfigure stand: beside the service of the server that gives them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from ecm_checker.contract import Interface
from ecm_checker.hub.local_name import LocalName, joined
from msgspec.structs import replace

from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.running.values import weaker

SERVICE: Final = "dynamic_reconfigure/srv/Reconfigure"
"""Type of the service by which a server is set (dynamic_reconfigure/server.h)."""
_LEAF: Final = "set_parameters"


class Placed(NamedTuple):
    """An interface, its name for any namespace and node, and of a server the class of its configuration, as written."""

    interface: Interface
    local: LocalName
    served: str = ""


def serving(servers: Sequence[Placed], config: str) -> Sequence[Placed]:
    """Return the servers of the class of a configuration; where none says so, those that may be."""
    own = [server for server in servers if last_name(plain(server.served)) == config]
    return own or [server for server in servers if not server.served] or servers


def beside(parameter: Interface, servers: Sequence[Placed]) -> Iterator[Placed]:
    """Yield a parameter of a `.cfg` in the namespace of the server of its unit; of several servers in that of each."""
    leaf = parameter.name.removeprefix("~")
    for server in servers:
        service = server.interface
        head, raw = service.name.removesuffix(_LEAF), service.raw_name.removesuffix(_LEAF)
        raw = "~" if raw == "~/" else raw  # a private parameter is written without the slash
        sure = weaker(parameter.confidence, service.confidence)
        sure = weaker(sure, "one_of") if len(servers) > 1 else sure
        placed = replace(parameter, name=f"{head}{leaf}", raw_name=f"{raw}{leaf}", confidence=sure)
        yield Placed(placed, _beside(server.local, leaf))
    if not servers:
        yield Placed(parameter, LocalName((parameter.name,)))


def _beside(service: LocalName, leaf: str) -> LocalName:
    """The name with another last part."""
    *head, last = service.parts or ("",)
    kept = last.removesuffix(_LEAF) if isinstance(last, str) else ""
    return LocalName(joined([*head, kept, leaf]), service.space)
