"""A reader of any topic asks for more than a publisher offers.

Source: ROS 2 documentation, "Quality of Service settings", compatibilities.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from functools import cache
from importlib import resources
from typing import Final, NamedTuple

from ecm_checker.case import Case
from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.launch_names import required
from ecm_checker.match.qos_fit import level_fits
from ecm_checker.qos import setting
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="BEH011",
    name="generic_reader_strict",
    dimension="behavior",
    severity="warning",
    who="qos",
    part_of=("BehMatch",),
    consequence="of such a topic it gets nothing, and no error is shown",
    resolution="ask the graph for the policies of the publishers first, or let the user choose them",
)
_ANY: Final = re.compile(r"/?\{[^{}]*\}")
_POLICIES: Final = ("reliability", "durability")
_ALL: Final = frozenset({*_POLICIES, "history", "depth"})
_ROS1: Final = 1
MAX_PLACES: Final = 3


class _Offer(NamedTuple):
    """A topic of a publisher that sets a policy lower than it is asked for."""

    module: View
    endpoint: Interface
    policy: str


def check(case: Case) -> Iterator[Finding]:
    """Each reader whose topic and type are known only when it runs, once; a library reads in whoever uses it."""
    for module in (*case.modules, *case.libraries):
        for reader in module.unmatched:
            if _takes_any(reader) and module.contract.ecm.ros != _ROS1 and not _reads_lists(module.package, case):
                weaker = [offer for giver in case.modules for offer in _weaker(giver, module, reader)]
                if weaker:
                    yield _finding(module, reader, weaker)


def _takes_any(reader: Interface) -> bool:
    """Whether topic and type come when it runs, and the source says anything of the policies."""
    asks = reader.qos is not None and set(reader.qos.defaulted) != _ALL
    return reader.row.reads and reader.type is None and _ANY.fullmatch(reader.name) is not None and asks


def _weaker(giver: View, module: View, reader: Interface) -> Iterator[_Offer]:
    if giver.package == module.package or giver.contract.ecm.ros == _ROS1:
        return
    for offer in giver.written:
        for policy in _POLICIES:
            offered = setting(offer, policy)
            if offered.sure and not level_fits(offered, setting(reader, policy)):
                yield _Offer(giver, offer, policy)


def _reads_lists(package: str, case: Case) -> bool:
    """Whether a package loads files of settings: the topics may be those that a file lists."""
    calls = required(case.packages, "calls") if case.packages is not None else ()
    return any(caller == package and each.name in _loaders() for caller, each in calls)


def _finding(module: View, reader: Interface, weaker: list[_Offer]) -> Finding:
    first = weaker[0]
    asked, given = setting(reader, first.policy).value, setting(first.endpoint, first.policy).value
    text = (
        f"{module.id} subscribes to any topic with {first.policy} {asked}, "
        f"and {first.module.id} publishes {first.endpoint.name} with {given}"
    )
    evidence = [*reader.evidence[:MAX_PLACES], *(offer.endpoint.evidence[0] for offer in weaker[:MAX_PLACES])]
    entity = Entity("topic", reader.name, first.policy)
    return RULE.finding(text, entity, (module, first.module), evidence, certainty="likely")


@cache
def _loaders() -> frozenset[str]:
    text = (resources.files("ecm_checker") / "data" / "loaders.toml").read_text("utf-8")
    return frozenset(tomllib.loads(text)["files"])
