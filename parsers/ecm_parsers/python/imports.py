"""Modules of the tree that a Python file imports, each read once and on demand.

Files share their helpers by `import`, by `importlib`, and by what else a library has for this.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from ecm_parsers.python.models import Models
from ecm_parsers.python.sources import Sources
from ecm_parsers.python.syntax import parsed
from ecm_parsers.python.values import Module, Reference, Scope, Value
from ecm_parsers.template import Template
from ecm_parsers.text import decode

MAX_MODULES = 60
MAX_BYTES = 500_000


class Imports:
    """Finds what an import binds. `read` makes the names of a module from its statements."""

    def __init__(self, sources: Sources, models: Models, read: Callable[[ast.Module, Scope], None]) -> None:
        self._sources = sources
        self._models = models
        self._read = read
        self._known: dict[str | Template, Module | None] = {}

    def bound(self, node: ast.Import | ast.ImportFrom, package: str) -> Iterator[tuple[str, Value]]:
        """Yield the names that an import statement sets.

        Args:
            node: the statement.
            package: dotted name of the package that holds the statement, for relative imports.
        """
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.asname or alias.name.split(".")[0], self._whole(alias)
            return
        origin = _origin(node, package)
        module = self.named(origin)
        for alias in node.names:
            if alias.name == "*":
                yield from module.scope.names.items() if module is not None else ()
                continue
            yield alias.asname or alias.name, self.member(origin, alias.name)

    def _whole(self, alias: ast.alias) -> Value:
        if alias.asname is None and "." in alias.name:
            return Reference(alias.name.split(".")[0])
        return self.named(alias.name) or Reference(alias.name)

    def member(self, origin: str, name: str) -> Value:
        """Return what a module calls a name; what is modelled stays a name, wherever its source lies."""
        path = f"{origin}.{name}" if origin else name
        if name in self._models.calls:
            return Reference(path)
        module = self.named(origin)
        if module is not None and name in module.scope.names:
            return module.scope.names[name]
        return self.named(path) or Reference(path)

    def named(self, name: str) -> Module | None:
        """Return a module by its dotted name, None when the tree does not hold it."""
        if not name or name.split(".")[0] in self._models.outside:
            return None
        if name not in self._known:
            self._load(name, name, self._sources.module(name))
        return self._known[name]

    def at(self, path: Template) -> Module | None:
        """Return a module by the path of its file, None when the tree does not hold it."""
        if path not in self._known:
            self._load(path, "", self._sources.file(path))
        return self._known[path]

    def _load(self, key: str | Template, name: str, data: bytes | None) -> None:
        self._known[key] = None  # also what a module sees of itself while it is read
        tree = parsed_module(data) if data is not None and len(self._known) <= MAX_MODULES else None
        if tree is None:
            return
        module = Module(name, Scope({"__name__": name}))
        self._known[key] = module
        self._read(tree, module.scope)


def parsed_module(data: bytes) -> ast.Module | None:
    """Return the statements of a module, None when it cannot be parsed."""
    if len(data) > MAX_BYTES:
        return None
    try:
        return parsed(decode(data)[0])
    except (SyntaxError, RecursionError, MemoryError, ValueError):
        return None


def _origin(node: ast.ImportFrom, package: str) -> str:
    parts = package.split(".") if package else []
    base = parts[: len(parts) - node.level + 1] if node.level else []
    return ".".join([*base, *([node.module] if node.module else [])])
