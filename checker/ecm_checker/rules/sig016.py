"""A node is told to use a name below another node, which is started in a namespace only."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.launch_names import first_part, is_below, launched, required
from ecm_checker.match.packages import Packages
from ecm_checker.package_said import package_said
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="SIG016",
    name="node_in_other_namespace",
    dimension="signature",
    severity="warning",
    who="graph",
    part_of=("SigMatch",),
    consequence="the two sides never meet, without an error",
    resolution="put both into one namespace, or name the whole path",
)


def check(case: Case) -> Iterator[Finding]:
    """Remaps to `/arm/state` where nothing is called `/arm`, something `/robot/arm`, and nobody else uses the name."""
    if case.started is None:
        return
    nodes = _nodes(case.started)
    tops = {name.lstrip("/").partition("/")[0] for places in nodes.values() for name in places}
    users = _users(case, case.started)
    modules = {module.id: module for module in case.modules}
    for _, wanted in required(case.started, "remaps"):
        first = first_part(wanted.target)
        if not is_below(wanted.target) or first in tops or users[wanted.target] - {wanted.by}:
            continue
        places = [node for name, node in nodes.get(first, {}).items() if _may_have(name, wanted.target, modules)]
        if places:
            yield _finding(wanted, places)


def _nodes(started: Packages) -> Mapping[str, Mapping[str, Provision]]:
    """Nodes by the last part of their name, then by the whole."""
    found: defaultdict[str, dict[str, Provision]] = defaultdict(dict)
    for node in launched(started):
        full = f"/{node.name.lstrip('/')}"
        found[full.rpartition("/")[2]].setdefault(full, node)
    return found


def _users(case: Case, started: Packages) -> Mapping[str, set[str]]:
    """Who uses a name, by itself or by a remap."""
    found: defaultdict[str, set[str]] = defaultdict(set)
    for module in case.modules:
        for entry in module.contract.signature.interfaces:
            found[entry.name].add(f"node {module.id}")
    for _, remap in required(started, "remaps"):
        found[remap.target].add(remap.by)
    return found


def _may_have(node: str, name: str, modules: Mapping[str, View]) -> bool:
    """Whether a node has that name below itself or its namespace, or its code is not known."""
    module = modules.get(node)
    entries = module.contract.signature.interfaces if module is not None else ()
    tail = name.split("/", 2)[2]
    own = {f"{node}/{tail}", f"{node.rpartition('/')[0]}/{tail}"}
    return not entries or any(own & {entry.name, entry.raw_name} for entry in entries)


def _finding(wanted: Requirement, places: Sequence[Provision]) -> Finding:
    node = places[0]
    text = f"{wanted.target} is a name of the node /{first_part(wanted.target)}, and only {node.name} is started"
    said = package_said(
        text=text,
        entity=Entity("remap", wanted.target, node.name),
        packages=filter(None, (*node.bases[:1], wanted.package)),
        evidence=(*wanted.evidence, Evidence(node.path, node.line)),
    )
    return RULE.found(said)
