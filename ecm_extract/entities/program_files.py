"""Files that are parts of programs: other packages start these, and neither link nor import what they are made of."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.facts import PackageFacts

_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".ipp", ".tpp")


def of_programs(facts: PackageFacts) -> frozenset[str]:
    """Return the headers of classes whose methods stand in sources of a package that builds programs, no library."""
    kinds = {target.kind for file in facts.cmake.values() for target in file.targets if not target.is_test}
    if "executable" not in kinds or not kinds.isdisjoint({"library", "interface"}):
        return frozenset()
    defined = {
        function.scope
        for path, source in facts.sources.items()
        if source.language == "cpp" and not path.endswith(_HEADERS)
        for function in source.functions
        if "declaration" not in function.traits
    }
    headers = ((path, source) for path, source in facts.sources.items() if path.endswith(_HEADERS))
    return frozenset(path for path, source in headers if not defined.isdisjoint(_classes(source)))


def _classes(source: SourceFile) -> Iterator[str]:
    return (f"{entry.scope}::{entry.name}".lstrip(":") for entry in source.classes)


def script_modules(facts: PackageFacts) -> frozenset[str]:
    """Return the dotted names of modules that console scripts start and that no other module of the package imports."""
    started = {
        point.module
        for setup in facts.setups.values()
        for point in setup.entry_points
        if point.group == "console_scripts" and point.attribute
    }
    return frozenset(module for module in started if not _is_imported(module, facts))


def _is_imported(module: str, facts: PackageFacts) -> bool:
    """Whether a source of the package imports a module, by whatever path leads to it."""
    own = module.rpartition(".")[2]
    return any(
        own in (*entry.module.split("."), entry.name)
        for path, source in facts.sources.items()
        if source.language == "python" and not path.endswith(f"/{own}.py")
        for entry in source.imports
    )
