"""LNT058: a header is not installed where other packages look for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.entities.install_rules import InstallRule, install_rules, is_open, lives_in_devel_space, place_of
from ecm_extract.lint.beside import foreign_requirements
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT058",
    name="header_not_installed",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="packages that include it build beside its sources and not where it is installed",
    resolution="install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})",
)
_SHOWN = 3
_INCLUDES = "includes"


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report, once for a package, headers that are installed a folder too deep, and those that others include."""
    included = _included(workspace)
    for package in workspace.packages:
        if package.root.rosbuild or not package.cmake or is_open(package):
            continue
        if lives_in_devel_space(package):
            continue
        headers = _headers(package)
        rules = [rule for rule in install_rules(package) if rule.kind in {"DIRECTORY", "FILES"}]
        if not headers or any("$" in rule.destination for rule in rules):
            continue
        astray = {name: rule for name in headers if (rule := _astray(headers[name], name, rules, package)) is not None}
        lost = {name for name in headers if name in included and not _is_covered(headers[name], rules)}
        if astray:
            rule = next(iter(astray.values()))
            text = f"{package.name} installs {_shown(astray)} into {rule.destination}, where no #include finds it"
            twice = any(name.startswith(f"{package.name}/") or name in included for name in astray)
            places = [Evidence(rule.path, rule.line)]
            yield _finding(text, package, sorted(astray), places, "warning" if twice else "info")
        elif lost:
            users = [included[name] for name in sorted(lost) if included[name][0] != package.name]
            text = f"{package.name} does not install {_shown(lost)}, which {users[0][0]} includes" if users else ""
            place = Evidence(f"{package.root.path}/CMakeLists.txt".lstrip("/"), 1)
            if users:
                yield _finding(text, package, sorted(lost), [place, users[0][1]])


def _headers(package: PackageFacts) -> dict[str, str]:
    """Return the headers in folders below `include`, by the name in #include."""
    root = f"{package.root.path}/include/".lstrip("/")
    found = {path.removeprefix(root): path for path in package.sources if path.startswith(root)}
    return {name: path for name, path in found.items() if "/" in name}


def _included(workspace: Workspace) -> dict[str, tuple[str, Evidence]]:
    """Return what sources include that is a header of another package, with the first that does; own sources first."""
    owners = {name: package.name for package in workspace.packages for name in _headers(package)}
    found: dict[str, tuple[str, Evidence]] = {}
    for file in workspace.linker.program.files:
        for entry in file.facts.imports if file.language != "python" else ():
            if owners.get(entry.module, file.package) != file.package:
                found.setdefault(entry.module, (file.package, Evidence(file.path, entry.line)))
    for name, requirement in foreign_requirements(workspace.others, frozenset(workspace.by_name)):
        if requirement.use == _INCLUDES and requirement.name in owners:
            found.setdefault(requirement.name, (name, requirement.evidence[0]))
    return found


def _astray(path: str, name: str, rules: Sequence[InstallRule], package: PackageFacts) -> InstallRule | None:
    """The rule that puts a header where it is not looked for; None when another one, or none, puts it in its place."""
    places = {place: rule for rule in rules if (place := place_of(path, rule)) is not None}
    depths = {place.removesuffix(name).count("/") for place in places if place.endswith(f"/{name}")}
    below = {place: rule for place, rule in places.items() if place.startswith("include/")}
    return None if depths & ({1} if package.ros == 1 else {1, 2}) else next(iter(below.values()), None)


def _is_covered(path: str, rules: Sequence[InstallRule]) -> bool:
    return any(place_of(path, rule) is not None or "*" in " ".join(rule.items) for rule in rules)


def _shown(names: Mapping[str, object] | set[str]) -> str:
    ordered = sorted(names)
    more = f" and {len(ordered) - _SHOWN} more" if len(ordered) > _SHOWN else ""
    return ", ".join(ordered[:_SHOWN]) + more


def _finding(
    text: str, package: PackageFacts, names: list[str], evidence: list[Evidence], level: Severity = "warning"
) -> Finding:
    entity = Entity("file", "header", " ".join(names))
    return RULE.finding(text, entity, package.name, evidence, certainty="likely", severity=level)
