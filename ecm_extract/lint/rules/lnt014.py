"""LNT014: a parameter has a doubled namespace, or one parameter is read into several variables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.running import RunningEndpoint, RunningModule
from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.match import positions
from ecm_extract.link.declaring.site import Site
from ecm_extract.lint.either_side import on_either_side
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT014",
    name="parameter_name_slip",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="what a person sets under the expected name has no effect",
    resolution="write each name once",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report ROS 1 parameters `a/a/b`, and reads of one name into different variables of one function."""
    yield from _doubled(workspace)
    reads: dict[tuple[Func, str, str], dict[str, Site]] = {}
    for site in workspace.linker.parameter_sites:
        target = _variable(next(positions(site.form.out, site.call), None))
        handle = repr(site.call.receiver)
        for value in workspace.linker.sites.names.of(site):
            if target and value.confidence in {"literal", "folded"} and not site.chain:
                reads.setdefault((site.call.func, handle, value.text), {}).setdefault(target, site)
    for (func, _, name), targets in reads.items():
        met = [(target, site) for target, site in targets.items() if _meets_another(site, targets.values(), func)]
        if met:
            yield _several(name, met)


def _meets_another(site: Site, others: Iterable[Site], func: Func) -> bool:
    """Whether a run that has one read can have another one too."""
    flow, at = func.fact.flow, site.call.at
    return any(other is not site and not on_either_side(flow, at, other.call.at) for other in others)


def _doubled(workspace: Workspace) -> Iterator[Finding]:
    seen = set()
    for module in workspace.index.modules:
        for each in module.endpoints:
            twice = _twice(each, module)
            place = each.path, each.line
            if twice and place not in seen:
                seen.add(place)
                text = f"{each.name} holds {twice} twice"
                entity = Entity("parameter", each.name, owner=module.name)
                yield RULE.finding(text, entity, module.package, [Evidence(*place)], certainty="likely")


def _twice(parameter: RunningEndpoint, module: RunningModule) -> str:
    """The part that the name of a parameter of ROS 1 holds twice in a row; empty for none."""
    parts = [part for part in parameter.name.split("/") if part]
    is_ros1 = parameter.row.value and "/" in parameter.name
    if not is_ros1 or parts[:-1] == [module.node]:
        return ""  # a node may call a parameter as itself
    return next((one for one, two in pairwise(parts) if one == two and "{" not in one), "")


def _several(name: str, targets: list[tuple[str, Site]]) -> Finding:
    lines = [Evidence(site.call.func.file.path, site.call.line) for _, site in targets]
    text = f"{name} is read into {', '.join(variable for variable, _ in targets)}"
    package = targets[0][1].root.file.package
    return RULE.finding(text, Entity("parameter", name), package, lines, certainty="likely")


def _variable(expr: Expr | None) -> str:
    if isinstance(expr, Member):
        return f"{_variable(expr.base)}.{expr.name}"
    return expr.id if isinstance(expr, Name) else ""
