"""LNT032: a rospy service is called in a way that rospy refuses."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.requires.service_calls import ServiceCall

RULE = LintRule(
    id="LNT032",
    name="service_call_refused",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="rospy raises TypeError at the call and the service is never reached",
    resolution="give all fields by position, or each by its name",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report calls with positions and keywords at once, and with some of the fields by position."""
    for call, fields in workspace.service_calls:
        reason = _reason(call, fields)
        if reason:
            text = f"{call.proxy} calls {call.service} with {reason}"
            place = [Evidence(call.file.path, call.line)]
            yield RULE.finding(text, Entity("service", call.service, call.proxy), call.file.package, place)


def _reason(call: ServiceCall, fields: tuple[str, ...]) -> str:
    """One argument may be the whole request."""
    given, wanted = len(call.call.args), len(fields)
    if given and call.call.keywords:
        return "a position and a keyword at once"
    return f"{given} arguments, its request has {wanted} fields" if given > 1 and given != wanted else ""
