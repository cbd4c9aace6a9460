"""What a node registered and read, beside what its contract says."""

from __future__ import annotations

import re
from collections.abc import Iterable, Set
from dataclasses import dataclass

from ecm_checker.contract import Contract
from ecm_checker.view import view

from ecm_extract.observe.expected import Expected, graph_keys, is_exact, on_node
from ecm_extract.observe.model import Observation
from ecm_extract.observe.standard import is_standard

Key = tuple[str, str]
Line = tuple[str, int]
_ROLES = frozenset({"publisher", "subscriber", "service_server", "action_server", "action_client", "parameter"})
_NO_PROGRAMS = (".cfg", ".yaml", ".yml", ".xml", ".launch", ".msg", ".srv", ".action")
_HOLE = re.compile(r"\\\{[^{}]*\\\}")
# What rospy itself asks for, whatever a node does: rospy/impl/init.py, simtime.py, impl/tcpros_service.py, names.py.
_OF_ROSPY = re.compile(r"/(use_sim_time|tcp_keepalive|statistics_\w+|enable_statistics|rosout_disable_\w+|run_id)")


@dataclass(frozen=True)
class Compared:
    """Rows of one node.

    Attributes:
        registered: what the node has. known: those of them that its contract has.
        promised: rows of the contract with a fixed name. kept: those of them that were registered.
        unreached: those of them that were not, as a line that leads to them did not run.
    """

    registered: frozenset[Key]
    known: frozenset[Key]
    promised: frozenset[Key]
    kept: frozenset[Key]
    unreached: frozenset[Key] = frozenset()


def compared(
    contract: Contract, node: str, seen: Observation, asked: Iterable[Key], ran: Set[Line] | None = None
) -> Compared:
    """Rows of a node and of its contract on that node.

    Args:
        contract: of which the node is an instance. node: its full name.
        seen: of the graph. asked: parameters by who asked for them.
        ran: lines of the tree that ran; None when that is not known.
    """
    promises = list(on_node(view(contract), node))
    registered = _registered(node, seen) | {("parameter", key) for caller, key in asked if caller == node}
    registered = frozenset(key for key in registered if not _OF_ROSPY.fullmatch(key[1]))
    exact = [each for each in promises if is_exact(each) and _roles(each) <= _ROLES]
    fixed = [frozenset(graph_keys(each)) for each in exact]
    idle = [each for each in exact if ran is not None and not _lines(each) <= ran]
    return Compared(
        registered,
        frozenset(key for key in registered if any(_means(each, key) for each in promises)),
        frozenset(min(keys) for keys in fixed),
        frozenset(min(keys) for keys in fixed if keys & registered),
        frozenset(min(keys) for keys in map(frozenset, map(graph_keys, idle)) if not keys & registered),
    )


def _lines(each: Expected) -> frozenset[Line]:
    """The lines of programs that lead to a row; a line of another file says nothing of what ran."""
    return frozenset((at.path, at.line) for at in each.interface.evidence if not at.path.endswith(_NO_PROGRAMS))


def _registered(node: str, seen: Observation) -> frozenset[Key]:
    return frozenset(
        (end.role, end.name) for end in seen.endpoints if end.node == node and not is_standard(end.role, end.name, node)
    )


def _roles(each: Expected) -> frozenset[str]:
    return frozenset(role for role, _ in graph_keys(each))


def _means(each: Expected, key: Key) -> bool:
    """Whether a promise is this row; an open name is every name that it can become."""
    for role, name in graph_keys(each):
        if role == key[0] and re.fullmatch(_HOLE.sub(".+", re.escape(name)), key[1]):
            return True
    return False
