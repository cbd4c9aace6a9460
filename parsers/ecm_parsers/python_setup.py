"""`setup.py`: arguments of `setup()` (or catkin's `generate_distutils_setup()`), folded, never executed.

Source: setuptools, keywords of `setup()`; catkin_pkg.python_setup; generate_parameter_library_py.setup_helper.
"""

from __future__ import annotations

import msgspec
from tree_sitter import Node

from ecm_parsers.python_setup_facts import DataFiles, EntryPoint, PythonSetup, entry_point
from ecm_parsers.python_tree import MAX_BYTES, Reached, callee_name, parse_python, read_call, statements, text_of
from ecm_parsers.python_values import PyCall, Table, Value, shown
from ecm_parsers.python_variables import TELLING, Variables
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.text import decode

_SETUP_CALLS = frozenset({"setup", "generate_distutils_setup"})
_PARAMETER_MODULE = "generate_parameter_module"
_FINDERS = frozenset({"find_packages", "find_namespace_packages"})
_READ_CALLS = _SETUP_CALLS | {_PARAMETER_MODULE}
_MAKING = frozenset({"ext_modules", "cffi_modules", "rust_extensions"})
"""Keywords of setuptools, cffi and setuptools_rust for modules that are compiled."""
_Keywords = dict[str, Value]


def parse_setup_py(data: bytes) -> Parsed[PythonSetup]:
    """Read a `setup.py` of Python 2 or 3; names such as `package_name` are folded."""
    if len(data) > MAX_BYTES:
        message = f"setup.py larger than {MAX_BYTES} bytes is not read."
        return Parsed(PythonSetup(), (Diagnostic("error", "setup-too-large", 0, message, cut=True),))
    text, doubts = decode(data)
    diagnostics = list(doubts)
    calls = _calls(text, diagnostics)
    keywords = calls.keywords
    if keywords is None:
        message = "No call of setup() was found; nothing is read of this file."
        diagnostics.append(Diagnostic("warning", "setup-no-call", 0, message))
        return Parsed(PythonSetup(), tuple(diagnostics))
    facts = PythonSetup(
        name=_text(keywords, "name"),
        version=_text(keywords, "version"),
        packages=_packages(keywords.get("packages")) + _texts(keywords.get("py_modules")),
        package_dir=_package_dir(keywords.get("package_dir")),
        scripts=_texts(keywords.get("scripts")),
        data_files=_data_files(keywords.get("data_files"), diagnostics),
        entry_points=_entry_points(keywords.get("entry_points"), diagnostics),
        parameter_files=calls.parameter_files,
        makes_modules=calls.of_parameters or not _MAKING.isdisjoint(keywords),
        package_lines={**_lines(keywords.get("py_modules")), **_lines(keywords.get("packages"))},
    )
    return Parsed(facts, tuple(diagnostics))


class _Calls(msgspec.Struct):
    """What the calls of a file say: keywords of the setup calls, None without any, and parameter declarations."""

    keywords: _Keywords | None = None
    parameter_files: tuple[str, ...] = ()
    of_parameters: bool = False

    def add(self, call: PyCall, line: int, diagnostics: list[Diagnostic]) -> None:
        """Take what one call says."""
        if call.name.rpartition(".")[2] in _SETUP_CALLS:
            self.keywords = {**(self.keywords or {}), **_spread(call)}
            return
        self.of_parameters = True
        given = call.keyword("yaml_file") or (call.args[1] if len(call.args) > 1 else None)
        if given is not None and isinstance(given.data, str):
            self.parameter_files += (given.data,)
            return
        message = (
            "The file of generate_parameter_module is computed; its parameters are not read. Write its path as text."
        )
        diagnostics.append(Diagnostic("warning", "setup-computed-parameters", line, message))


def _calls(text: str, diagnostics: list[Diagnostic]) -> _Calls:
    """Read the calls that tell of the package, the names before them folded."""
    variables = Variables()
    found = _Calls()
    for reached in statements(Reached(parse_python(text), True), TELLING, variables.names, diagnostics):
        node = reached.node
        variables.take(reached)
        if node.type == "assignment":
            _tell_table(node, variables)
        elif node.type == "call" and _is_read(node):
            found.add(read_call(node, variables.names), node.start_point[0] + 1, diagnostics)
    return found


def _is_read(call: Node) -> bool:
    return callee_name(call.child_by_field_name("function")).rpartition(".")[2] in _READ_CALLS


def _tell_table(assignment: Node, variables: Variables) -> None:
    """`d = generate_distutils_setup(...)` of catkin gives a dictionary of what it gets."""
    left = assignment.child_by_field_name("left")
    target = text_of(left) if left is not None else ""
    made = variables.names.get(target)
    if made is not None and isinstance(made.data, PyCall) and made.data.name.rpartition(".")[2] in _SETUP_CALLS:
        entries = tuple((Value(name, made.line), value) for name, value in _spread(made.data).items())
        variables.give(target, Value(Table(entries), made.line), True)


def _spread(call: PyCall) -> _Keywords:
    """Return keyword arguments with those of a known `**dict` among them."""
    keywords: _Keywords = {}
    for name, value in call.keywords:
        if name != "**":
            keywords[name] = value
        elif isinstance(value.data, Table):
            keywords.update((shown(key), item) for key, item in value.data.entries)
    return keywords


def _text(keywords: _Keywords, name: str) -> str | None:
    """Return a keyword that is text, or None."""
    value = keywords.get(name)
    return value.data if value is not None and isinstance(value.data, str) else None


def _texts(value: Value | None) -> tuple[str, ...]:
    """Return a list of texts; what is not known stays `{expression}`."""
    if value is None or not isinstance(value.data, tuple):
        return ()
    return tuple(shown(item) for item in value.data)


def _lines(value: Value | None) -> dict[str, int]:
    """Return the line of each item of a list; one that a variable stands for is told where the list names it."""
    items = value.data if value is not None and isinstance(value.data, tuple) else ()
    return {shown(item): item.line for item in items}


def _packages(value: Value | None) -> tuple[str, ...]:
    """Return named packages, or the pattern that stands for a search."""
    if value is None or not isinstance(value.data, PyCall):
        return _texts(value)
    if value.data.name.rpartition(".")[2] not in _FINDERS:
        return ()
    where = value.data.keyword("where") or next(iter(value.data.args), None)
    folder = shown(where).strip("./") if where is not None else ""
    return (f"{folder}/**" if folder else "**",)


def _package_dir(value: Value | None) -> dict[str, str]:
    if value is None or not isinstance(value.data, Table):
        return {}
    return {shown(key): shown(folder) for key, folder in value.data.entries}


def _data_files(value: Value | None, diagnostics: list[Diagnostic]) -> tuple[DataFiles, ...]:
    """Return `[(destination, [files...]), ...]`; a bare text installs to the prefix."""
    found: list[DataFiles] = []
    items = value.data if value is not None and isinstance(value.data, tuple) else () if value is None else (value,)
    for item in items:
        if isinstance(item.data, str):
            found.append(DataFiles("", (item.data,), item.line))
        elif isinstance(item.data, tuple) and len(item.data) == 2:
            destination, files = item.data
            found.append(DataFiles(shown(destination), _texts(files), item.line))
        else:
            message = "A part of data_files is computed and not read: what else it installs is not known."
            diagnostics.append(Diagnostic("info", "setup-computed-data-files", item.line, message))
    return tuple(found)


def _entry_points(value: Value | None, diagnostics: list[Diagnostic]) -> tuple[EntryPoint, ...]:
    """Read `{group: [text, ...]}`, where a group may also be one text of several lines."""
    found: list[EntryPoint] = []
    for group, listed in value.data.entries if value is not None and isinstance(value.data, Table) else ():
        items = listed.data if isinstance(listed.data, tuple) else (listed,)
        for item in items:
            found.extend(_points(shown(group), item, diagnostics))
    return tuple(found)


def _points(group: str, item: Value, diagnostics: list[Diagnostic]) -> list[EntryPoint]:
    """Read the entry points in one text; an escaped line end inside one does not split it."""
    if not isinstance(item.data, str):
        message = f"An entry point of '{group[:80]}' is computed and not read. Write it as text."
        diagnostics.append(Diagnostic("warning", "setup-computed-entry-point", item.line, message))
        return []
    lines = [line for line in item.data.splitlines() if line.strip()]
    points = [entry_point(group, line, item.line, diagnostics) for line in lines]
    return [point for point in points if point is not None]
