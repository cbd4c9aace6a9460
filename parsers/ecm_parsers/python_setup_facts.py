"""What `setup.py`, `setup.cfg` and `pyproject.toml` state about a Python package."""

from __future__ import annotations

import msgspec

from ecm_parsers.result import Diagnostic


class EntryPoint(msgspec.Struct, frozen=True):
    """`name = module:attribute` in a group such as `console_scripts`; without attribute it is a module."""

    group: str
    name: str
    module: str
    attribute: str
    line: int


class DataFiles(msgspec.Struct, frozen=True):
    """Files, or patterns, that are installed to a folder below the prefix."""

    destination: str
    files: tuple[str, ...]
    line: int


class PythonSetup(msgspec.Struct, frozen=True):
    """The union of what one file states.

    Attributes:
        name, version: None when not stated or not known.
        packages: import packages; `**` stands for `find_packages()`, also below a folder (`src/**`).
        package_dir: package -> folder; the empty name is the root of all.
        scripts: files installed as programs.
        data_files: what is installed to share folders.
        entry_points: programs and plugins.
        parameter_files: declarations that generate_parameter_library makes a Python module of, from this folder.
        makes_modules: whether it makes modules that lie in no folder: of parameters, or compiled ones.
        package_lines: package that is written out -> its line.
    """

    name: str | None = None
    version: str | None = None
    packages: tuple[str, ...] = ()
    package_dir: dict[str, str] = {}
    scripts: tuple[str, ...] = ()
    data_files: tuple[DataFiles, ...] = ()
    entry_points: tuple[EntryPoint, ...] = ()
    parameter_files: tuple[str, ...] = ()
    makes_modules: bool = False
    package_lines: dict[str, int] = {}


def entry_point(group: str, text: str, line: int, diagnostics: list[Diagnostic]) -> EntryPoint | None:
    """Read one `name = module:attribute [extras]`; None with a diagnostic when it has no `=`."""
    name, equals, target = text.partition("=")
    module, _, attribute = target.partition("[")[0].partition(":")
    if not equals or not module.strip() or not name.strip():
        message = f"Entry point '{text[:80].strip()}' is not of the form 'name = module:function'."
        diagnostics.append(Diagnostic("warning", "setup-bad-entry-point", line, message))
        return None
    return EntryPoint(group, name.strip(), module.strip(), attribute.strip(), line)
