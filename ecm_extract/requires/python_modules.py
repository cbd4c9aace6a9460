"""Python: the modules that a file imports of packages that it may know, and the names that it takes of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from typing import Final

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.facts import Import

from ecm_extract.entities.python_names import targets
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import children
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required

_GENERATED: Final = frozenset({"msg", "srv", "action", "cfg"})


def reachable(facts: PackageFacts, tree: Iterable[PackageFacts]) -> frozenset[str]:
    """Return the packages whose modules sources of a package may import: those of the tree, and what it depends on."""
    stated = facts.manifest.dependencies if facts.manifest is not None else ()
    return frozenset((*(each.name for each in tree), *(each.name for each in stated)))


def module_requirements(file: File, packages: Collection[str]) -> Iterator[Requirement]:
    """Yield what a file requires of the modules of some packages; modules that interfaces make are left out."""
    imports = [each for each in file.facts.imports if _is_of(each, packages)]
    for entry in imports:
        yield from _of_import(entry, file)
    yield from _of_attributes(imports, file)


def _is_of(entry: Import, packages: Collection[str]) -> bool:
    head, _, rest = entry.module.partition(".")
    return head in packages and rest.partition(".")[0] not in _GENERATED


def _of_import(entry: Import, file: File) -> Iterator[Requirement]:
    package, place = entry.module.partition(".")[0], _place(file, entry.line)
    parent, _, last = entry.module.rpartition(".")
    if parent:
        yield required("imports_module", last, place, package=package, owner=parent)
    if entry.name not in {"", "*"} | _GENERATED and not _is_own(entry.name):
        yield required("takes_name", entry.name, place, package=package, owner=entry.module)


def _of_attributes(imports: list[Import], file: File) -> Iterator[Requirement]:
    """`module.name`, of a name that the file binds by an import alone."""
    meant = {each.alias or each.name: _full(each) for each in imports if each.alias or each.name}
    known = meant.keys() - _rebound(file) if meant else frozenset()
    for function in file.facts.functions if known else ():
        for statement in function.body:
            for base, name in _attributes(statement.value):
                if base in known and not _is_own(name):
                    package = meant[base].partition(".")[0]
                    yield required("takes_name", name, _place(file, statement.line), package=package, owner=meant[base])


def _full(entry: Import) -> str:
    return f"{entry.module}.{entry.name}" if entry.name else entry.module


def _is_own(name: str) -> bool:
    """Whether every module has a name, as `__file__`."""
    return name.startswith("__") and name.endswith("__")


def _rebound(file: File) -> frozenset[str]:
    functions = file.facts.functions
    bound = (name for each in functions for statement in each.body for name in targets(statement.target))
    return frozenset((*bound, *(parameter.name for each in functions for parameter in each.params)))


def _attributes(expr: Expr | None) -> Iterator[tuple[str, str]]:
    if isinstance(expr, Member) and isinstance(expr.base, Name):
        yield expr.base.id, expr.name
    for child in children(expr) if expr is not None else ():
        yield from _attributes(child)


def _place(file: File, line: int) -> Place:
    return Place(file.path, line, f"file {file.path}")
