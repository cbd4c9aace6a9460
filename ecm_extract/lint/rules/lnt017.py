"""LNT017: a message, service or action has a field of a type that its package, being in the tree, does not define."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Rename
from ecm_parsers.interface_facts import Field

from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt010 import ACTION_PARTS
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT017",
    name="field_type_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the interface package does not build, and nothing that uses it does",
    resolution="correct the type, or add the message",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report fields whose type names a package of the tree that has messages."""
    known = {
        package.name: {
            name
            for path in (*package.interfaces, *(entry.path for entry in package.root.files))
            for name in _messages(path)
        }
        for package in workspace.packages
        if package.interfaces
    }
    for package in workspace.packages:
        for path, definition in package.interfaces.items():
            for section in definition.sections:
                for field in section.fields:
                    yield from _of(field, path, package, known, set(workspace.by_name))


def _messages(path: str) -> list[str]:
    """The messages that a file defines; in ROS 1 an action is generated as seven."""
    stem, _, suffix = path.rpartition("/")[2].rpartition(".")
    if suffix == "action":
        return [f"{stem}{part}" for part in ACTION_PARTS]
    return [stem] if suffix in {"msg", "idl"} else []


def _of(
    field: Field, path: str, package: PackageFacts, known: dict[str, set[str]], present: set[str]
) -> Iterator[Finding]:
    bare = field.type.partition("[")[0].partition("<")[0]
    owner, _, name = bare.partition("/")
    name = name.rpartition("/")[2]
    own = known.get(owner, set())
    if not name or owner not in present or name in own:
        return
    near = nearest(name, own)
    elsewhere = next((other for other, names in known.items() if name in names), None)
    if owner not in known and elsewhere is None:
        return  # it may generate its messages
    better = f"{elsewhere}/{name}" if elsewhere else f"{owner}/{near}" if near else ""
    text = f"{owner} defines no message {name}" + (f"; there is {better}" if better else "")
    evidence = [Evidence(path, field.line)]
    hint = f"write {better}" if better else ""
    edit = Rename(name, better.partition("/")[2]) if better else None
    entity = Entity("message_field", bare, better)
    yield RULE.finding(text, entity, package.name, evidence, resolution=hint, edit=edit)
