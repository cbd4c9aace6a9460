"""C++: the headers that a file includes."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement

from ecm_extract.link.code.units import File
from ecm_extract.requires.place import Place, required


def header_requirements(file: File) -> Iterator[Requirement]:
    """Yield what the include lines of a C++ file require."""
    for entry in file.facts.imports:
        yield required("includes", entry.module, Place(file.path, entry.line, f"file {file.path}"))
