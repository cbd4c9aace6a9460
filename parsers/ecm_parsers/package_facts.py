"""What a package.xml declares."""

from __future__ import annotations

from typing import Literal

import msgspec

DependencyKind = Literal[
    "build",
    "build_export",
    "buildtool",
    "buildtool_export",
    "exec",
    "run",
    "depend",
    "test",
    "doc",
    "group_depend",
    "member_of_group",
    "conflict",
    "replace",
]


class Dependency(msgspec.Struct, frozen=True):
    """A dependency element.

    Attributes:
        name: of the package, rosdep key or group.
        kind: which element; `run` is of format 1 and stands for `build_export` and `exec`.
        line: 1-based.
        versions: (relation, version) pairs, e.g. (`>=`, `1.2.0`).
        condition: text of the condition; None when it always holds.
    """

    name: str
    kind: DependencyKind
    line: int
    versions: tuple[tuple[str, str], ...] = ()
    condition: str | None = None


class BuildType(msgspec.Struct, frozen=True):
    """An `<export><build_type>`."""

    name: str
    line: int
    condition: str | None = None


class Export(msgspec.Struct, frozen=True):
    """Any other element of `<export>`, e.g. `<rosdoc config="rosdoc.yaml"/>`, `<metapackage/>`."""

    tag: str
    attributes: tuple[tuple[str, str], ...]
    text: str
    line: int
    condition: str | None = None


class PluginExport(msgspec.Struct, frozen=True):
    """`<nav_core plugin="${prefix}/plugins.xml"/>`: a plugin description and the package of its base classes.

    `path` is relative to the package, without `${prefix}/`.
    """

    base_package: str
    path: str
    line: int
    condition: str | None = None


class Manifest(msgspec.Struct, frozen=True):
    """One package.xml.

    Attributes:
        name: empty when missing.
        line: 1-based line of the name.
        version: as written; None when missing.
        version_line: 1-based line of the version; 0 when missing.
        format: 1, 2 or 3.
        description: text with white space collapsed.
        maintainers: names only; addresses are not kept.
        licenses: as written.
        dependencies: in order of the file.
        build_types: usually at most one.
        exports: what `<export>` holds besides build types and plugin descriptions.
        plugins: plugin descriptions that it exports.
        deprecated: message of `<deprecated>`, empty for none given; None when the package is not deprecated.
    """

    name: str
    line: int = 0
    version: str | None = None
    version_line: int = 0
    format: int = 1
    description: str = ""
    maintainers: tuple[str, ...] = ()
    licenses: tuple[str, ...] = ()
    dependencies: tuple[Dependency, ...] = ()
    build_types: tuple[BuildType, ...] = ()
    exports: tuple[Export, ...] = ()
    plugins: tuple[PluginExport, ...] = ()
    deprecated: str | None = None
