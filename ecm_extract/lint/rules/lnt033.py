"""LNT033: a service is called by keywords, and one field of its request is left out."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT033",
    name="service_field_left_out",
    dimension="signature",
    severity="info",
    who="wire",
    consequence="the server gets zero, false or nothing for it",
    resolution="give the field, if only to say that its default is meant",
)
_ENOUGH = 2


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report calls that name most of the fields and forget one or two."""
    for call, fields in workspace.service_calls:
        given = {name for name, _ in call.call.keywords}
        missing = [name for name in fields if name not in given]
        if call.call.args or "" in given or not given <= set(fields) or not 0 < len(missing) <= len(given) // _ENOUGH:
            continue
        text = f"{call.proxy} calls {call.service} without {', '.join(missing)}"
        place = [Evidence(call.file.path, call.line)]
        entity = Entity("message_field", f"{call.service} {call.proxy}", " ".join(missing))
        yield RULE.finding(text, entity, call.file.package, place)
