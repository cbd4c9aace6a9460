"""`setup.py`: arguments of `setup()` (or catkin's `generate_distutils_setup()`), folded, never executed.

Source: setuptools, keywords of `setup()`; catkin_pkg.python_setup; generate_parameter_library_py.setup_helper.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.declared import MAX_BYTES, declarations, pattern_of
from ecm_parsers.python.places import line_of
from ecm_parsers.python.values import Many, Text, Unknown, Value
from ecm_parsers.python_setup_facts import DataFiles, EntryPoint, PythonSetup, entry_point
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.template import Substitution
from ecm_parsers.text import decode

_MAKING: Final = frozenset({"ext_modules", "cffi_modules", "rust_extensions"})
"""Keywords of setuptools, cffi and setuptools_rust for modules that are compiled."""
_Keywords = Mapping[str, Value]


def parse_setup_py(data: bytes) -> Parsed[PythonSetup]:
    """Read a `setup.py` of Python 2 or 3; names such as `package_name` are folded."""
    if len(data) > MAX_BYTES:
        message = f"setup.py larger than {MAX_BYTES} bytes is not read."
        return Parsed(PythonSetup(), (Diagnostic("error", "setup-too-large", 0, message, cut=True),))
    text, doubts = decode(data)
    diagnostics = list(doubts)
    calls = _Calls(diagnostics)
    diagnostics += declarations(calls.models).read(text)[1]
    keywords = calls.keywords
    if keywords is None:
        message = "No call of setup() was found; nothing is read of this file."
        diagnostics.append(Diagnostic("warning", "setup-no-call", 0, message))
        return Parsed(PythonSetup(), tuple(diagnostics))
    facts = PythonSetup(
        name=_text(keywords, "name"),
        version=_text(keywords, "version"),
        packages=_texts(keywords.get("packages")) + _texts(keywords.get("py_modules")),
        package_dir=_package_dir(keywords.get("package_dir")),
        scripts=_texts(keywords.get("scripts")),
        data_files=_data_files(keywords.get("data_files"), diagnostics),
        entry_points=_entry_points(keywords.get("entry_points"), diagnostics),
        parameter_files=calls.parameter_files,
        makes_modules=calls.of_parameters or not _MAKING.isdisjoint(keywords),
        package_lines={**_lines(keywords.get("py_modules")), **_lines(keywords.get("packages"))},
    )
    return Parsed(facts, tuple(diagnostics))


class _Calls:
    """What the calls of a file say: keywords of the setup calls, None without any, and parameter declarations."""

    def __init__(self, diagnostics: list[Diagnostic]) -> None:
        self.keywords: _Keywords | None = None
        self.parameter_files: tuple[str, ...] = ()
        self.of_parameters = False
        self._diagnostics = diagnostics

    @property
    def models(self) -> Mapping[str, Constructor]:
        """What a `setup.py` calls."""
        return {
            "setup": self._setup,
            "generate_distutils_setup": self._setup,
            "generate_parameter_module": self._parameters,
            "find_packages": _found,
            "find_namespace_packages": _found,
        }

    def _setup(self, given: Arguments) -> Value:
        """That of catkin gives a dictionary of what it gets."""
        self.keywords = {**(self.keywords or {}), **given.keywords}
        return dict(given.keywords)

    def _parameters(self, given: Arguments) -> Value:
        self.of_parameters = True
        path = given.get("yaml_file", 1)
        if isinstance(path, str | Text):
            self.parameter_files += (pattern_of(path),)
            return Unknown("")
        message = (
            "The file of generate_parameter_module is computed; its parameters are not read. Write its path as text."
        )
        self._diagnostics.append(Diagnostic("warning", "setup-computed-parameters", given.line, message))
        return Unknown("")


def _found(given: Arguments) -> Value:
    """The pattern that stands for a search."""
    folder = pattern_of(given.get("where", 0, "")).strip("./")
    return [Many(Text((Substitution("files", ((f"{folder}/**" if folder else "**",),)),)))]


def _text(keywords: _Keywords, name: str) -> str | None:
    """Return a keyword that is text, or None."""
    value = keywords.get(name)
    return pattern_of(value) if isinstance(value, str | Text) else None


def _items(value: Value) -> list[Value]:
    return list(value) if isinstance(value, list | tuple) else []


def _texts(value: Value) -> tuple[str, ...]:
    """Return a list of texts; what is not known stays `{expression}`."""
    return tuple(map(pattern_of, _items(value)))


def _lines(value: Value) -> dict[str, int]:
    """Return the line of each item of a list; one that a variable stands for is told where the list names it."""
    return {pattern_of(item): line_of(item, line_of(value)) for item in _items(value) if not isinstance(item, Many)}


def _package_dir(value: Value) -> dict[str, str]:
    return {pattern_of(key): pattern_of(folder) for key, folder in value.items()} if isinstance(value, dict) else {}


def _data_files(value: Value, diagnostics: list[Diagnostic]) -> tuple[DataFiles, ...]:
    """Return `[(destination, [files...]), ...]`; a bare text installs to the prefix."""
    found: list[DataFiles] = []
    for item in _items(value) if isinstance(value, list | tuple) else [] if value is None else [value]:
        each, line = item.each if isinstance(item, Many) else item, line_of(item, line_of(value))
        if isinstance(each, str | Text):
            found.append(DataFiles("", (pattern_of(each),), line))
        elif isinstance(each, list | tuple) and len(each) == 2:
            found.append(DataFiles(pattern_of(each[0]), _texts(each[1]), line))
        else:
            message = "A part of data_files is computed and not read: what else it installs is not known."
            diagnostics.append(Diagnostic("info", "setup-computed-data-files", line, message))
    return tuple(found)


def _entry_points(value: Value, diagnostics: list[Diagnostic]) -> tuple[EntryPoint, ...]:
    """Read `{group: [text, ...]}`, where a group may also be one text of several lines."""
    found: list[EntryPoint] = []
    for group, listed in value.items() if isinstance(value, dict) else ():
        for item in listed if isinstance(listed, list | tuple) else (listed,):
            found.extend(_points(pattern_of(group), item, diagnostics))
    return tuple(found)


def _points(group: str, item: Value, diagnostics: list[Diagnostic]) -> list[EntryPoint]:
    """Read the entry points in one text; an escaped line end inside one does not split it."""
    if not isinstance(item, str | Text):
        message = f"An entry point of '{group[:80]}' is computed and not read. Write it as text."
        diagnostics.append(Diagnostic("warning", "setup-computed-entry-point", line_of(item), message))
        return []
    lines = [line for line in pattern_of(item).splitlines() if line.strip()]
    points = [entry_point(group, line, line_of(item), diagnostics) for line in lines]
    return [point for point in points if point is not None]
