"""Whether a build puts a Python file where something starts or imports it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from posixpath import dirname, join, normpath

from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.installed import installed_sources
from ecm_extract.resolve.installed_python import installed_modules

_OPEN = "$"
"""Of a path that the build alone knows."""
_SPECIAL = "__"
"""How modules begin that Python itself looks for."""


def is_in_use(path: str, package: PackageFacts, packages: Iterable[PackageFacts]) -> bool:
    """Tell whether a file may be started, or is a module of an installed package that any source may import."""
    started = {*_copied(package), *(each for each, _ in installed_sources(package))}
    if any(_is_within(path, place) for place in started):
        return True
    return any(_is_within(path, place) for place in installed_modules(package).values()) and is_imported(path, packages)


def _is_within(path: str, place: str) -> bool:
    above = path.removesuffix(".py")
    return _OPEN in place or place in (path, above, ".", "") or path.startswith(f"{place}/")


def is_imported(path: str, packages: Iterable[PackageFacts]) -> bool:
    """Tell whether some source imports a module of that name, or Python itself does."""
    name = path.rpartition("/")[2].removesuffix(".py")
    imports = (each for package in packages for file in package.sources.values() for each in file.imports)
    return name.startswith(_SPECIAL) or any(name in (*each.module.split("."), each.name) for each in imports)


def _copied(package: PackageFacts) -> Iterator[str]:
    for file, facts in package.cmake.items():
        for rule in facts.installs:
            yield from (normpath(join(dirname(file), item)) for item in rule.items if rule.kind != "targets")
    for file, setup in package.setups.items():
        yield from (normpath(join(dirname(file), item)) for item in setup.scripts)
