"""C++: classes and functions that a file names with their namespace, and classes that it derives from."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Given, Requirement

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import File
from ecm_extract.link.index.program import Program
from ecm_extract.requires.place import Place, required


def name_requirements(file: File, program: Program) -> Iterator[Requirement]:
    """Yield the names of other namespaces; a name that several lines have alike is one requirement."""
    by = f"file {file.path}"
    lines: dict[tuple[str, int], list[Evidence]] = {}
    for mention in file.facts.mentions:
        name = program.spelled_out(mention.name, file)
        lines.setdefault((name, mention.arguments), []).append(Evidence(file.path, mention.line))
    for (name, count), evidence in lines.items():
        given = Given(count=count) if count >= 0 else None
        place = Place(file.path, evidence[0].line, by)
        yield required("names_symbol", name, place, given=given, evidence=tuple(dict.fromkeys(evidence)))
    for cls in file.facts.classes:
        for base in cls.bases:
            yield required("derives", plain(base), Place(file.path, cls.line, by))
