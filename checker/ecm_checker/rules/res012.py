"""A package takes what a class of another one lets others take, and nobody gives it back."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources
from typing import Any

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.engine import match
from ecm_checker.match.packages import Packages
from ecm_checker.rule import PackageMatter, Rule

RULE = Rule(
    id="RES012",
    name="taken_never_released",
    dimension="resources",
    severity="warning",
    who="safety",
    part_of=("ResJointSat",),
    consequence="what was taken stays taken: whoever asks for it next is refused until a restart",
    resolution="give it back where the work ends",
)


def check(case: Case) -> Iterator[Finding]:
    """Calls of a method that takes, where the class has the counterpart and no package in question calls it."""
    packages = case.packages
    if packages is None:
        return
    called = {each.name for consumer in packages.consumers for each in consumer.requirements if _is_call(each)}
    takers = {take.key: give for take, give in _pairs(packages) if give.name not in called and take.name in called}
    names = {key[3] for key in takers}
    for consumer in packages.consumers if takers else ():
        for wanted in consumer.requirements:
            if not _is_call(wanted) or wanted.name not in names:
                continue
            for taken in match(wanted, consumer, packages.provisions, packages.names).found:
                if taken.key in takers:
                    yield _finding(wanted, consumer.package, taken, takers[taken.key])


def _is_call(wanted: Requirement) -> bool:
    return wanted.use == "calls_method"


def _pairs(packages: Packages) -> Iterator[tuple[Provision, Provision]]:
    """Methods of one class that take and give back."""
    methods = {(each.owner, each.name): each for each in packages.provisions.of_kind("method") if not each.is_python}
    for (owner, name), take in methods.items():
        for begin, end in _table()["pairs"].items():
            give = methods.get((owner, end + name.removeprefix(begin))) if name.startswith(begin) else None
            if give is not None and all(form.returns in _table()["returns"]["nothing"] for form in take.forms):
                yield take, give


def _finding(wanted: Requirement, consumer: str, take: Provision, give: Provision) -> Finding:
    text = f"{take.name} of {take.owner} is called by {consumer}, and nothing calls {give.name}"
    matter = PackageMatter(
        text=text,
        consequence=RULE.consequence,
        entity=Entity("method", f"{take.owner}::{take.name}", give.name),
        who=RULE.who,
        packages=(take.package, consumer),
        evidence=(*wanted.evidence, Evidence(take.path, take.line)),
    )
    return RULE.package_finding(matter, "likely")


@cache
def _table() -> Mapping[str, Mapping[str, Any]]:
    return tomllib.loads((resources.files("ecm_checker") / "data" / "handles.toml").read_text("utf-8"))
