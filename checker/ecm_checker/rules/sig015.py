"""A launch file names something of a node absolutely, where the node itself has a relative name."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.launch_names import first_part, is_below, launched, required
from ecm_checker.match.packages import Packages
from ecm_checker.package_said import package_said
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG015",
    name="absolute_name_of_node",
    dimension="signature",
    severity="warning",
    who="graph",
    part_of=("SigMatch",),
    consequence="started in a namespace, for a second robot, the two no longer meet",
    resolution="leave the leading / out",
)
_ALONE: Severity = "info"
"""A file that nobody includes chooses its own namespace; who includes one may put it into another."""


def check(case: Case) -> Iterator[Finding]:
    """Targets of remaps and containers, each line once."""
    seen: set[tuple[Evidence, ...]] = set()
    for side in (case.packages, case.started):
        if side is None:
            continue
        nodes = {node.name: node for node in launched(side) if not node.name.startswith("/")}
        for package, wanted in required(side, *(_USES if side is case.packages else _LOADING)):
            node = nodes.get(first_part(wanted.target))
            if node is None or not _reaches(wanted) or wanted.evidence in seen:
                continue
            if not _is_told(node, wanted, side):
                seen.add(wanted.evidence)
                yield _finding(package, wanted, node, _level(wanted, case))


_LOADING = ("loads_into",)
_USES = ("remaps", *_LOADING)
"""What a launch evaluates of a remap may be given by the person who starts it, who knows the namespace."""


def _reaches(wanted: Requirement) -> bool:
    return wanted.use in _LOADING or is_below(wanted.target)


def _is_told(node: Provision, wanted: Requirement, side: Packages) -> bool:
    """Whether the node's own program is told to use the name: then both sides say the same."""
    if wanted.use in _LOADING:
        return False
    remaps = (remap for _, remap in required(side, "remaps") if remap.target == wanted.target)
    return any(remap.package is not None and _is_of(remap.package, node) for remap in remaps)


def _is_of(package: str, node: Provision) -> bool:
    return any(base.replace("::", "/").partition("/")[0] == package for base in node.bases)


def _level(wanted: Requirement, case: Case) -> Severity | None:
    name = wanted.evidence[0].path.rpartition("/")[2]
    sides = [side for side in (case.packages, case.started) if side is not None]
    included = any(each.name == name for side in sides for _, each in required(side, "includes_launch"))
    return None if included else _ALONE


def _finding(package: str, wanted: Requirement, node: Provision, level: Severity | None) -> Finding:
    said = package_said(
        text=f"{wanted.target} is absolute, and the node {node.name} is started by a relative name",
        entity=Entity("node", node.name, wanted.target),
        packages=(node.package, package),
        evidence=(*wanted.evidence, Evidence(node.path, node.line)),
        severity=level,
    )
    return RULE.found(said)
