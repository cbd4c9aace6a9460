"""LNT053: publishers keep their last message for who comes late, and a subscriber does not ask for it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Final, NamedTuple

from ecm_checker.contract import Evidence, Qos
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import roles
from ecm_checker.hub.running import RunningEndpoint, RunningModule

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of

RULE = LintRule(
    id="LNT053",
    name="late_reader_volatile",
    dimension="behavior",
    severity="warning",
    who="qos",
    consequence="started after the publisher, it gets nothing until the next message, which may never come",
    resolution="subscribe with durability transient_local, as the publisher offers it",
)


_ROS2: Final = 2


class _End(NamedTuple):
    """One end of a topic: who has it, with which profile, and the line."""

    role: str
    owner: str
    qos: Qos
    place: Evidence


_Topics = dict[tuple[str, str | None], list[_End]]


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report subscribers by absolute names in the sources, and by what launch files start, each line once."""
    seen = set()
    for topics in (_written(workspace), *_launched(workspace)):
        for (name, _), ends in sorted(topics.items(), key=str):
            writers = [end for end in ends if roles()[end.role].writes]
            if not writers or not all(_keeps(end.qos) for end in writers):
                continue
            for end in ends:
                late = roles()[end.role].reads and end.owner not in {writer.owner for writer in writers}
                if late and end.qos.durability == "volatile" and end.place not in seen:
                    seen.add(end.place)
                    text = f"{end.owner} reads {name} without what was sent before, and {writers[0].owner} keeps it"
                    entity = Entity("qos", f"{name} durability", end.owner)
                    package = workspace.package_of(end.place.path)
                    evidence = [end.place, writers[0].place]
                    yield RULE.finding(text, entity, package, evidence, certainty="likely")


def _keeps(qos: Qos) -> bool:
    return qos.durability == "transient_local" and "durability" not in qos.defaulted


def _written(workspace: Workspace) -> _Topics:
    """What no launch file can separate: names with a leading slash."""
    topics: _Topics = defaultdict(list)
    for entry in workspace.linked:
        package = workspace.by_name.get(entry.module.package)
        for line in entry.lines if package is not None and package.ros == 2 else ():
            if line.qos is not None and line.raw_name.startswith("/") and line.confidence != "pattern":
                end = _End(line.role, entry.module.name, line.qos, line.evidence[-1])
                topics[line.name, line.type].append(end)
    for module, each in _of_documents(workspace):
        if each.qos is not None and each.raw_name.startswith("/") and "{" not in each.name:
            end = _End(each.role, module.name, each.qos, Evidence(each.path, each.line))
            topics[each.name, each.type].append(end)
    return topics


def _of_documents(workspace: Workspace) -> Iterator[tuple[RunningModule, RunningEndpoint]]:
    """What runs of packages of ROS 2 that only documents tell of."""
    for module in workspace.index.modules:
        if module.package not in workspace.by_name and workspace.ros_of(module.package) == _ROS2:
            yield from ((module, each) for each in module.endpoints)


def _launched(workspace: Workspace) -> Iterator[_Topics]:
    for system in workspace.systems:
        topics: _Topics = defaultdict(list)
        for node in system.nodes:
            for entry in node.endpoints if node.instance.ros == 2 else ():
                if entry.qos is not None and entry.known:
                    end = _End(entry.role, entry.node, entry.qos, evidence_of(entry.place))
                    topics[entry.name, entry.type].append(end)
        yield topics
