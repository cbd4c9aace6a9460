"""Which file of the tree a Python module is, by the path that a program has when it runs.

Source: Python, `sys.path` ("initialized with the folder of the script") and "The import system"; implicit relative
imports of Python 2 (PEP 328), which ROS 1 ran. What no entry of the path has is outside the tree.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from posixpath import dirname
from typing import Final

from ecm_parsers.source.expr import Call

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import calls_in
from ecm_extract.resolve.layout import PackageLayout
from ecm_extract.resolve.paths import tree_path
from ecm_extract.resolve.sight import Sight

_EDITS: Final = frozenset({"sys.path.append", "sys.path.insert", "sys.path.extend", "site.addsitedir"})
_NOWHERE: Final = PackageLayout("")
_INIT: Final = "/__init__"


class PythonPath:
    """Finds modules; a module is told by its path without `.py`, that of a package by its folder.

    Args:
        files: of the tree.
        sight: which packages see which.
        layouts: of packages, by name.
    """

    def __init__(self, files: Iterable[File], sight: Sight, layouts: Mapping[str, PackageLayout]) -> None:
        self._sight = sight
        self._layouts = layouts
        self._files = {module_path(file): file for file in files if file.path.endswith(".py")}
        self._packages = frozenset(dirname(file.path) for file in self._files.values() if _is_init(file))
        self._folders = frozenset(folder for path in self._files for folder in _above(path))
        self._script_folders = frozenset(dirname(file.path) for file in self._files.values()) - self._packages
        self._edited: dict[File, bool] = {}
        self._known: dict[tuple[str, File], str | None] = {}

    def file(self, module: str) -> File | None:
        """Return the file of a module; None of a folder without `__init__.py`."""
        return self._files.get(module)

    def imported(self, file: File) -> Iterator[File]:
        """Yield the files that run where a file is imported by what it imports itself: modules and packages around."""
        for entry in file.facts.imports:
            dot = "" if entry.module.endswith(".") else "."
            names = (entry.module, f"{entry.module}{dot}{entry.name}") if entry.name else (entry.module,)
            for found in filter(None, (self.find(name, file) for name in names)):
                around = (folder for folder in _above(found) if folder in self._packages)
                yield from (self._files[path] for path in (found, *around) if path in self._files)

    def has(self, module: str) -> bool:
        """Tell whether a path is that of a module or of a folder with modules."""
        return module in self._files or module in self._folders

    def find(self, dotted: str, file: File) -> str | None:
        """Return the path of the module that a name means in an import of a file; None of one outside the tree."""
        key = (dotted, file)
        if key not in self._known:
            self._known[key] = self._relative(dotted, file) if dotted.startswith(".") else self._absolute(dotted, file)
        return self._known[key]

    def _relative(self, dotted: str, file: File) -> str | None:
        rest = dotted.lstrip(".")
        folder = dirname(file.path)
        for _ in range(len(dotted) - len(rest) - 1):
            folder = dirname(folder)
        found = tree_path(folder, rest.replace(".", "/"))
        return found if self.has(found) else None

    def _absolute(self, dotted: str, file: File) -> str | None:
        rest = dotted.replace(".", "/")
        for place in self._places(file):
            if self.has(tree_path(place, rest)):
                return tree_path(place, rest)
        own = self.installed(dotted, file.package)
        if own is not None:
            return own
        others = {self.installed(dotted, package) for package in self._sight.of(file.package)} - {None}
        if not others and self._edits_path(file):
            others = set(self._anywhere(rest, file))
        return others.pop() if len(others) == 1 else None

    def _places(self, file: File) -> Iterator[str]:
        """The folder from which the package of a file is imported; folders of scripts, its own and those above it."""
        folder, root = dirname(file.path), self._layout(file.package).root
        if folder in self._packages:
            yield self._outside(folder)
        if folder not in self._packages or file.ros == 1 or file.facts.shebang:
            yield folder
        while folder != root and folder:
            folder = dirname(folder)
            if folder in self._script_folders:
                yield folder

    def _outside(self, folder: str) -> str:
        """The folder around all packages that a folder is in; the root of a tree that is a package itself."""
        while folder and folder in self._packages:
            folder = dirname(folder)
        return folder

    def installed(self, dotted: str, package: str) -> str | None:
        """Return the path of a module that a package installs; None of others."""
        layout = self._layout(package)
        rest = dotted.replace(".", "/")
        top, _, below = rest.partition("/")
        known = [layout.modules[dotted]] if dotted in layout.modules else []
        known += [tree_path(layout.modules[top], below)] if top in layout.modules else []
        named = next((found for found in known if self.has(found)), None)
        if named is not None:
            return named
        rooted = (tree_path(folder, rest) for folder in layout.python_roots)
        return next((found for found in rooted if self.has(found)), None)

    def _anywhere(self, rest: str, file: File) -> Iterator[str]:
        """Where a program may have put the path to: any folder of a package in sight, with all packages around it."""
        seen = self._sight.of(file.package)
        for path, other in self._files.items():
            place = path[: -len(rest)].rstrip("/")
            if other.package in seen and f"/{path}".endswith(f"/{rest}") and place not in self._packages:
                yield path

    def _edits_path(self, file: File) -> bool:
        known = self._edited.get(file)
        if known is None:
            known = self._edited[file] = any(_is_edit(call) for call in _calls(file))
        return known

    def _layout(self, package: str) -> PackageLayout:
        return self._layouts.get(package, _NOWHERE)


def module_path(file: File) -> str:
    """Return the path of the module that a file is."""
    return f"/{file.path}".removesuffix(".py").removesuffix(_INIT).removeprefix("/")


def _is_init(file: File) -> bool:
    return f"/{file.path}".endswith(f"{_INIT}.py")


def _above(path: str) -> Iterator[str]:
    while "/" in path:
        path = dirname(path)
        yield path


def _calls(file: File) -> Iterator[Call]:
    for function in file.facts.functions:
        for statement in function.body:
            yield from calls_in(statement.value)


def _is_edit(call: Call) -> bool:
    return dotted_name(call.callee) in _EDITS
