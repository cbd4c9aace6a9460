"""What a CMakeLists.txt states about a package."""

from __future__ import annotations

from typing import Final, Literal

import msgspec

TargetKind = Literal["executable", "library", "interface", "test"]
InstallKind = Literal["targets", "programs", "directory", "files", "python"]
InterfaceKind = Literal["msg", "srv", "action", "idl", "other"]


REFUSED: Final = frozenset({"cmake-syntax", "cmake-unclosed", "cmake-unbalanced"})
"""Codes of what CMake stops at."""


class Target(msgspec.Struct, frozen=True):
    """Something that is built.

    Attributes:
        name: folded; a part that is not known stays `${NAME}`.
        kind: `test` is a program of a test framework; an ordinary target below BUILD_TESTING keeps its kind.
        line: 1-based.
        sources: paths relative to the file's folder, patterns (`src/*.cpp`), or names without a suffix (CMake tries
            .cpp and others), all that builds may have; generated and unknown ones stay references.
        links: libraries and packages it is linked with.
        is_test: whether it is built only with tests.
        output: OUTPUT_NAME, the name of the file that is built where it is not that of the target; else empty.
        conditions: under which it is built, as written; those that are decided are left out.
        by_default: whether a build without settings of its own builds it; None where that is not known.
        is_shared: whether a library is a file of its own that programs load; None where that is not known.
        is_objects: whether a library is no file at all, only objects that other targets of its build take.
        include_folders: in which its headers are looked for, relative as the sources.
        optional: the sources that such a build does not have. is_open: whether it may have others.
    """

    name: str
    kind: TargetKind
    line: int
    sources: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    is_test: bool = False
    output: str = ""
    conditions: tuple[str, ...] = ()
    by_default: bool | None = True
    optional: tuple[str, ...] = ()
    is_open: bool = False
    is_shared: bool | None = False
    is_objects: bool = False
    include_folders: tuple[str, ...] = ()


class Component(msgspec.Struct, frozen=True):
    """An rclcpp component: its class, the library that holds it, the executable made for it (if any)."""

    plugin_class: str
    library: str
    line: int
    executable: str | None = None


class PluginDescription(msgspec.Struct, frozen=True):
    """A pluginlib description exported to `base_package`; path relative to the file's folder."""

    base_package: str
    path: str
    line: int


class ParameterLibrary(msgspec.Struct, frozen=True):
    """A `generate_parameter_library` target (or Python module) and its YAML file."""

    target: str
    path: str
    line: int
    is_python: bool = False


class FileReference(msgspec.Struct, frozen=True):
    """A path, or pattern, relative to the file's folder."""

    path: str
    line: int


class InterfaceFile(msgspec.Struct, frozen=True):
    """An interface file, or pattern, that is generated from."""

    path: str
    kind: InterfaceKind
    line: int


class Install(msgspec.Struct, frozen=True):
    """What is installed where.

    Attributes:
        items: targets, or paths relative to the file's folder; of a folder that ends in `/` only the content.
        destination: below the folder of installation; what is not known stays a reference.
        words: keywords of the rule. renamed: what RENAME calls the only item, or empty.
        conditions, by_default: as of a target.
    """

    kind: InstallKind
    items: tuple[str, ...]
    destination: str
    line: int
    words: tuple[str, ...] = ()
    renamed: str = ""
    conditions: tuple[str, ...] = ()
    by_default: bool | None = True


class Dependency(msgspec.Struct, frozen=True):
    """A package that is searched for; catkin `COMPONENTS` are packages too."""

    name: str
    line: int
    is_test: bool = False


class Subdirectory(msgspec.Struct, frozen=True):
    """A folder whose CMakeLists.txt runs here, or (`is_include`) a .cmake file or module included here."""

    path: str
    line: int
    is_test: bool = False
    is_include: bool = False


class Option(msgspec.Struct, frozen=True):
    """A build option with its default as written."""

    name: str
    default: str
    line: int


class Command(msgspec.Struct, frozen=True):
    """A command that runs, with its arguments as evaluated; `line` is that of the file, of the call of a function.

    What is not known of an argument is a reference, a path of the tree starts from the folder of the file.
    """

    name: str
    args: tuple[str, ...]
    line: int
    is_test: bool = False


class Unknown(msgspec.Struct, frozen=True):
    """What may build more than is known, with the reason."""

    line: int
    reason: str


class CmakeFile(msgspec.Struct, frozen=True):
    """All facts of one file.

    Attributes:
        project: name given to `project()`, None in a subdirectory's file.
        version: of the project.
        line: of `project()`, else 0.
        gpu: names of CUDA or TensorRT that the file asks for, with their lines.
        python_packages: what `ament_python_install_package` names; `.` for `catkin_python_setup`.
        commands: that run, but those that only set variables.
        unknown: places that may build more than is known.
        foreign: words given to commands of other packages, which may make targets of these names.
        malformed: whether CMake refuses the file.
    """

    project: str | None = None
    version: str | None = None
    line: int = 0
    targets: tuple[Target, ...] = ()
    components: tuple[Component, ...] = ()
    plugin_descriptions: tuple[PluginDescription, ...] = ()
    parameter_libraries: tuple[ParameterLibrary, ...] = ()
    interfaces: tuple[InterfaceFile, ...] = ()
    reconfigure_files: tuple[FileReference, ...] = ()
    installs: tuple[Install, ...] = ()
    dependencies: tuple[Dependency, ...] = ()
    subdirectories: tuple[Subdirectory, ...] = ()
    options: tuple[Option, ...] = ()
    gpu: tuple[FileReference, ...] = ()
    python_packages: tuple[FileReference, ...] = ()
    commands: tuple[Command, ...] = ()
    unknown: tuple[Unknown, ...] = ()
    foreign: tuple[str, ...] = ()
    malformed: bool = False
