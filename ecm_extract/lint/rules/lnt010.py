"""LNT010: source imports or includes a message type that its package, being in the tree, does not define."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Rename
from ecm_parsers.source.facts import Import

from ecm_extract.link.units import File
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT010",
    name="interface_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the module cannot be imported or compiled, and its node never starts",
    resolution="correct the name, or add the interface file",
)
_KINDS = {"msg": ("",), "srv": ("", "Request", "Response", "_Request", "_Response"), "action": ("",)}
ACTION_PARTS = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
_PYTHON = re.compile(r"(\w+)\.(msg|srv|action)")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report Python imports of interfaces that the tree would hold if they existed."""
    known = _known(workspace)
    for file in workspace.linker.program.files:
        if file.language != "python":
            continue
        for entry in file.facts.imports:
            match = _PYTHON.fullmatch(entry.module)
            if match is not None and match[1] in known:
                yield from _missing(file, entry, match, known[match[1]])


def _known(workspace: Workspace) -> dict[str, set[str]]:
    """Return names of importable interfaces, by package of the tree that has any."""
    found: dict[str, set[str]] = {}
    for package in workspace.packages:
        for path, definition in package.interfaces.items():
            stem = path.rpartition("/")[2].rpartition(".")[0]
            names = found.setdefault(package.name, set())
            names |= {f"{definition.shape}.{stem}{suffix}" for suffix in _KINDS[definition.shape]}
            if definition.shape == "action":
                names |= {f"msg.{stem}{part}" for part in ACTION_PARTS}
        if package.name in found:
            found[package.name] |= set(_listed(package))
    return found


def _listed(package: PackageFacts) -> Iterator[str]:
    """What a build file lists: the build may make a definition that is not in the tree."""
    for file in package.cmake.values():
        for entry in file.interfaces:
            stem = entry.path.rpartition("/")[2].rpartition(".")[0]
            yield from (f"{entry.kind}.{stem}{suffix}" for suffix in _KINDS.get(entry.kind, ()))


def _missing(file: File, entry: Import, match: re.Match[str], known: set[str]) -> Iterator[Finding]:
    package, kind, name = match[1], match[2], entry.name
    if not name or name == "*" or f"{kind}.{name}" in known or name.startswith("_"):
        return
    near = nearest(name, [each.partition(".")[2] for each in known if each.startswith(f"{kind}.")])
    text = f"{package} has no {kind}/{name}" + (f"; it has {near}" if near else "")
    evidence = [Evidence(file.path, entry.line)]
    entity = Entity("message", f"{package}/{kind}/{name}", near or "")
    yield RULE.finding(text, entity, file.package, evidence, edit=Rename(name, near) if near else None)
