"""A package takes what a class of another one lets others take, and nobody gives it back."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.handles import pairs, plain_returns
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.launch_names import required
from ecm_checker.match.packages import Packages
from ecm_checker.package_said import package_said
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES012",
    name="taken_never_released",
    dimension="resources",
    severity="warning",
    who="safety",
    part_of=("ResJointSat",),
    by_absence=True,
    consequence="what was taken stays taken: whoever asks for it next is refused until a restart",
    resolution="give it back where the work ends",
)


def check(case: Case) -> Iterator[Finding]:
    """Calls of a method that takes, where the class has the counterpart and no package in question calls it."""
    packages = case.packages
    if packages is None:
        return
    calls = list(required(packages, "handles"))
    called = {each.name for _, each in calls}
    kept = {take.name: (take, give) for take, give in _pairs(packages) if give.name not in called}
    for package, wanted in calls:
        if wanted.name in kept:
            yield _finding(wanted, package, *kept[wanted.name])


def _pairs(packages: Packages) -> Iterator[tuple[Provision, Provision]]:
    """Methods of one class that take and give back."""
    methods = {
        (each.owner, each.name): each
        for each in packages.provisions.that(lambda row: row.called and row.part)
        if not each.is_python
    }
    for (owner, name), take in methods.items():
        for begin, end in pairs().items():
            give = methods.get((owner, end + name.removeprefix(begin))) if name.startswith(begin) else None
            if give is not None and all(form.returns in plain_returns() for form in take.forms):
                yield take, give


def _finding(wanted: Requirement, consumer: str, take: Provision, give: Provision) -> Finding:
    text = f"{take.name} of {take.owner} is called by {consumer}, and nothing calls {give.name}"
    said = package_said(
        text=text,
        entity=Entity("method", f"{take.owner}::{take.name}", give.name),
        packages=(take.package, consumer),
        evidence=(*wanted.evidence, Evidence(take.path, take.line)),
    )
    return RULE.found(said)
