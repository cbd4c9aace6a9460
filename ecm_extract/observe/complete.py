"""What contracts leave open, filled from what was seen: an overlay with origin `observed`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any, Final

import msgspec
import yaml
from ecm_checker.gaps import with_gaps
from ecm_checker.view import View
from ecm_parsers.overlay_yaml import SCHEMA

from ecm_extract.observe.expected import Expected
from ecm_extract.observe.model import Endpoint
from ecm_extract.observe.standard import is_standard
from ecm_extract.observe.watch import Pair, Running, Watch

_HOLE: Final = re.compile(r"\{[^{}]*\}")
_HEAD: Final = (
    "# What the contracts leave open, as it was seen. Put it beside a package.xml as ecm.yaml, or merge it there.\n"
)
_DIGITS: Final = 3


def overlay_text(watch: Watch) -> str:
    """The overlay; it names a module only where something of it was open and was seen."""
    modules: dict[str, Any] = {}
    for running in watch.present:
        found = _module(watch, running)
        if found:
            modules[running.module.id] = found
    document = {"schema": SCHEMA, "origin": "observed", "modules": modules}
    return _HEAD + yaml.safe_dump(document, sort_keys=False, allow_unicode=True, width=120)


def _module(watch: Watch, running: Running) -> dict[str, Any]:
    opened = list(_opened(watch, running))
    known = [pair for pair in watch.pairs if pair.expected.module is running.module]
    without_qos = [pair for pair in known if pair.expected.interface.qos is None and _qos(pair.seen)]
    endpoints = [_filled(pair) for pair in (*opened, *without_qos)]
    rates = _rates(watch, running.module, (*opened, *known))
    return {
        **({"endpoints": endpoints} if endpoints else {}),
        **({"behavior": {"rates": rates}} if rates else {}),
    }


def _opened(watch: Watch, running: Running) -> Iterator[Pair]:
    """Endpoints of the node that no name of its contract means, with the only pattern that can mean them."""
    promises = watch.expected_on.get(running.node, ())
    named = {(each.interface.role, each.name) for each in promises}
    patterns = [each for each in promises if "{" in each.name and not each.interface.row.value]
    for end in watch.by_node.get(running.node, ()):
        if (end.role, end.name) in named or is_standard(end.role, end.name, running.node):
            continue
        fitting = {each.interface.name: each for each in patterns if _can_be(each, end)}
        if len(fitting) == 1:
            yield Pair(end, next(iter(fitting.values())))


def _can_be(pattern: Expected, end: Endpoint) -> bool:
    interface = pattern.interface
    same_type = interface.type is None or "{" in interface.type or interface.type == end.type
    form = with_gaps([re.escape(part) for part in _HOLE.split(pattern.name)], ".+")
    return interface.role == end.role and same_type and re.fullmatch(form, end.name) is not None


def _filled(pair: Pair) -> dict[str, Any]:
    end = pair.seen
    found = {
        "role": end.role,
        "was": pair.expected.interface.name,
        "name": end.name,
        "type": end.type,
        "qos": _qos(end),
    }
    return {key: value for key, value in found.items() if value}


def _qos(end: Endpoint) -> dict[str, Any]:
    """Policies that the source can see."""
    told = msgspec.to_builtins(end.qos) if end.qos is not None else {}
    return {policy: value for policy, value in told.items() if policy not in end.unseen}


def _rates(watch: Watch, module: View, pairs: Iterable[Pair]) -> dict[str, float]:
    """Rates of topics of a module whose contract tells none; what it tells is not touched."""
    told = module.contract.behavior.rates
    if told is not None and told.confidence != "pattern":
        return {}
    streams = {(each.topic, each.node): each for each in watch.seen.streams}
    found = {}
    for pair in pairs:
        stream = streams.get((pair.seen.name, pair.seen.node)) or streams.get((pair.seen.name, None))
        if pair.seen.row.writes and stream is not None and stream.hz is not None and not stream.latched:
            found[pair.seen.name] = float(f"{stream.hz:.{_DIGITS}g}")
    return found
