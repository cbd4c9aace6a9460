"""LNT048: whoever reads any topic asks for more than some publishers of the workspace offer.

Source: ROS 2 documentation, "Quality of Service settings", compatibilities.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Final, NamedTuple

from ecm_checker.contract import Evidence, Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.running import RunningEndpoint
from ecm_parsers.source.expr import Call, Member
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions, last_of
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt008 import mismatch
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT048",
    name="generic_reader_strict",
    dimension="behavior",
    severity="warning",
    who="qos",
    consequence="of such a topic it gets nothing, and no error is shown",
    resolution="ask the graph for the policies of the publishers first, or let the user choose them",
)
_ANY: Final = re.compile(r"/?\{[^{}]*\}")
_POLICIES: Final = frozenset({"reliability", "durability"})
_ALL: Final = _POLICIES | {"history", "depth"}
_LOADERS: Final = frozenset(
    {"json.load", "yaml.full_load", "yaml.load", "yaml.load_all", "yaml.safe_load", "yaml.safe_load_all"}
)
"""How Python loads a file of lists; `json.loads` takes a message apart."""
_SETTERS: Final = _POLICIES | {"reliable", "best_effort", "transient_local", "durability_volatile"}
_GENERIC: Final = "create_generic_subscription"
"""rclcpp/create_generic_subscription.hpp: the type is a text."""
MAX_PLACES: Final = 3


class Reader(NamedTuple):
    """A subscription of a package to a topic whose name and type are known only when it runs."""

    package: str
    module: str
    interface: Interface


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each such reader once, with the publishers of other packages that offer less."""
    publishers = _by_package(workspace)
    for reader in _readers(workspace):
        weak: dict[str, list[tuple[RunningEndpoint, str]]] = {}
        for package, offers in sorted(publishers.items()):
            for offer in offers if package != reader.package else ():
                policy = mismatch(offer.qos, reader.interface.qos)
                if policy is not None:
                    weak.setdefault(package, []).append((offer, policy))
        if weak:
            yield _finding(reader, weak)


def _readers(workspace: Workspace) -> Iterator[Reader]:
    for entry in workspace.linked:
        for interface in entry.interfaces:
            generic = interface.type is None and _ANY.fullmatch(interface.name) is not None
            wide = generic and not _reads_lists(entry.module.package, workspace)
            if interface.row.reads and wide and _asks(interface) and _takes_any(interface, workspace):
                yield Reader(entry.module.package, entry.module.name, interface)


def _reads_lists(package: str, workspace: Workspace) -> bool:
    """Tell whether Python of a package loads YAML or JSON files: the topics may be those that a file lists."""
    program = workspace.linker.program
    files = (file for file in program.files if file.package == package and file.language == "python")
    return any(program.canonical(name, file) in _LOADERS for file in files for name in _calls(file))


def _calls(file: File) -> Iterator[str]:
    """The names of what a file calls, as written."""
    steps = (step for fact in file.facts.functions for step in fact.body)
    found = (expr for step in steps for expr, _ in expressions(step))
    return (dotted(expr.callee) or "" for expr in found if isinstance(expr, Call))


def _asks(interface: Interface) -> bool:
    """Tell whether the source says anything of the policies; a profile that is handed in says nothing."""
    return interface.qos is not None and set(interface.qos.defaulted) != _ALL


def _takes_any(interface: Interface, workspace: Workspace) -> bool:
    """Tell whether the type comes when it runs, not by a template, and no branch chooses the policies."""
    python = interface.evidence[0].path.endswith(".py")
    if not python and not any(
        _is_generic(step, at.line) for at in interface.evidence for step in _around(at, workspace)
    ):
        return False
    return not any(_chooses(step) for at in interface.evidence for step in _around(at, workspace))


def _around(place: Evidence, workspace: Workspace) -> Iterator[Statement]:
    """The statements of the functions around a place."""
    for file in (each for each in workspace.linker.program.files if each.path == place.path):
        for fact in file.facts.functions:
            yield from fact.body if fact.line <= place.line <= fact.end_line else ()


def _is_generic(statement: Statement, line: int) -> bool:
    """Tell whether a statement calls on a line what makes a subscription of any type."""
    called = (each.callee for each, _ in expressions(statement) if isinstance(each, Call) and each.line == line)
    return any(last_of(each) == _GENERIC for each in called)


def _chooses(statement: Statement) -> bool:
    """`if (...) { qos.best_effort(); }` and `qos.reliability = ...` below a condition."""
    value, target = statement.value, statement.target
    called = value.callee.name if isinstance(value, Call) and isinstance(value.callee, Member) else ""
    written = target.name if isinstance(target, Member) else ""
    return statement.depth > 0 and (called in _SETTERS or written in _POLICIES)


def _by_package(workspace: Workspace) -> dict[str, list[RunningEndpoint]]:
    found: dict[str, list[RunningEndpoint]] = {}
    for module in workspace.index.modules:
        known = [each for each in module.endpoints if each.row.writes and "{" not in each.name and each.qos]
        found.setdefault(module.package, []).extend(known)
    return found


def _finding(reader: Reader, weak: Mapping[str, Sequence[tuple[RunningEndpoint, str]]]) -> Finding:
    package, found = next(iter(weak.items()))
    offer, policy = found[0]
    asked, given = getattr(reader.interface.qos, policy), getattr(offer.qos, policy)
    text = (
        f"{reader.module} subscribes to any topic with {policy} {asked}, "
        f"and {package} publishes {offer.name} with {given}"
    )
    if len(weak) > 1:
        text += f" ({len(weak) - 1} more packages do so)" if len(weak) > 2 else " (1 more package does so)"
    places = [Evidence(entry.path, entry.line) for offers in weak.values() for entry, _ in offers]
    evidence = [*reader.interface.evidence[:MAX_PLACES], *places[:MAX_PLACES]]
    entity = Entity("topic", reader.interface.name, package)
    return RULE.finding(text, entity, reader.package, evidence, certainty="likely")
