"""LNT043: a package builds programs, or holds launch files and what they name, and does not install them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity
from ecm_parsers.package_references import parse_references

from ecm_extract.entities.install_rules import (
    installed_targets,
    is_unread,
    lives_in_devel_space,
    may_install_file,
    may_install_target,
)
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.started import programs_started
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT043",
    name="not_installed",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="it is there where it was built and missing where the package is installed",
    resolution="add install(TARGETS ...), install(PROGRAMS ...) or install(DIRECTORY ...) to CMakeLists.txt",
    tier="stable",
)
_SHOWN = 5
_SHARE = "share"
_ROS_2 = 2
_DEVEL = "they run from the devel space of the machine that built them, and from nowhere else"
_NEVER_STARTS = "launch_ros finds no such program and stops the whole launch"
_NAMING = (".launch", ".launch.xml", ".xacro", ".urdf")
_BUILD = frozenset({"setup.py", "conf.py"})
_SCRIPTS = (".py", ".sh", ".bash")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what a CMake package leaves out of its install rules, once for programs, launch files and other files.

    A package of ROS 1 that installs nothing at all is meant to run from the devel space: that is said once, as an info.
    """
    launched = programs_started(workspace)
    named = _named(workspace)
    for package in workspace.packages:
        path = f"{package.root.path}/CMakeLists.txt".lstrip("/")
        is_python = bool(package.setups) and package.ros == _ROS_2
        if path not in package.cmake or package.root.rosbuild or is_python or is_unread(package):
            continue
        found = list(_left_out(package, path, launched.get(package.name, set()), named, workspace))
        yield from map(_never_installed, found[:1]) if lives_in_devel_space(package) else found


def _left_out(
    package: PackageFacts, path: str, started: set[str], named: dict[str, set[str]], workspace: Workspace
) -> Iterator[Finding]:
    scripts = _scripts(package, started) if not package.setups else set()  # setup.py may install some
    built = {name for name in _programs(package) if not may_install_target(name, package)}
    missing = sorted(built - installed_targets(package) | scripts)
    if missing:
        used = sorted(set(missing) & started)
        level: Severity = "error" if used and package.ros == _ROS_2 else "warning" if used else "info"
        yield _finding(package, path, "program", used or missing, level)
    files = sorted(_launch_files(package, workspace))
    described = sorted(_missing(_described(package), package))
    if described:
        yield _finding(package, path, "plugin description", described, "warning")
    others = sorted(_missing(named.get(package.name, set()), package))
    if files:
        yield _finding(package, path, "launch file", files, "warning")
    elif others:
        yield _finding(package, path, "file", others, "warning")


def _never_installed(found: Finding) -> Finding:
    """What is said instead of all that a package leaves out which lives in the devel space."""
    name = found.subjects[0]
    text, entity = f"{name} installs nothing at all", Entity("package", "devel space")
    return RULE.finding(text, entity, name, found.evidence, severity="info", consequence=_DEVEL)


def _named(workspace: Workspace) -> dict[str, set[str]]:
    """Files that launch files and descriptions name in the share folder of a package."""
    found: dict[str, set[str]] = {}
    for path in (*_naming(workspace), *workspace.beside.ending(*_NAMING)):
        read = workspace.beside.files.parsed(path, parse_references)
        for named in read.facts if read is not None else ():
            if PurePosixPath(named.path).suffix:
                found.setdefault(named.package, set()).add(named.path)
    return found


def _naming(workspace: Workspace) -> Iterator[str]:
    for package in workspace.packages:
        paths = (entry.path for entry in package.root.files if entry.path.endswith(_NAMING))
        old = _left_over(package, workspace)
        yield from (path for path in paths if path not in old and not is_test_path(path, package.root.path))


def _described(package: PackageFacts) -> set[str]:
    """Plugin descriptions that package.xml exports from where they are installed; in ROS 2 a command installs them."""
    root = f"{package.root.path}/" if package.root.path else ""
    return {path.removeprefix(root) for path in package.plugins} if package.ros == 1 else set()


def _missing(names: set[str], package: PackageFacts) -> set[str]:
    """Those of these files of a package that are there and that no rule installs."""
    root = f"{package.root.path}/" if package.root.path else ""
    there = {entry.path for entry in package.root.files}
    return {name for name in names if f"{root}{name}" in there and not _is_shared(f"{root}{name}", package)}


def _programs(package: PackageFacts) -> set[str]:
    """Names of the programs of a package; what is built of test code alone is none that others miss."""
    root, found = package.root.path, set[str]()
    for path, file in package.cmake.items():
        folder = f"{path.rpartition('/')[0]}/".lstrip("/")
        for target in file.targets if not is_test_path(path, root) else ():
            is_test = all(is_test_path(f"{folder}{source}", root) for source in target.sources) and target.sources
            if target.kind == "executable" and not target.is_test and not is_test:
                found.add(target.name)
    return found


def _scripts(package: PackageFacts, started: set[str]) -> set[str]:
    """Scripts that launch files start, or that have a #! line and are no module, and that no rule installs.

    A program goes by its name: where one of several files of a name is installed, it is there.
    """
    found, covered = set[str](), set[str]()
    for entry in package.root.files:
        folder, _, name = entry.path.rpartition("/")
        facts = package.sources.get(entry.path)
        is_program = facts is not None and bool(facts.shebang) and f"{folder}/__init__.py" not in package.sources
        is_program = is_program or (name in started and name.endswith(_SCRIPTS))
        if is_program and name not in _BUILD and not is_test_path(entry.path, package.root.path):
            is_covered = _is_covered(entry.path, package) or may_install_file(entry.path, package)
            (covered if is_covered else found).add(name)
    return found - covered


def _launch_files(package: PackageFacts, workspace: Workspace) -> set[str]:
    paths = sorted(workspace.launches.keys() - _left_over(package, workspace))
    own = [path for path in paths if workspace.package_of(path) == package.name and not _is_trial(path)]
    root = f"{package.root.path}/" if package.root.path else ""
    return {path.removeprefix(root) for path in own if not _is_shared(path, package)}


def _left_over(package: PackageFacts, workspace: Workspace) -> frozenset[str]:
    """Launch files of ROS 1, which nothing can load in a package of ROS 2."""
    old = (path for path, launch in workspace.launches.items() if launch.ros == 1)
    return frozenset(old) if package.ros == _ROS_2 else frozenset()


def _is_trial(path: str) -> bool:
    """Tell whether a launch file is for a trial beside the sources: by its name, or that of its folder."""
    parts = [part.partition(".")[0] for part in path.lower().split("/")]
    return ".test." in path or any(part.startswith("test") or part.endswith("_test") for part in parts)


def _is_shared(path: str, package: PackageFacts) -> bool:
    """Tell whether a rule puts a file into the share folder, or may do so by a name that only CMake knows."""
    return _is_covered(path, package) or may_install_file(path, package, _SHARE)


def _is_covered(path: str, package: PackageFacts) -> bool:
    for file, facts in package.cmake.items():
        folder = file.rpartition("/")[0]
        for install in facts.installs:
            for item in install.items if install.kind != "targets" else ():
                full = f"{folder}/{item}".strip("/").removesuffix("/.").removesuffix("/")
                if path == full or path.startswith(f"{full}/") or item in {".", "./", ""}:
                    return True
    return False


def _finding(package: PackageFacts, path: str, what: str, names: list[str], severity: Severity) -> Finding:
    shown = ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")
    text = f"{package.name} does not install its {what}{'s' if len(names) > 1 else ''} {shown}"
    line = next((target.line for target in package.cmake[path].targets if target.name in names), 1)
    entity = Entity("file", what, " ".join(names))
    evidence = [Evidence(path, line)]
    certainty: Certainty = "proved" if severity == "error" else "likely"
    consequence = _NEVER_STARTS if severity == "error" else ""
    return RULE.finding(
        text, entity, package.name, evidence, certainty=certainty, severity=severity, consequence=consequence
    )
