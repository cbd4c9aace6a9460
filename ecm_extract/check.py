"""From paths and profiles to the report of an operation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Final

import msgspec
from ecm_checker.case import Case
from ecm_checker.contract import Contract, Evidence
from ecm_checker.finding import Dimension, Finding
from ecm_checker.match.packages import Packages
from ecm_checker.operations.chain import chain
from ecm_checker.operations.compose import compose
from ecm_checker.operations.engine import examine, ready, report
from ecm_checker.operations.invoke import invoke
from ecm_checker.operations.partly import partly_read
from ecm_checker.operations.system import system
from ecm_checker.outcome import Report
from ecm_checker.profiles import Call, Embodiment, Policy, Profiles, Runtime

from ecm_extract.asked import refuse_gaps
from ecm_extract.check_inputs import Subject, Told, launched_contracts, silent, subject
from ecm_extract.errors import InputError
from ecm_extract.outside import Known, outside_findings, told
from ecm_extract.tree.unread import unread_in


class Given(msgspec.Struct, frozen=True):
    """Profiles that the user gave, launch files to compose by, and how trees are read.

    `cache`: it may be used. `told`: takes what is said of a tree that was read. `known`: gives what others provide.
    """

    embodiment: Embodiment | None = None
    policy: Policy | None = None
    runtime: Runtime | None = None
    call: Call | None = None
    cache: bool = True
    launch: tuple[str, ...] = ()
    told: Told = silent
    known: Known | None = None

    @property
    def profiles(self) -> Profiles:
        """Those that every operation takes."""
        return Profiles(self.embodiment, self.policy, self.runtime)


_BARE: Final = "it holds manifests only; `ecm-extract PATH -o DIR` writes the documents beside them"
Dimensions = tuple[Dimension, ...]
_Groups = Sequence[tuple[Contract, ...]]


def decide(operation: str, paths: Sequence[str], given: Given, dimensions: Dimensions, together: bool) -> Report:
    """The report of an operation over what paths name.

    Args:
        operation: its name.
        paths: see `check_inputs.subject`.
        given: profiles.
        dimensions: those to consult.
        together: whether the modules of a system are known to run together.

    Raises:
        InputError: paths or profiles do not fit the operation.
    """
    if given.known is not None and (operation != "system" or given.launch):
        message = "a registry tells what packages provide, which is asked of a system from its sources or documents"
        raise InputError(message, "leave --registry out, or write: check PATH --registry")
    if given.launch:
        return _launched(operation, paths, given, dimensions)
    subjects = [subject(path, given.cache, given.told) for path in paths]
    if operation == "upgrade":
        return _with_unasked(_upgrade(_whole(subjects), given, dimensions), subjects)
    groups = [each.contracts for each in subjects]
    unread = [row for each in subjects for row in each.unread]
    if operation == "system":
        packages = _packages(subjects)
        decided = system(_flat(groups), given.profiles, dimensions, together=together, packages=packages)
        return partly_read(_with_unasked(_with_outside(decided, subjects, given), subjects), unread)
    return partly_read(_DECISIONS[operation](groups, given, dimensions), unread)


def _whole(subjects: Sequence[Subject]) -> Sequence[Subject]:
    """Subjects of which all was read: what a side lacks is as much as what it has where two are compared."""
    for each in subjects:
        refuse_gaps(each.path, unread_in(each.unread))
    return subjects


def _launched(operation: str, paths: Sequence[str], given: Given, dimensions: Dimensions) -> Report:
    """What launch files of a workspace start together."""
    if operation != "system" or len(paths) != 1:
        message = "--launch goes with the operation system and one workspace"
        raise InputError(message, "write: check system WORKSPACE --launch package/file.launch.py")
    launched = launched_contracts(paths[0], given.launch, given.cache)
    started = Packages([launched.started])
    decided = system(launched.contracts, given.profiles, dimensions, together=True, started=started)
    findings = tuple(_with_starts(finding, launched.starts) for finding in decided.findings)
    return partly_read(msgspec.structs.replace(decided, findings=findings), launched.unread)


def _with_starts(finding: Finding, starts: Mapping[str, Evidence]) -> Finding:
    """A finding with the lines that start its nodes, after those that declare what meets there."""
    lines = (starts[name] for name in finding.subjects if name in starts)
    return msgspec.structs.replace(finding, evidence=tuple(dict.fromkeys((*finding.evidence, *lines))))


def _flat(groups: _Groups) -> list[Contract]:
    return [contract for group in groups for contract in group]


def _exactly(count: int, found: list[Contract], what: str) -> list[Contract]:
    if len(found) != count:
        message = f"{what} takes {count} module(s), the paths name {len(found)}"
        raise InputError(message, "name single manifests (*.ecm.yaml)")
    return found


def _compose(groups: _Groups, given: Given, dimensions: Dimensions) -> Report:
    first, second = _exactly(2, _flat(groups), "compose")
    return compose(first, second, given.profiles, dimensions)


def _chain(groups: _Groups, given: Given, dimensions: Dimensions) -> Report:
    return chain(_flat(groups), given.profiles, dimensions)


def _install(groups: _Groups, given: Given, dimensions: Dimensions) -> Report:
    """Each module by itself; the report is on all of them."""
    found = []
    for contract in _flat(groups):
        found += examine("install", Case((ready(contract),), given.profiles), dimensions)
    return report("install", found, given.profiles, dimensions)


def _invoke(groups: _Groups, given: Given, dimensions: Dimensions) -> Report:
    (module,) = _exactly(1, _flat(groups), "invoke")
    return invoke(module, given.call or Call(), given.profiles, dimensions)


def _upgrade(subjects: Sequence[Subject], given: Given, dimensions: Dimensions) -> Report:
    """Modules of the old and the new side by their id; what follows are modules that use the old side."""
    if len(subjects) < 2:
        message = "upgrade takes OLD NEW"
        raise InputError(message, "name two manifests, folders or trees")
    old = {contract.ecm.module_id: ready(contract) for contract in subjects[0].contracts}
    new = {contract.ecm.module_id: ready(contract) for contract in subjects[1].contracts}
    rest = [each.contracts for each in subjects[2:]]
    users = tuple(ready(contract) for contract in _flat(rest)) if rest else None
    if old.keys().isdisjoint(new):
        message = "no module is on both sides"
        raise InputError(message, "modules are paired by their module_id")
    found = []
    for name, previous in old.items():
        case = Case([new[name]] if name in new else [], given.profiles, previous=previous, dependents=users)
        found += examine("upgrade", case, dimensions)
    found += examine("upgrade", _release(subjects, given), dimensions)
    return report("upgrade", found, given.profiles, dimensions)


def _release(subjects: Sequence[Subject], given: Given) -> Case:
    """The packages of both sides and of their users as a whole."""
    old, new = _packages(subjects[:1]), _packages(subjects[1:2])
    return Case((), given.profiles, packages=new, replaced=old, users=_packages(subjects[2:]))


def _packages(subjects: Sequence[Subject]) -> Packages | None:
    """The packages that have documents; None where nothing has any."""
    found = [package for each in subjects for package in each.packages]
    return Packages(found) if found else None


def _with_outside(decided: Report, subjects: Sequence[Subject], given: Given) -> Report:
    """A report that knows what others provide."""
    if given.known is None:
        return decided
    inside = [package for each in subjects for package in each.packages]
    outside = given.known(inside)
    asked = "signature" in decided.dimensions
    found = [*decided.findings, *(outside_findings(inside, outside) if asked else ())]
    whole = report("system", found, given.profiles, decided.dimensions)
    return msgspec.structs.replace(whole, not_asked=(*decided.not_asked, *told(outside)))


def _with_unasked(decided: Report, subjects: Sequence[Subject]) -> Report:
    """A report that says whose requirements were not asked, or not all of them."""
    bare = [f"requirements of {each.path}: {_BARE}" for each in subjects if not each.packages]
    computed = [line for each in subjects for line in _computed(each)]
    return msgspec.structs.replace(decided, not_asked=(*decided.not_asked, *bare, *computed))


def _computed(subject: Subject) -> Iterator[str]:
    """Requirements whose names are known when a program runs only."""
    found = [each for package in subject.packages for each in package.requires if each.certainty == "unknown"]
    if found:
        first = found[0].evidence[0]
        place = f"{first.path}:{first.line}"
        yield f"{len(found)} requirement(s) of {subject.path} with a computed name, the first in {place}"


_DECISIONS: Final[Mapping[str, Callable[[_Groups, Given, Dimensions], Report]]] = {
    "compose": _compose,
    "chain": _chain,
    "install": _install,
    "invoke": _invoke,
}
