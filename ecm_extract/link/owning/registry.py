"""What build files and registration macros say: plugins, components, programs, libraries."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatch
from pathlib import PurePosixPath

from ecm_checker.match.generated import snake
from ecm_parsers.cmake_facts import Target

from ecm_extract.cmake.sources import paths_of
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.module_kinds import class_kind
from ecm_extract.link.index.program import Program
from ecm_extract.link.owning.modules import Registry, registration_kind
from ecm_extract.link.owning.wrapper_scripts import Wrapped, runs_as_main
from ecm_extract.read.facts import PackageFacts

_TEMPLATE = re.compile(r"<([\w:\s]+)>")


def build_registry(program: Program, packages: Iterable[PackageFacts]) -> Registry:
    """Collect the registrations of all packages."""
    registry = Registry()
    by_package: dict[str, list[File]] = {}
    for file in program.files:
        by_package.setdefault(file.package, []).append(file)
        _macros(file, program, registry)
    for package in packages:
        files = by_package.get(package.name, [])
        _plugins(package, files, program, registry)
        _components(package, files, program, registry)
        _targets(package, {file.path for file in files}, registry)
        _programs(package, files, program, registry)
    return registry


def plugins_of(program: Program, registry: Registry) -> list[Cls]:
    """Return the classes that a loader makes by the name of a configuration, and that are no nodes."""
    classes = (cls for group in program.classes.values() for cls in group)
    return [cls for cls in classes if registry.classes.get(cls) == "plugin"]


def _macros(file: File, program: Program, registry: Registry) -> None:
    for macro in file.facts.macros:
        kind = registration_kind(macro.name)
        if kind is None:
            continue
        for arg in macro.args:
            cls = program.class_named(plain(arg), file, macro.scope)
            if cls is not None:
                _register(_namesake(cls, program), kind, registry)
                break


def _register(cls: Cls, kind: str, registry: Registry) -> None:
    registry.classes.setdefault(cls, kind)


def _plugins(package: PackageFacts, files: list[File], program: Program, registry: Registry) -> None:
    for classes in package.plugins.values():
        for entry in classes:
            cls = plugin_class(entry.type, files, program)
            if cls is not None:
                nodelet = "odelet" in entry.base_class_type
                _register(cls, "nodelet" if nodelet else "plugin", registry)
                registry.names.setdefault(cls, snake(cls.fact.name))
                registry.lookups.setdefault(entry.lookup_name, cls)


def plugin_class(written: str, files: list[File], program: Program) -> Cls | None:
    """Return the class that a plugin description names; of a factory template, the class that it makes."""
    inner = _TEMPLATE.search(written)
    made = _class_of(inner[1], files, program) if inner is not None else None
    return made or _class_of(written, files, program)


def _components(package: PackageFacts, files: list[File], program: Program, registry: Registry) -> None:
    for file in package.cmake.values():
        for entry in file.components:
            cls = _class_of(entry.plugin_class, files, program)
            if cls is not None:
                _register(cls, "component", registry)
                if entry.executable:
                    registry.names[cls] = entry.executable


def _class_of(written: str, files: list[File], program: Program) -> Cls | None:
    """Return the class of a package that its build names; None where several may be meant."""
    name = plain(written)
    own = [cls for cls in program.classes.get(name.rsplit("::", 1)[-1], ()) if cls.file in files]
    exact = [cls for cls in own if cls.qualified == name]
    found = exact or [cls for cls in own if cls.qualified.endswith(f"::{name}")]
    loaded = [cls for cls in found if class_kind(cls, program) is not None] or found
    built = [cls for cls in loaded if cls.file.is_built] or loaded
    return built[0] if len(built) == 1 else None


def _namesake(cls: Cls, program: Program) -> Cls:
    """Return the class that can be loaded, where another one of the package has the same name."""
    if class_kind(cls, program) is not None:
        return cls
    same = (each for each in program.classes.get(cls.fact.name, ()) if each.qualified == cls.qualified)
    known = (each for each in same if each.file.package == cls.file.package and class_kind(each, program) is not None)
    return next(known, cls)


def _targets(package: PackageFacts, listed: set[str], registry: Registry) -> None:
    every = [target for file in package.cmake.values() for target in file.targets]
    libraries = {target.name for target in every if target.kind == "library"}
    registry.starting[package.name] = {target.name for target in every} - libraries
    for path, file in package.cmake.items():
        for target in file.targets:
            if target.kind == "library":
                for source in _sources(target, path, listed):
                    registry.libraries.setdefault(source, target.name)


def _sources(target: Target, cmake: str, listed: set[str]) -> Iterator[str]:
    """Yield the files of a target: names without a suffix are tried as CMake does, patterns are expanded."""
    for path in paths_of(target, cmake):
        if path in listed:
            yield path
        elif "*" in path:
            yield from sorted(entry for entry in listed if fnmatch(entry, path))


def _programs(package: PackageFacts, files: list[File], program: Program, registry: Registry) -> None:
    builds = _executables(package, {file.path for file in files})
    names = {path: next(iter(found.values())) for path, found in builds.items()}
    entries = _entry_points(package, files, program)
    started = Wrapped(program)
    for file in files:
        for func in _mains(file, program, entries) if file.is_built else ():
            if (file, func.fact.name) in entries or not started.by_script(func):
                registry.programs[func] = names.get(file.path) or _program_name(func, entries)
                if len(builds.get(file.path, ())) > 1:
                    registry.builds[func] = builds[file.path]


def _program_name(func: Func, entries: Mapping[tuple[File, str], str]) -> str:
    """The console script that runs a function, or the file that holds it; a file with one console script is that."""
    stem = PurePosixPath(func.file.path).stem
    own = {name for (file, _), name in entries.items() if file is func.file}
    only = next(iter(own)) if len(own) == 1 and func.fact.name == "<module>" else stem
    return entries.get((func.file, func.fact.name)) or only


def _executables(package: PackageFacts, listed: set[str]) -> Mapping[str, Mapping[str, str]]:
    """Source -> the targets of executables that compile it -> what they are called when they are built."""
    found: dict[str, dict[str, str]] = defaultdict(dict)
    for path, file in package.cmake.items():
        for target in file.targets:
            if target.kind == "executable":
                for source in _sources(target, path, listed):
                    found[source].setdefault(target.name, target.output or target.name)
    return found


_Entries = Mapping[tuple[File, str], str]
"""File and function -> name of the program that runs it."""


def _entry_points(package: PackageFacts, files: list[File], program: Program) -> _Entries:
    found = {}
    for setup in package.setups.values():
        for entry in setup.entry_points if package.sources else ():
            file = _module(entry.module, package.name, files, program)
            if entry.group == "console_scripts" and file is not None:
                found[file, entry.attribute] = entry.name
    return found


def _module(dotted: str, package: str, files: list[File], program: Program) -> File | None:
    """Return the file of an installed module; where the build does not show it, the only one with such a path."""
    installed = program.installed_module(dotted, package)
    if installed is not None:
        return installed
    path = f"/{dotted.replace('.', '/')}.py"
    named = [file for file in files if f"/{file.path}".endswith(path)]
    return named[0] if len(named) == 1 else None


def _mains(file: File, program: Program, entries: _Entries) -> list[Func]:
    """Main functions of a file: `main`, what an entry point names, and the body of a Python program."""
    wanted = {"main", *(attribute for module, attribute in entries if module is file)}
    own = program.functions_in(file)
    found = [func for func in own if func.fact.name in wanted and func.cls is None]
    if file.language == "python":
        body = [func for func in own if func.fact.name == "<module>"]
        found += [func for func in body if file.facts.shebang or found or runs_as_main(func)]
    return found
