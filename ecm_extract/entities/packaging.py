"""What a package as a whole offers: itself, executables, libraries, plugins, public headers."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from posixpath import dirname, join

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_parsers.cmake_facts import Install, Target

from ecm_extract.entities.build_conditions import build_conditions
from ecm_extract.entities.deprecations import deprecated_names
from ecm_extract.entities.install_rules import makes_package
from ecm_extract.entities.public_files import public_headers
from ecm_extract.entities.side_texts import SideTexts
from ecm_extract.read.facts import PackageFacts

_PYTHON = re.compile(r"python|(?:site|dist)-packages", re.IGNORECASE)
"""Where extension modules lie: Python imports them, nothing links with them."""


def packaging_entities(texts: SideTexts, facts: PackageFacts) -> Iterator[Provision]:
    """Yield the entities that build files and descriptions name."""
    yield from program_entities(facts)
    yield from _plugins(texts, facts)
    for path, include in public_headers(facts).items():
        yield Provision(kind="file", package=facts.name, owner="", name=include, path=path, line=1)


def program_entities(facts: PackageFacts) -> Iterator[Provision]:
    """Yield a package, what its build files make of it, and its scripts."""
    yield from _package(facts)
    yield from _targets(facts)
    yield from _scripts(facts)


def _package(facts: PackageFacts) -> Iterator[Provision]:
    if facts.root.manifest is not None:
        manifest = facts.manifest
        yield Provision(
            kind="package",
            package=facts.name,
            owner="",
            name=facts.name,
            deprecated=manifest.deprecated if manifest is not None else None,
            path=facts.root.manifest,
            line=manifest.line if manifest is not None else 1,
        )


def _targets(facts: PackageFacts) -> Iterator[Provision]:
    installs = [entry for file in facts.cmake.values() for entry in file.installs if entry.kind == "targets"]
    installed = {item for entry in installs for item in entry.items if not _PYTHON.search(entry.destination)}
    installed |= _handed_over(facts)
    for path, file in facts.cmake.items():
        for target in file.targets:
            if target.kind not in {"executable", "library"} or target.is_test or target.is_objects:
                continue
            if "$" in (target.output or target.name):
                continue
            if target.name in installed or _runs_where_built(target, facts):
                yield Provision(
                    kind=target.kind,
                    package=facts.name,
                    owner="",
                    name=target.output or target.name,
                    path=path,
                    line=target.line,
                    when=build_conditions((*target.conditions, *_installed_when(target, facts, installs))),
                )
        for component in file.components:
            if component.executable:
                yield Provision(
                    kind="executable",
                    package=facts.name,
                    owner="",
                    name=component.executable,
                    path=path,
                    line=component.line,
                )
            yield Provision(
                kind="plugin",
                package=facts.name,
                owner="",
                name=component.plugin_class,
                type="rclcpp_components",
                path=path,
                line=component.line,
            )


def _handed_over(facts: PackageFacts) -> set[str]:
    """What is given to commands of other packages where one of them is all that can make a package of it."""
    return set() if makes_package(facts) else {word for file in facts.cmake.values() for word in file.foreign}


def _installed_when(target: Target, facts: PackageFacts, installs: Sequence[Install]) -> tuple[str, ...]:
    """Conditions of the only rule that installs a target; of several one may hold where another does not."""
    found = [entry for entry in installs if target.name in entry.items]
    return found[0].conditions if len(found) == 1 and not _runs_where_built(target, facts) else ()


def _runs_where_built(target: Target, facts: PackageFacts) -> bool:
    """ROS 1 starts programs from where they are built (rosbuild, the devel space of catkin), installed or not."""
    return facts.ros == 1 and target.kind == "executable"


def _scripts(facts: PackageFacts) -> Iterator[Provision]:
    found: dict[str, list[_Script]] = defaultdict(list)
    for script in (*_cmake_programs(facts), *_setup_programs(facts)):
        found[script.name.rsplit("/", 1)[-1]].append(script)
    for name, scripts in found.items():
        if "$" not in name and "*" not in name:
            yield Provision(
                kind="executable",
                package=facts.name,
                owner="",
                name=name,
                path=scripts[0].path,
                line=scripts[0].line,
                when=build_conditions(scripts[0].conditions) if len(scripts) == 1 else (),
            )


class _Script(msgspec.Struct, frozen=True):
    """A script that is installed, where that is written, and under which conditions of the build."""

    name: str
    path: str
    line: int
    conditions: tuple[str, ...] = ()


def _cmake_programs(facts: PackageFacts) -> Iterator[_Script]:
    for path, file in facts.cmake.items():
        for entry in file.installs:
            if entry.kind in {"programs", "python"}:
                yield from (_Script(entry.renamed or item, path, entry.line, entry.conditions) for item in entry.items)


def _setup_programs(facts: PackageFacts) -> Iterator[_Script]:
    for path, setup in facts.setups.items():
        for point in setup.entry_points:
            if point.group == "console_scripts":
                yield _Script(point.name, path, point.line)
        yield from (_Script(script, path, 1) for script in setup.scripts)
        for rule in setup.data_files:
            if f"{rule.destination}/".startswith(f"lib/{facts.name}/"):
                yield from (_Script(file, path, rule.line) for file in _that_may_run(rule.files, dirname(path), facts))


def _that_may_run(files: Sequence[str], folder: str, facts: PackageFacts) -> Iterator[str]:
    """Files that are copied with their x bit: `ros2 run` finds these in folders below that of the package, too."""
    places = [join(folder, file) for file in files]
    for entry in facts.root.files:
        if entry.executable and any(_is_at(entry.path, place) for place in places):
            yield entry.path


def _is_at(path: str, place: str) -> bool:
    """Whether a path fits a pattern, in whose parts `*` stands for no slash."""
    return path.count("/") == place.count("/") and fnmatchcase(path, place)


def _plugins(texts: SideTexts, facts: PackageFacts) -> Iterator[Provision]:
    named = deprecated_names(texts.speaking, facts.sources) if facts.plugins else {}
    outdated = {name.replace("::", "/"): text for name, text in named.items()}
    for path, classes in facts.plugins.items():
        for entry in classes:
            yield Provision(
                kind="plugin",
                package=facts.name,
                owner="",
                name=entry.lookup_name,
                type=entry.base_class_type,
                deprecated=outdated.get(entry.lookup_name.replace("::", "/")),
                path=path,
                line=entry.line,
            )
