"""Which packages the files of a package name, by what each file says: comments of sources and of XML say nothing."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.source.cpp_directives import included
from ecm_parsers.xml_tree import without_comments

from ecm_extract.lint.source_text import names_in, texts_in
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import CPP

_PYTHON: Final = ".py"
_XML: Final = frozenset({".launch", ".sdf", ".srdf", ".test", ".ui", ".urdf", ".world", ".xacro", ".xml"})


class PackageWords:
    """Asks files for names of some packages."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = {name: name.encode() for name in names}
        known = "|".join(re.escape(name) for name in sorted(self._names))
        self._word = re.compile(rf"\b(?:{known})\b")

    def of(self, path: str, data: bytes, package: PackageFacts) -> set[str]:
        """Return the packages that a file of a package names, in any way that its build or a program may use."""
        if not any(name in data for name in self._names.values()):
            return set()
        return {name for said in _said(path, data, package) for name in self._word.findall(said)}


def includes_of(path: str, data: bytes, package: PackageFacts) -> Iterable[str]:
    """Return the paths that a C++ file includes; a test is no source whose facts are known."""
    facts = package.sources.get(path)
    if facts is not None:
        return [entry.module for entry in facts.imports] if facts.language == "cpp" else ()
    return included(data) if PurePosixPath(path).suffix.lower() in CPP else ()


def _said(path: str, data: bytes, package: PackageFacts) -> Iterator[str]:
    facts, suffix = package.sources.get(path), PurePosixPath(path).suffix.lower()
    definition = package.interfaces.get(path)
    if definition is not None:
        return (entry.package or "" for section in definition.sections for entry in section.fields)
    language = facts.language if facts is not None else _language(suffix)
    if language:
        written = (each.value for each in chain(names_in(data, language), texts_in(data, language)))
        return chain(written, included(data) if language == "cpp" else ())
    plain: Callable[[bytes], bytes] = without_comments if suffix in _XML else bytes
    return iter([plain(data).decode("utf-8", "replace")])


def _language(suffix: str) -> str:
    if suffix in CPP:
        return "cpp"
    return "python" if suffix == _PYTHON else ""
