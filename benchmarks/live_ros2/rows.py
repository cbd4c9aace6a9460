"""What a node has by ROS 2's own word, beside what its contract says of it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from ecm_checker.contract import Contract, Qos
from ecm_checker.view import view

from ecm_extract.observe.expected import Expected, graph_keys, is_exact, on_node
from ecm_extract.observe.model import Endpoint, Observation
from ecm_extract.observe.standard import is_standard

POLICIES = ("reliability", "durability", "history", "depth", "deadline_ms", "lifespan_ms", "liveliness", "lease_ms")
_HOLE = re.compile(r"\\\{[^{}]*\\\}")
# What every node declares: rclcpp/node_impl, time_source.cpp, node_type_descriptions.cpp; overrides of QoS are its own.
_OF_EVERY_NODE = re.compile(r"use_sim_time|start_type_description_service|qos_overrides\..*")


@dataclass
class Count:
    """Rows that are right of all, and those that are not, in words."""

    right: int = 0
    wrong: list[str] = field(default_factory=list)

    @property
    def whole(self) -> int:
        return self.right + len(self.wrong)

    def add(self, right: bool, text: str) -> None:
        if right:
            self.right += 1
        else:
            self.wrong.append(text)


KINDS = (
    "endpoint recall",
    "endpoint precision",
    "type",
    "QoS recall",
    "QoS precision",
    "parameter recall",
    "parameter precision",
    "parameter value",
    "seen by observe",
)


def compared(contracts: Sequence[Contract], node: str, told: Observation, seen: Observation) -> dict[str, Count]:
    """Rows of one node by kind.

    Args:
        contracts: of which it is an instance; none when no contract has its name.
        node: its full name.
        told: by rclpy. seen: by `observe --dds`.
    """
    counts = {kind: Count() for kind in KINDS}
    promises = [each for module in contracts for each in on_node(view(module), node)]
    ends = [end for end in told.endpoints if end.node == node and not is_standard(end.role, end.name, node)]
    _endpoints(counts, promises, ends)
    if node not in {gap.what for gap in told.gaps}:
        _parameters(counts, promises, {each.name: each.value for each in told.parameters if each.node == node})
    _observed(counts["seen by observe"], ends, [end for end in seen.endpoints if end.node == node])
    return counts


def _endpoints(counts: dict[str, Count], promises: Iterable[Expected], ends: Sequence[Endpoint]) -> None:
    wanted = [each for each in promises if each.interface.role != "parameter"]
    for end in ends:
        meant = [each for each in wanted if _means(each, end)]
        counts["endpoint recall"].add(bool(meant), f"missed {end.role} {end.name} [{end.type}]")
        exact = [each for each in meant if "{" not in each.name]
        if exact:
            _type(counts["type"], exact[0], end)
            _qos(counts, exact[0], end)
    for each in wanted:
        is_there = any(_means(each, end) for end in ends)
        if _is_promised(each, is_there):
            counts["endpoint precision"].add(is_there, f"not there: {each.interface.role} {each.name}")


def _means(each: Expected, end: Endpoint) -> bool:
    """Whether a promise is this endpoint; an open name is every name that it can become."""
    return any(
        role == end.role and re.fullmatch(_HOLE.sub(".+", re.escape(name)), end.name) is not None
        for role, name in graph_keys(each)
    )


def _type(count: Count, each: Expected, end: Endpoint) -> None:
    wanted = each.interface.type
    if wanted is not None and "{" not in wanted and end.type is not None:
        count.add(wanted == end.type, f"{end.name}: {end.type}, the contract says {wanted}")


def _qos(counts: dict[str, Count], each: Expected, end: Endpoint) -> None:
    """Each policy that is told of topics; `None` of both is a policy that nobody asked for."""
    promised, real = each.interface.qos, end.qos
    if real is None:
        return
    for policy in POLICIES:
        has = getattr(real, policy)
        says = getattr(promised, policy) if promised is not None else None
        if says is not None or _is_asked_for(real, policy):
            counts["QoS recall"].add(says is not None, f"{end.role} {end.name}: {policy} {has} is not told")
        if says is not None:
            counts["QoS precision"].add(has == says, f"{end.role} {end.name}: {policy} {has}, the contract says {says}")


def _is_asked_for(real: Qos, policy: str) -> bool:
    """A depth says nothing where all is kept, and automatic is the liveliness of who says nothing of it."""
    has = getattr(real, policy)
    if policy == "depth":
        return real.history != "keep_all"
    return has is not None and (policy, has) != ("liveliness", "automatic")


def _parameters(counts: dict[str, Count], promises: Iterable[Expected], real: dict[str, object]) -> None:
    wanted = [each for each in promises if each.interface.role == "parameter"]
    named = {_plain(each): each for each in wanted}
    for name, value in real.items():
        if _OF_EVERY_NODE.fullmatch(name):
            continue
        open_form = any("{" in key and re.fullmatch(_HOLE.sub(".+", re.escape(key)), name) for key in named)
        counts["parameter recall"].add(name in named or open_form, f"missed parameter {name} = {value!r}")
        if name in named:
            _value(counts["parameter value"], named[name], value)
    for name, each in named.items():
        if _is_promised(each, name in real) and not _OF_EVERY_NODE.fullmatch(name):
            counts["parameter precision"].add(name in real, f"not there: parameter {name}")


def _is_promised(each: Expected, is_there: bool) -> bool:
    """Whether a row has a fixed name and is told without conditions, of which this run may have met none."""
    return is_exact(each) and (is_there or not each.interface.when)


def _plain(each: Expected) -> str:
    return each.interface.raw_name.removeprefix("~/").removeprefix("~")


def _value(count: Count, each: Expected, real: object) -> None:
    """A default that the contract tells as one value."""
    default = each.interface.default
    if default is not None and "{" not in str(default):
        same = list(default) == real if isinstance(default, list | tuple) else default == real
        count.add(same, f"{each.name} is {real!r}, the contract says {default!r}")


def _observed(count: Count, told: Sequence[Endpoint], seen: Sequence[Endpoint]) -> None:
    """By DDS alone everything that ROS 2 tells is seen, with the same type and policies."""
    by_key = {(end.role, end.name): end for end in seen}
    for end in told:
        other = by_key.get((end.role, end.name))
        if other is None or other.type != end.type:
            count.add(False, f"{end.role} {end.name} [{end.type}]: {other.type if other else 'not seen'}")
        else:
            wrong = list(_other_policies(end.qos, other.qos, other.unseen))
            count.add(not wrong, f"{end.role} {end.name}: {', '.join(wrong)}")


def _other_policies(one: Qos | None, two: Qos | None, unseen: Sequence[str]) -> Iterator[str]:
    if one is not None and two is not None:
        for policy in POLICIES:
            if policy not in unseen and getattr(one, policy) != getattr(two, policy):
                yield f"{policy} {getattr(one, policy)} and {getattr(two, policy)}"
