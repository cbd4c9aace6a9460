"""LNT060: a script is installed among the programs without the right to run it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.entities.install_rules import InstallRule, install_rules
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT060",
    name="script_not_executable",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="where the package is installed, rosrun and roslaunch find no program of that name",
    resolution="use install(PROGRAMS ...), catkin_install_python, or USE_SOURCE_PERMISSIONS",
)
_KEEPS = frozenset({"USE_SOURCE_PERMISSIONS", "FILE_PERMISSIONS", "PERMISSIONS"})
_SHOWN = 3


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report scripts with a #! line that a rule for files or folders puts where programs are looked for."""
    for package in workspace.packages:
        scripts = {path for path, facts in package.sources.items() if facts.shebang}
        if not scripts or package.root.rosbuild:
            continue
        rules = list(install_rules(package))
        kept = {
            path for rule in rules if rule.kind == "PROGRAMS" or rule.words & _KEEPS for path in _put(rule, scripts)
        }
        for rule in rules:
            lost = sorted(path for path in _put(rule, scripts) if path not in kept)
            if rule.kind in {"FILES", "DIRECTORY"} and rule.destination == f"lib/{package.name}" and lost:
                yield _finding(rule, lost, package)


def _put(rule: InstallRule, scripts: set[str]) -> set[str]:
    """Scripts that a rule installs."""
    items = {f"{rule.folder}{item}".rstrip("/") for item in rule.items}
    if rule.kind == "DIRECTORY":
        return {path for path in scripts if any(path.startswith(f"{item}/") for item in items)}
    return scripts & items


def _finding(rule: InstallRule, lost: list[str], package: PackageFacts) -> Finding:
    names = [path.rpartition("/")[2] for path in lost]
    shown = ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")
    text = f"{package.name} installs {shown} with install({rule.kind} ...), which takes the right to run away"
    entity = Entity("executable", " ".join(names))
    return RULE.finding(text, entity, package.name, [Evidence(rule.path, rule.line)], certainty="proved")
