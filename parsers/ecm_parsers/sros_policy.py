"""SROS 2 security policies: which node may publish, subscribe, call or serve what.

Source: the schema of `sros2` policies 0.2.0 (`<enclaves>`), and 0.1.0 (`<profiles>` at the root).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml

Access = Literal["publish", "subscribe", "request", "reply", "call", "execute"]
_ACCESS: Final[dict[str, tuple[Access, ...]]] = {
    "topics": ("publish", "subscribe"),
    "services": ("request", "reply"),
    "actions": ("call", "execute"),
}


class Grant(msgspec.Struct, frozen=True):
    """One permission.

    Attributes:
        node: full name of the node that it is for.
        access: what the node may do. allowed: False for an explicit DENY.
        name: of the topic, service or action, absolute where it can be.
        line: 1-based.
    """

    node: str
    access: Access
    allowed: bool
    name: str
    line: int


def is_policy(data: bytes) -> bool:
    """Tell by the first bytes whether an XML file is a policy."""
    return b"<policy" in data[:2_000] and (b"<enclaves" in data or b"<profiles" in data)


def parse_policy(data: bytes) -> Parsed[tuple[Grant, ...]]:
    """Read a policy; included files are named in a diagnostic and not followed."""
    tree = parse_xml(data)
    problems = list(tree.diagnostics)
    if tree.root is None:
        return Parsed((), tuple(problems))
    grants = [grant for profile in _profiles(tree.root, problems) for grant in _grants(profile)]
    return Parsed(tuple(grants), tuple(problems))


def _profiles(root: etree._Element, problems: list[Diagnostic]) -> Iterator[etree._Element]:
    for element in root.iter():
        if not isinstance(element.tag, str):
            continue
        if local_name(element) == "profile":
            yield element
        elif local_name(element) == "include":
            message = f"Included file `{element.get('href', '')}` is not read. Check it by itself."
            problems.append(Diagnostic("info", "policy-include", line_of(element), message))


def _grants(profile: etree._Element) -> Iterator[Grant]:
    namespace = str(profile.get("ns", "/"))
    node = _absolute(namespace, str(profile.get("node", "")))
    for tag, group in children(profile):
        for access in _ACCESS.get(tag, ()):
            allowed = str(group.get(access, "")).upper()
            for _, entry in children(group):
                name = (entry.text or "").strip()
                if name and allowed in {"ALLOW", "DENY"}:
                    full = _named(name, namespace, node)
                    yield Grant(node, access, allowed == "ALLOW", full, line_of(entry))


def _named(name: str, namespace: str, node: str) -> str:
    if name.startswith("~"):
        return _absolute(node, name[1:].lstrip("/"))
    return name if name.startswith("/") or name == "*" else _absolute(namespace, name)


def _absolute(namespace: str, name: str) -> str:
    return f"/{namespace.strip('/')}/{name}".replace("//", "/") if namespace.strip("/") else f"/{name}"
