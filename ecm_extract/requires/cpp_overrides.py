"""C++: methods of a class that may override those of a class of another package."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Given, Requirement

from ecm_extract.entities.signatures import form_of
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.requires.place import Place, required


def override_requirements(program: Program) -> Iterator[tuple[str, Requirement]]:
    """Yield the package and the requirement of each method of a class that has a base of another package."""
    for group in program.classes.values():
        for cls in group:
            if cls.file.language == "cpp" and cls.fact.bases and "private" not in cls.fact.traits:
                for found in _of_class(cls, program):
                    yield cls.file.package, found


def _of_class(cls: Cls, program: Program) -> Iterator[Requirement]:
    bases = [name for name in dict.fromkeys(program.base_names(cls)) if _is_foreign(name, cls, program)]
    for method in cls.methods if bases else ():
        if method.file is cls.file and method.fact.name != cls.fact.name:
            for base in bases:
                yield _override(method, cls, base)


def _is_foreign(name: str, cls: Cls, program: Program) -> bool:
    base = program.class_named(name, cls.file, cls.qualified)
    return base is None or base.file.package != cls.file.package


def _override(method: Func, cls: Cls, base: str) -> Requirement:
    form = form_of(method.fact)
    place = Place(cls.file.path, method.fact.line, f"class {cls.qualified}")
    given = Given(types=form.types, returns=form.returns)
    return required("overrides", method.fact.name, place, owner=base, scope=cls.qualified, given=given, said=form.text)
