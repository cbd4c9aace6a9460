"""LNT031: a service request is given a field that the service does not have."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.compiled import is_compiled
from ecm_extract.lint.near import nearest, slip
from ecm_extract.lint.requests import Touched, touched_fields
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.service_calls import ServiceCall
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT031",
    name="service_field_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="Python stops with AttributeError at the call, C++ does not compile",
    resolution="write a field of the service, or add it there",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report keywords of proxy calls, and members of request and response objects, that the definition lacks."""
    for call in workspace.service_calls:
        unknown = [name for name, _ in call.call.keywords if name and name not in call.fields]
        if unknown:
            yield _of_call(call, unknown)
    for touched in touched_fields(workspace.linker.program.files, workspace.packages):
        if touched.field not in touched.known:
            yield _of_member(touched, workspace)


def _of_call(call: ServiceCall, names: list[str]) -> Finding:
    """A call with several wrong fields is one finding; the near name is that of the first."""
    place = Evidence(call.file.path, call.line)
    if len(names) == 1:
        return _finding(call.service, names[0], call.fields, call.file.package, place)
    text = f"{call.service} has no fields {', '.join(names)}"
    return RULE.finding(text, Entity("message_field", f"{call.service}.{names[0]}"), call.file.package, [place])


def _of_member(touched: Touched, workspace: Workspace) -> Finding:
    place = Evidence(touched.file.path, touched.line)
    found = _finding(touched.service, touched.field, touched.fields, touched.file.package, place)
    if is_compiled(touched.file.path, workspace):
        return found
    return msgspec.structs.replace(found, severity="info", message=f"{found.message} (no target builds this file)")


def _finding(service: str, name: str, fields: tuple[str, ...], package: str, place: Evidence) -> Finding:
    near = nearest(name, fields)
    text = f"{service} has no field {name}" + (f"; it has {near}" if near else "")
    entity, edit = Entity("message_field", f"{service}.{name}", near or ""), slip(name, near)
    return RULE.finding(text, entity, package, [place], edit=edit)
