"""`setup.cfg` and `pyproject.toml`: names, packages and entry points of a Python package.

Source: setuptools, "Configuring setuptools using setup.cfg files"; PEP 621.
"""

from __future__ import annotations

import configparser
import re
import tomllib
from collections.abc import Iterable, Iterator
from typing import Any

from ecm_parsers.python_setup_facts import DataFiles, EntryPoint, PythonSetup, entry_point
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.text import decode

MAX_BYTES = 1_000_000
MAX_BRACKETS = 100
_BLANK = re.compile(r"[\s\"']+")
_FIND = re.compile(r"find(_namespace)?:")
_SCRIPT_GROUPS = {"scripts": "console_scripts", "gui-scripts": "gui_scripts"}


class _Sections(configparser.RawConfigParser):
    """Sections whose keys keep their case: folders are keys too."""

    def optionxform(self, optionstr: str) -> str:
        """Return the key as written."""
        return optionstr


def parse_setup_cfg(data: bytes) -> Parsed[PythonSetup]:
    """Read a `setup.cfg`; quotes around values are dropped, as people write them."""
    diagnostics: list[Diagnostic] = []
    text = _text(data, diagnostics)
    sections = _Sections(strict=False, allow_no_value=True, default_section="\0")
    try:
        sections.read_string(text)
    except (configparser.Error, ValueError, AttributeError) as error:
        line = getattr(error, "lineno", 0) or 0
        message = "The file is not of the form 'key = value' in [sections]; it is read up to there."
        diagnostics.append(Diagnostic("error", "setup-cfg-syntax", line, message))
    points = tuple(_cfg_points(sections, text, diagnostics))
    facts = PythonSetup(
        name=_option(sections, "metadata", "name"),
        version=_option(sections, "metadata", "version"),
        packages=_cfg_packages(sections),
        package_dir=dict(_pairs(_option(sections, "options", "package_dir") or "")),
        scripts=tuple(_items(_option(sections, "options", "scripts") or "")),
        data_files=tuple(_cfg_data_files(sections, text)),
        entry_points=points,
        package_lines=_stated_at(text, _cfg_packages(sections)),
    )
    return Parsed(facts, tuple(diagnostics))


def parse_pyproject(data: bytes) -> Parsed[PythonSetup]:
    """Read the `[project]` table of a `pyproject.toml`, and packages named for setuptools."""
    diagnostics: list[Diagnostic] = []
    text = _text(data, diagnostics)
    table = _toml(text, diagnostics)
    project = _dict(table.get("project"))
    tool = _dict(_dict(table.get("tool")).get("setuptools"))
    facts = PythonSetup(
        name=_str(project.get("name")),
        version=_str(project.get("version")),
        packages=_toml_packages(tool.get("packages")),
        package_lines=_stated_at(text, _toml_packages(tool.get("packages"))),
        package_dir={key: str(value) for key, value in _dict(tool.get("package-dir")).items()},
        scripts=tuple(str(item) for item in _list(tool.get("script-files"))),
        data_files=tuple(_toml_data_files(tool, text)),
        entry_points=tuple(_toml_points(project, text, diagnostics)),
    )
    return Parsed(facts, tuple(diagnostics))


def _text(data: bytes, diagnostics: list[Diagnostic]) -> str:
    """Decode within the size bound."""
    if len(data) > MAX_BYTES:
        message = f"File larger than {MAX_BYTES} bytes is not read."
        diagnostics.append(Diagnostic("error", "setup-too-large", 0, message, cut=True))
        return ""
    text, doubts = decode(data)
    diagnostics.extend(doubts)
    return text


def _lines(text: str) -> dict[str, int]:
    """Return the first line of each `key = value` and each key, without quotes and spaces."""
    found: dict[str, int] = {}
    for number, line in enumerate(text.splitlines(), 1):
        key, equals, value = (_BLANK.sub("", part) for part in line.partition("="))
        found.setdefault(key + equals + value, number)
        found.setdefault(key, number)
    return found


def _line(lines: dict[str, int], written: str) -> int:
    """Return the 1-based line of a `key = value` or key; 0 when it is written in another way."""
    return lines.get(_BLANK.sub("", written), 0)


def _stated_at(text: str, packages: Iterable[str]) -> dict[str, int]:
    """Return the lines of packages: of their own where one stands alone on its line, else of the list."""
    lines = _lines(text)
    found = {name: lines.get(name) or lines.get(f"{name},") or _line(lines, "packages") for name in packages}
    return {name: line for name, line in found.items() if line}


def _option(sections: _Sections, section: str, name: str) -> str | None:
    value = sections.get(section, name, fallback=None)
    return value.strip().strip("'\"") if value else None


def _items(value: str) -> Iterator[str]:
    """Yield the items of a list written on lines or with commas."""
    for item in re.split(r"[,\n]", value):
        if item.strip():
            yield item.strip().strip("'\"")


def _pairs(value: str) -> Iterator[tuple[str, str]]:
    for item in _items(value):
        key, equals, folder = item.partition("=")
        if equals:
            yield key.strip(), folder.strip()


def _cfg_packages(sections: _Sections) -> tuple[str, ...]:
    value = _option(sections, "options", "packages") or ""
    if not _FIND.match(value):
        return tuple(_items(value))
    where = _option(sections, "options.packages.find", "where")
    return (f"{where}/**" if where else "**",)


def _cfg_points(sections: _Sections, text: str, diagnostics: list[Diagnostic]) -> Iterator[EntryPoint]:
    """Yield the entry points of `[options.entry_points]`."""
    if not sections.has_section("options.entry_points"):
        return
    lines = _lines(text)
    for group, value in sections.items("options.entry_points"):
        for written in (value or "").splitlines():
            if written.strip():
                point = entry_point(group, written, _line(lines, written), diagnostics)
                if point is not None:
                    yield point


def _cfg_data_files(sections: _Sections, text: str) -> Iterator[DataFiles]:
    lines = _lines(text)
    if sections.has_section("options.data_files"):
        for destination, value in sections.items("options.data_files"):
            yield DataFiles(destination, tuple(_items(value or "")), _line(lines, destination))


def _toml(text: str, diagnostics: list[Diagnostic]) -> dict[str, Any]:
    """Parse TOML; brackets nested beyond reason are refused, since the parser recurses."""
    if _nesting(text) > MAX_BRACKETS:
        message = f"TOML values nested deeper than {MAX_BRACKETS} are not read."
        diagnostics.append(Diagnostic("error", "pyproject-too-deep", 0, message, cut=True))
        return {}
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, ValueError, RecursionError) as error:
        line = re.search(r"line (\d+)", str(error))
        message = "The file is not valid TOML and nothing is read of it."
        diagnostics.append(Diagnostic("error", "pyproject-syntax", int(line[1]) if line else 0, message))
        return {}


def _nesting(text: str) -> int:
    """Return an upper bound of the nesting of arrays, inline tables and dotted keys."""
    deepest = depth = 0
    for char in text:
        if char in "[{":
            depth += 1
            deepest = max(deepest, depth)
        elif char in "]}":
            depth = max(0, depth - 1)
    return deepest


def _toml_points(project: dict[str, Any], text: str, diagnostics: list[Diagnostic]) -> Iterator[EntryPoint]:
    """Yield `[project.scripts]`, `[project.gui-scripts]` and `[project.entry-points.<group>]`."""
    groups = {group: _dict(project.get(key)) for key, group in _SCRIPT_GROUPS.items()}
    groups.update((group, _dict(table)) for group, table in _dict(project.get("entry-points")).items())
    lines = _lines(text)
    for group, table in groups.items():
        for name, target in table.items():
            written = f"{name} = {target}"
            point = entry_point(group, written, _line(lines, written), diagnostics)
            if point is not None:
                yield point


def _toml_packages(value: object) -> tuple[str, ...]:
    """Return the packages listed, or the patterns that stand for `packages.find`."""
    if not isinstance(value, dict):
        return tuple(str(item) for item in _list(value))
    folders = [str(folder) for folder in _list(_dict(value.get("find")).get("where"))]
    return tuple("**" if folder == "." else f"{folder}/**" for folder in folders) or ("**",)


def _toml_data_files(tool: dict[str, Any], text: str) -> Iterator[DataFiles]:
    lines = _lines(text)
    for destination, files in _dict(tool.get("data-files")).items():
        yield DataFiles(destination, tuple(str(item) for item in _list(files)), _line(lines, destination))


def _dict(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []


def _str(value: object) -> str | None:
    return value if isinstance(value, str) else None
