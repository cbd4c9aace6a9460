"""SROS 2 security policies: which node may publish, subscribe, call or serve what.

Source: the schema of `sros2` policies 0.2.0 (`<enclaves>`), and 0.1.0 (`<profiles>` at the root or below
`<policy>`); design.ros2.org "ROS 2 Access Control Policies".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final, Literal

import msgspec
from lxml import etree

from ecm_parsers.result import Diagnostic, Parsed, shortened
from ecm_parsers.xml_tree import children, line_of, local_name, parse_xml

MAX_DIAGNOSTICS = 100
Access = Literal["publish", "subscribe", "request", "reply", "call", "execute"]
GrantKind = Literal["topic", "service", "action"]
_ACCESS: Final[dict[str, tuple[GrantKind, tuple[Access, ...]]]] = {
    "topics": ("topic", ("publish", "subscribe")),
    "services": ("service", ("request", "reply")),
    "actions": ("action", ("call", "execute")),
}
_ROOTS: Final = frozenset({"policy", "enclaves", "profiles"})
_ENCLAVES: Final = frozenset({"enclave", "context"})  # named contexts before ROS 2 Foxy
_PROFILE: Final = re.compile(rb"<(?:profile\s|enclaves\b|contexts\b)")


class Grant(msgspec.Struct, frozen=True):
    """One permission.

    Attributes:
        node: full name of the node that it is for.
        access: what the node may do. allowed: False for an explicit DENY.
        name: of the topic, service or action, absolute where it can be.
        line: 1-based.
        kind: what `name` names.
        namespace: of the node, as the profile gives it.
        enclave: path of the enclave around the profile; empty in a policy of version 0.1.0.
    """

    node: str
    access: Access
    allowed: bool
    name: str
    line: int
    kind: GrantKind = "topic"
    namespace: str = "/"
    enclave: str = ""


def is_policy(data: bytes) -> bool:
    """Tell by its tags whether an XML file is a policy; DDS profiles have other ones."""
    head = data[:20_000]
    return (b"<policy" in head or b"<profiles" in head) and _PROFILE.search(head) is not None


def parse_policy(data: bytes) -> Parsed[tuple[Grant, ...]]:
    """Read a policy; included files are named in a diagnostic and not followed."""
    tree = parse_xml(data)
    problems = list(tree.diagnostics)
    if tree.root is None:
        return Parsed((), tuple(problems))
    if local_name(tree.root) not in _ROOTS:
        message = f"<{local_name(tree.root)}> is not the root of a policy. Make it <policy>."
        problems.append(Diagnostic("error", "policy-wrong-root", line_of(tree.root), message))
        return Parsed((), tuple(problems))
    grants = [grant for profile in _profiles(tree.root, problems) for grant in _grants(profile, problems)]
    return Parsed(tuple(grants), shortened(problems, MAX_DIAGNOSTICS))


class _Profile(msgspec.Struct, frozen=True):
    """A profile with what its grants have in common."""

    element: etree._Element
    node: str
    namespace: str
    enclave: str


def _profiles(root: etree._Element, problems: list[Diagnostic]) -> Iterator[_Profile]:
    """All profiles of the file; an include may stand at any level."""
    enclave = ""
    for element in root.iter(etree.Element):
        tag = local_name(element)
        if tag in _ENCLAVES:
            enclave = str(element.get("path", "")).strip()
        elif tag == "include":
            part = f" ({element.get('xpointer')})" if element.get("xpointer") else ""
            message = f"Included file `{element.get('href', '')}`{part} is not read. Check it by itself."
            problems.append(Diagnostic("info", "policy-include", line_of(element), message))
        elif tag == "profile":
            yield from _profile(element, enclave, problems)


def _profile(element: etree._Element, enclave: str, problems: list[Diagnostic]) -> Iterator[_Profile]:
    name = str(element.get("node", "")).strip()
    namespace = str(element.get("ns", "/")).strip()
    if name:
        yield _Profile(element, _absolute(namespace, name), namespace, enclave)
        return
    message = "The profile names no node, so its grants hold for none. Add node."
    problems.append(Diagnostic("error", "policy-no-node", line_of(element), message))


def _grants(profile: _Profile, problems: list[Diagnostic]) -> Iterator[Grant]:
    for tag, group in children(profile.element):
        if tag not in _ACCESS:
            continue
        kind, accesses = _ACCESS[tag]
        permitted = [(access, _permission(group, access, problems)) for access in accesses if access in group.attrib]
        for own, entry in children(group):
            name = (entry.text or "").strip()
            if own != kind or not name:
                _report_entry(own, entry, kind, problems)
                continue
            full = _named(name, profile)
            for access, allowed in permitted:
                if allowed is not None:
                    yield Grant(
                        node=profile.node,
                        access=access,
                        allowed=allowed,
                        name=full,
                        line=line_of(entry),
                        kind=kind,
                        namespace=profile.namespace,
                        enclave=profile.enclave,
                    )


def _permission(group: etree._Element, access: Access, problems: list[Diagnostic]) -> bool | None:
    written = str(group.get(access, "")).strip()
    if written.upper() in {"ALLOW", "DENY"}:
        return written.upper() == "ALLOW"
    message = f"`{access}` is `{written[:40]}` and grants nothing. Write ALLOW or DENY."
    problems.append(Diagnostic("error", "policy-bad-permission", line_of(group), message))
    return None


def _report_entry(tag: str, entry: etree._Element, kind: GrantKind, problems: list[Diagnostic]) -> None:
    if tag == "include":
        return
    message = f"<{tag}> among the {kind}s names none and is skipped. Write <{kind}>name</{kind}>."
    problems.append(Diagnostic("error", "policy-bad-entry", line_of(entry), message))


def _named(name: str, profile: _Profile) -> str:
    """The full name: `~` is the node, other names that are not absolute hang below its namespace."""
    if name.startswith("~"):
        return _absolute(profile.node, name[1:].lstrip("/"))
    return name if name.startswith("/") or name == "*" else _absolute(profile.namespace, name)


def _absolute(namespace: str, name: str) -> str:
    around = namespace.strip("/")
    return f"/{around}/{name.lstrip('/')}" if around else f"/{name.lstrip('/')}"
