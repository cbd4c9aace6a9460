"""Whether a precondition of a contract holds in what was seen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.hub.roles import roles
from ecm_checker.predicates import Predicate, fact, settle

from ecm_extract.observe.model import Parameter
from ecm_extract.observe.watch import Watch

LIFECYCLE: Final = "lifecycle_state"


class Verdict(msgspec.Struct, frozen=True):
    """Whether it holds, and what was seen of it."""

    true: bool
    reason: str


def holds(watch: Watch, node: str, wanted: Predicate) -> Verdict | None:
    """Return whether a precondition of a node holds; None when what was seen does not settle it.

    A lookup of a transform is a promise of its own and is judged there.
    """
    word, _, name = wanted.text.partition(" ")
    awaited = next((role for role, row in roles().items() if row.awaited == word), None)
    if awaited is not None:
        return _there(watch, awaited, name.strip()) if name.strip() else None
    known = settle(_facts(watch, node), wanted)
    if known == "unknown":
        return None
    return Verdict(known == "implied", f"{wanted.subject} is otherwise")


def _there(watch: Watch, role: str, name: str) -> Verdict | None:
    """Whether somebody serves a name, or writes to it: a topic without any publisher can give no message."""
    if role not in watch.seen.senses or "{" in name:
        return None
    found = watch.by_name.get((role, name))
    nobody = "nobody publishes it" if roles()[role].writes else f"no {role.replace('_', ' ')} of that name was seen"
    return Verdict(bool(found), nobody)


def _facts(watch: Watch, node: str) -> Iterator[Predicate]:
    """Parameters of the node and the state of its life cycle."""
    for parameter in watch.seen.parameters:
        if _is_read_by(parameter, node) and isinstance(parameter.value, bool | int | float | str):
            yield fact(parameter.name.rpartition("/")[2], parameter.value)
    for state in watch.seen.states:
        if state.node == node:
            yield fact(LIFECYCLE, state.name)


def _is_read_by(parameter: Parameter, node: str) -> bool:
    """A parameter of the node, or one in the root, which ROS 1 shares between all."""
    if parameter.node is not None:
        return parameter.node == node
    return parameter.name.startswith(f"{node}/") or parameter.name.count("/") == 1
