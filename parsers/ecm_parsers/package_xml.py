"""package.xml, formats 1 to 3 (REP 127, REP 140, REP 149) -> manifest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Literal

from lxml import etree

from ecm_parsers.condition import evaluate
from ecm_parsers.package_facts import (
    BuildType,
    Dependency,
    DependencyKind,
    Export,
    Manifest,
    PluginExport,
)
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.xml_tree import children, line_of, parse_xml, text_of

RosVersion = Literal[1, 2]
_ROS_VERSIONS: tuple[RosVersion, ...] = (1, 2)
_KINDS: Mapping[str, DependencyKind] = MappingProxyType(
    {
        "build_depend": "build",
        "build_export_depend": "build_export",
        "buildtool_depend": "buildtool",
        "buildtool_export_depend": "buildtool_export",
        "exec_depend": "exec",
        "run_depend": "run",
        "depend": "depend",
        "test_depend": "test",
        "doc_depend": "doc",
        "group_depend": "group_depend",
        "member_of_group": "member_of_group",
        "conflict": "conflict",
        "replace": "replace",
    }
)
_RELATIONS: Mapping[str, str] = MappingProxyType(
    {
        "version_lt": "<",
        "version_lte": "<=",
        "version_eq": "==",
        "version_gte": ">=",
        "version_gt": ">",
    }
)


def parse(data: bytes) -> Parsed[Manifest]:
    """Read one package.xml.

    Returns:
        The manifest, with an empty name when the file is none, and diagnostics.
    """
    tree = parse_xml(data)
    if tree.root is None:
        return Parsed(Manifest(""), tree.diagnostics)
    root = tree.root
    if root.tag != "package":
        message = f"The root is <{root.tag}>, not <package>. Check that this is a package manifest."
        problem = Diagnostic("error", "package-wrong-root", line_of(root), message)
        return Parsed(Manifest(""), (*tree.diagnostics, problem))
    manifest = _read_manifest(root)
    return Parsed(manifest, (*tree.diagnostics, *_check(manifest)))


def ros_versions(manifest: Manifest) -> frozenset[RosVersion]:
    """Return the ROS versions that a package builds for: its build tools under each `$ROS_VERSION`."""
    return frozenset(version for version in _ROS_VERSIONS if _builds_for(manifest, version))


def ros_version(manifest: Manifest) -> RosVersion | None:
    """Return the one ROS version that a package builds for; None for neither and for both."""
    versions = ros_versions(manifest)
    return next(iter(versions)) if len(versions) == 1 else None


def _builds_for(manifest: Manifest, version: RosVersion) -> bool:
    variables = {"ROS_VERSION": str(version)}
    tools = [item.name for item in manifest.build_types if evaluate(item.condition, variables)]
    if not any(name.startswith(("ament", "catkin")) for name in tools):
        tools += [
            item.name
            for item in manifest.dependencies
            if item.kind == "buildtool" and evaluate(item.condition, variables)
        ]
    prefix = "ament" if version == 2 else "catkin"
    return any(name.startswith(prefix) for name in tools)


def _read_manifest(root: etree._Element) -> Manifest:
    elements = list(children(root))
    first = dict(reversed(elements))
    exported = [child for tag, element in elements if tag == "export" for child in children(element)]
    name, version = first.get("name"), first.get("version")
    return Manifest(
        name="" if name is None else text_of(name),
        line=line_of(root if name is None else name),
        version=None if version is None else text_of(version),
        version_line=0 if version is None else line_of(version),
        format=_format(root),
        description=text_of(first["description"]) if "description" in first else "",
        maintainers=tuple(text_of(element) for tag, element in elements if tag == "maintainer"),
        licenses=tuple(text_of(element) for tag, element in elements if tag == "license"),
        dependencies=tuple(_dependencies(elements)),
        build_types=tuple(_build_type(element) for tag, element in exported if tag == "build_type"),
        exports=tuple(_export(tag, element) for tag, element in exported if _is_other(tag, element)),
        plugins=tuple(_plugin(tag, element) for tag, element in exported if "plugin" in element.attrib),
        deprecated=next((text_of(element) for tag, element in exported if tag == "deprecated"), None),
    )


def _format(root: etree._Element) -> int:
    written = str(root.get("format", "1")).strip()
    return int(written) if written in ("1", "2", "3") else 1


def _dependencies(elements: list[tuple[str, etree._Element]]) -> Iterator[Dependency]:
    for tag, element in elements:
        if tag in _KINDS:
            yield Dependency(
                name=text_of(element),
                kind=_KINDS[tag],
                line=line_of(element),
                versions=tuple(
                    (relation, str(element.attrib[key]))
                    for key, relation in _RELATIONS.items()
                    if key in element.attrib
                ),
                condition=_condition(element),
            )


def _build_type(element: etree._Element) -> BuildType:
    return BuildType(text_of(element), line_of(element), _condition(element))


def _is_other(tag: str, element: etree._Element) -> bool:
    return tag not in ("build_type", "deprecated") and "plugin" not in element.attrib


def _export(tag: str, element: etree._Element) -> Export:
    attributes = tuple((str(key), str(value)) for key, value in element.attrib.items() if key != "condition")
    return Export(tag, attributes, text_of(element), line_of(element), _condition(element))


def _plugin(tag: str, element: etree._Element) -> PluginExport:
    path = str(element.attrib["plugin"]).strip().replace("${prefix}", "").lstrip("/")
    return PluginExport(tag, path, line_of(element), _condition(element))


def _condition(element: etree._Element) -> str | None:
    condition = element.get("condition")
    return None if condition is None else str(condition)


def _conditional(manifest: Manifest) -> Iterator[tuple[int, str | None]]:
    """Yield line and condition of everything that may have one."""
    yield from ((item.line, item.condition) for item in manifest.dependencies)
    yield from ((item.line, item.condition) for item in manifest.build_types)
    yield from ((item.line, item.condition) for item in manifest.exports)
    yield from ((item.line, item.condition) for item in manifest.plugins)


def _check(manifest: Manifest) -> Iterator[Diagnostic]:
    if not manifest.name:
        yield Diagnostic("error", "package-no-name", manifest.line, "The package has no name. Add <name>.")
    if manifest.version is None:
        yield Diagnostic("warning", "package-no-version", 0, "The package has no version. Add <version>.")
    for line, condition in _conditional(manifest):
        if evaluate(condition, {}) is None:
            message = f"`{(condition or '')[:60]}` is no condition and never holds. See REP 149."
            yield Diagnostic("error", "package-bad-condition", line, message)
    for item in manifest.dependencies:
        if not item.name:
            yield Diagnostic("error", "package-empty-depend", item.line, "A dependency has no name. Remove it.")
