"""Files that are parts of programs: other packages start these, and neither link nor import what they are made of."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from posixpath import dirname, join, normpath
from typing import Final

from ecm_parsers.cmake_facts import Target
from ecm_parsers.source.facts import SourceFile

from ecm_extract.link.code.spelling import last_name
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included

_ROS_2: Final = 2
_EXPORTS: Final = ("ament_export_", "ament_auto_package")
"""How commands begin that tell others where things are (ament_cmake; what is depended on tells nothing)."""
_PROGRAMS: Final = frozenset({"programs", "python"})


def of_programs(facts: PackageFacts) -> frozenset[str]:
    """Return the headers of classes whose methods stand in sources that programs are built of, and no library.

    Where a package of ROS 2 builds nothing but programs, exports nothing and installs none, those are all its headers.
    """
    if _is_closed(facts):
        return frozenset(path for path in facts.sources if is_included(path))
    if not _builds_programs(facts) or _is_any_in_libraries(facts):
        return frozenset()
    linked = _library_sources(facts)
    homes: dict[str, set[bool]] = defaultdict(set)
    for path, source in facts.sources.items():
        if source.language == "cpp" and not is_included(path):
            for function in source.functions:
                if "declaration" not in function.traits:
                    homes[function.scope].add(path in linked or path.rpartition(".")[0] in linked)
    headers = ((path, source) for path, source in facts.sources.items() if is_included(path))
    return frozenset(path for path, source in headers if _places(source, homes) == {False})


def _places(source: SourceFile, homes: Mapping[str, set[bool]]) -> set[bool]:
    """Whether libraries have the methods of the classes of a header; empty where it has them itself.

    A source may leave out the namespace, behind a `using`.
    """
    names = (written for name in _classes(source) for written in {name, last_name(name)})
    return {linked for name in names for linked in homes.get(name, ())}


def _builds_programs(facts: PackageFacts) -> bool:
    return any(target.kind == "executable" and not target.is_test for target in _targets(facts))


def _is_closed(facts: PackageFacts) -> bool:
    """Whether nothing tells others of a package where its headers or libraries are: it is there to be started."""
    kinds = {target.kind for target in _targets(facts) if not target.is_test}
    names = {command.name for file in facts.cmake.values() for command in file.commands}
    known = not any(file.unknown or file.foreign for file in facts.cmake.values())
    told = any(name.startswith(_EXPORTS) for name in names - {"ament_export_dependencies"}) or _installs_headers(facts)
    return facts.ros == _ROS_2 and kinds == {"executable"} and known and not told


def _installs_headers(facts: PackageFacts) -> bool:
    installs = (install for file in facts.cmake.values() for install in file.installs)
    return any("include" in install.destination.lower() for install in installs)


def _is_any_in_libraries(facts: PackageFacts) -> bool:
    """Whether the sources of a library are not known, so that any may be of it."""
    libraries = [target for target in _targets(facts) if target.kind == "library"]
    return any(not target.sources or any(set("*$") & set(path) for path in target.sources) for target in libraries)


def _library_sources(facts: PackageFacts) -> frozenset[str]:
    """Paths of the sources of libraries; CMake lets people leave out their suffix."""
    return frozenset(
        normpath(f"{path.rpartition('/')[0]}/{source}".lstrip("/"))
        for path, file in facts.cmake.items()
        for target in file.targets
        if target.kind == "library"
        for source in target.sources
    )


def _targets(facts: PackageFacts) -> Iterator[Target]:
    return (target for file in facts.cmake.values() for target in file.targets)


def _classes(source: SourceFile) -> Iterator[str]:
    return (f"{entry.scope}::{entry.name}".lstrip(":") for entry in source.classes)


def script_modules(facts: PackageFacts, modules: Mapping[str, str]) -> frozenset[str]:
    """Return the dotted names of modules that are programs and that no other module of the package imports.

    Console scripts start them, or a rule installs their file as a program. `modules` are dotted names by path.
    """
    started = {
        point.module
        for setup in facts.setups.values()
        for point in setup.entry_points
        if point.group == "console_scripts" and point.attribute
    }
    started |= {modules[path] for path in _installed_programs(facts) if path in modules}
    return frozenset(module for module in started if not _is_imported(module, facts))


def _installed_programs(facts: PackageFacts) -> Iterator[str]:
    for path, file in facts.cmake.items():
        for rule in file.installs:
            if rule.kind in _PROGRAMS:
                yield from (normpath(join(dirname(path), item)) for item in rule.items)


def _is_imported(module: str, facts: PackageFacts) -> bool:
    """Whether a source of the package imports a module, by whatever path leads to it."""
    own = module.rpartition(".")[2]
    return any(
        own in (*entry.module.split("."), entry.name)
        for path, source in facts.sources.items()
        if source.language == "python" and not path.endswith(f"/{own}.py")
        for entry in source.imports
    )
