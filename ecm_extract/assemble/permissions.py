"""Permissions: motion by actuators, data by topics, hosts by parameters."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ecm_checker.contract import Evidence, Interface, Permissions, Value
from ecm_checker.hub.roles import roles

from ecm_extract.assemble.evidence import inferred, of_interfaces, parameters_where
from ecm_extract.assemble.resources import actuators_of
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts

_ADDRESS = re.compile(r"(?:^|_)(?:ip|host|hostname|url|ip_address|address|robot_ip|server_ip|uri)$")
_POLICY = {"subscribe": "read", "publish": "write"}


def permissions_of(entry: LinkedModule, facts: PackageFacts) -> Permissions:
    """Return the permissions section of a module."""
    moves = actuators_of(entry)
    return Permissions(
        physical=inferred({"motion": True}, moves.evidence) if moves is not None else None,
        data=_granted(entry, facts) or _data(entry.interfaces),
        network=_network(entry.interfaces),
    )


def _granted(entry: LinkedModule, facts: PackageFacts) -> Value | None:
    """What a policy of the package allows the module's node."""
    found: dict[str, Evidence] = {}
    for path, grants in facts.grants.items():
        for grant in grants:
            verb = _POLICY.get(grant.access)
            if verb and grant.allowed and entry.node and grant.node.rpartition("/")[2] == entry.node:
                found.setdefault(f"{verb}:{grant.name}", Evidence(path, grant.line))
    return inferred(sorted(found), found.values())


def _data(interfaces: Sequence[Interface]) -> Value | None:
    found = [entry for entry in interfaces if roles()[entry.role].shape == "msg" and "{" not in entry.name]
    return of_interfaces(sorted({f"{_access(entry)}:{entry.name}" for entry in found}), found)


def _access(entry: Interface) -> str:
    return "write" if roles()[entry.role].sends else "read"


def _network(interfaces: Sequence[Interface]) -> Value | None:
    """Addresses that a module is given as parameters; their defaults where they have one."""
    found = parameters_where(interfaces, lambda name: _ADDRESS.search(name) is not None)
    hosts = [str(entry.default) if isinstance(entry.default, str) and entry.default else entry.name for entry in found]
    return inferred(sorted(set(hosts)), (entry.evidence[0] for entry in found), "default")
