"""What is found of a type, and which kind of type an endpoint of a role has."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

from ecm_checker.contract import Role

ROLE_KIND: Final[Mapping[Role, str]] = MappingProxyType(
    {
        "publisher": "msg",
        "subscriber": "msg",
        "service_server": "srv",
        "service_client": "srv",
        "action_server": "action",
        "action_client": "action",
    }
)


class TypeFound(NamedTuple):
    """A type, and the template parameters in it that callers know."""

    name: str | None
    open: frozenset[str] = frozenset()


UNKNOWN_TYPE = TypeFound(None)
