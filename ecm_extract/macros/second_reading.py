"""Files that call macros of headers are read again with these: a parser sees one file at a time.

Which headers a file sees is only known when all are read. Of a name to which two of them give another
meaning nothing is told, and the file says so.
Source: [cpp.replace] of the C++ standard.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from ecm_parsers.source.facts import Replacement, SourceFile

from ecm_extract.link.code.units import File
from ecm_extract.link.owning.built import files_of
from ecm_extract.macros.reached import Reached
from ecm_extract.macros.rows import HeaderRow, macros_of_headers
from ecm_extract.read.cuts import located
from ecm_extract.read.facts import PackageFacts
from ecm_extract.resolve.headers import Headers
from ecm_extract.resolve.layout import layouts
from ecm_extract.resolve.sight import Sight
from ecm_extract.tree import FileDiagnostic, Tree, Unread, printable

_Macros = tuple[Replacement, ...]
_Known = Mapping[str, _Macros]


@dataclass(frozen=True, slots=True)
class _Wanted:
    """A file that sees macros of headers, in the package that has it."""

    package: PackageFacts
    macros: _Macros


def read_with_header_macros(packages: Sequence[PackageFacts], tree: Tree, rows: Iterable[HeaderRow]) -> None:
    """Replace the facts of C++ files that call macros of headers.

    Args:
        packages: what was read, whose facts are replaced.
        tree: where files are read.
        rows: the user's, for headers that are not in the tree.
    """
    known = macros_of_headers(rows)
    wanted = _wanted(packages, known) if any(_is_concerned(package, known) for package in packages) else {}
    if not wanted:
        return
    from ecm_parsers.source.cpp import MACROS_CUT, parse_cpp

    reached = Reached()
    for path, data in tree.read_many(list(wanted)):
        found = wanted[path]
        macros = reached.by(data, found.macros)
        if macros:
            read = parse_cpp(data, macros)
            for entry in read.diagnostics:
                if entry.code == MACROS_CUT:
                    tree.report(located(path, entry))
            if _breaks(found.package.sources[path], read.facts):
                tree.report(_broken(path))
            elif not any(entry.cut for entry in read.diagnostics):
                found.package.sources[path] = read.facts


def _breaks(before: SourceFile, after: SourceFile) -> bool:
    """Whether what macros stand for is no C++ for the parser, so that classes of a file are lost with it."""
    return not {each.name for each in before.classes} <= {each.name for each in after.classes}


def _broken(path: str) -> FileDiagnostic:
    shown = printable(path)
    text = (
        "With the macros of its headers in their places this file cannot be read: it is taken as it is written, and "
        "what they declare is not told. Declare it without a macro."
    )
    return FileDiagnostic("warning", "cpp-macros", shown, 0, text, Unread(shown, "undecided"))


def _is_concerned(package: PackageFacts, known: _Known) -> bool:
    each_facts = package.sources.values()
    return any(facts.exported or any(entry.module in known for entry in facts.imports) for facts in each_facts)


def _wanted(packages: Sequence[PackageFacts], known: _Known) -> Mapping[str, _Wanted]:
    files = files_of(packages)
    headers = Headers(files, Sight(packages, files), layouts(packages))
    owners = {path: package for package in packages for path in package.sources}
    of_cpp = (file for file in files if file.language == "cpp")
    seen = {file.path: tuple(dict.fromkeys(_seen(file, headers.of(file), known))) for file in of_cpp}
    return {path: _Wanted(owners[path], macros) for path, macros in sorted(seen.items()) if macros}


def _seen(file: File, headers: Collection[File], known: _Known) -> Iterator[Replacement]:
    """The macros of the headers that a file sees; of those that are not in the tree what is known of them."""
    found = [entry.module for each in (file, *headers) for entry in each.facts.imports if entry.module in known]
    for module in dict.fromkeys(found):
        if not any(header.path.endswith(f"/{module}") for header in headers):
            yield from known[module]
    for header in headers:
        yield from header.facts.exported
