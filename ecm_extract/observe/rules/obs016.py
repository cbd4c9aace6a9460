"""A parameter runs with another type or value than its contract says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.expected import Expected
from ecm_extract.observe.model import Parameter
from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS016",
    name="parameter_differs",
    dimension="behavior",
    severity="warning",
    who="config",
    consequence="what was checked with the value of the contract does not hold here",
    resolution="see which file or command sets it; an intended value belongs into the launch that was checked",
)
_NUMBERS = frozenset({"int", "integer", "double", "float", "number"})
_TYPES = {bool: "bool", int: "int", float: "double", str: "string"}


def check(watch: Watch) -> Iterator[Finding]:
    """Parameters of running nodes: another type is a warning, another value than the default is told."""
    seen = {(each.node, each.name): each for each in watch.seen.parameters}
    for node, promises in watch.expected_on.items():
        for each in promises:
            if not each.interface.row.value:
                continue
            found = seen.get((node, each.interface.raw_name)) or seen.get((None, each.name))
            if found is not None:
                yield from _difference(node, each, found)


def _difference(node: str, each: Expected, found: Parameter) -> Iterator[Finding]:
    entity = Entity("parameter", each.name)
    subjects = (each.module.id, node)
    wanted, default = each.interface.type, each.interface.default
    if wanted is not None and not _fits(found.value, wanted):
        text = f"{node} runs with {each.name} = {found.value!r}, its contract says that it is a {wanted}"
        yield RULE.seen(text, entity, subjects, line_of(each))
    elif default is not None and "{" not in str(default) and not _same(found.value, default):
        text = f"{node} runs with {each.name} = {found.value!r}, the default is {default!r}"
        yield RULE.seen(text, entity, subjects, line_of(each), severity="info")


def _fits(value: Any, wanted: str) -> bool:
    """Whole numbers are taken where numbers are asked for; types that are no plain ones are not judged."""
    kind = _TYPES.get(type(value))
    if kind is None or wanted not in {*_NUMBERS, "bool", "boolean", "string", "str"}:
        return True
    if wanted in _NUMBERS:
        return kind in {"int", "double"}
    return wanted[:3] == kind[:3]


def _same(one: Any, two: Any) -> bool:
    if isinstance(one, list | tuple) and isinstance(two, list | tuple):
        return list(one) == list(two)
    return bool(one == two)
