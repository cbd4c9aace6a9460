"""ROS 2 names and types behind those of DDS. Source: ROS 2 design, "Topic and Service name mapping to DDS"."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

NODE_NAMES: Final = "ros_discovery_info"
_TYPE: Final = re.compile(r"([A-Za-z]\w*)::(msg|srv|action)::dds_::(\w+)_")
_PART: Final = re.compile(r"_(?:Request|Response)$")


class Meaning(NamedTuple):
    """What an endpoint of DDS is to ROS; the reply of a service has no role, as its request tells all."""

    role: str | None
    name: str


class _Prefix(NamedTuple):
    suffix: str
    writer: str | None
    reader: str | None


_PREFIXES: Final[Mapping[str, _Prefix]] = MappingProxyType(
    {
        "rt": _Prefix("", "publisher", "subscriber"),
        "rq": _Prefix("Request", "service_client", "service_server"),
        "rr": _Prefix("Reply", None, None),
    }
)


def meaning(topic: str, writes: bool) -> Meaning | None:
    """What an endpoint of a topic is to ROS; None when the topic is none of ROS 2."""
    prefix, _, rest = topic.partition("/")
    row = _PREFIXES.get(prefix)
    if row is None or not rest:
        return None
    return Meaning(row.writer if writes else row.reader, f"/{rest.removesuffix(row.suffix)}")


def ros_type(name: str) -> str | None:
    """`package/msg|srv|action/Name` of a type of DDS; None when it is none of ROS 2."""
    found = _TYPE.fullmatch(name)
    if found is None:
        return None
    package, kind, last = found.groups()
    return f"{package}/{kind}/{last if kind == 'msg' else _PART.sub('', last)}"
