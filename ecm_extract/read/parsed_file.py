"""One source file, to be parsed and parsed."""

from __future__ import annotations

import msgspec
from ecm_parsers.result import Diagnostic
from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.select import SourceKind

Task = tuple[str, SourceKind]
"""Path and kind of a file that is to be parsed."""


class BlobFacts(msgspec.Struct, frozen=True, array_like=True):
    """What parsing gave for one content, wherever it lies.

    Attributes:
        size: of the content, in bytes.
        facts: None of a script that is not Python.
        diagnostics: of the parser.
    """

    size: int
    facts: SourceFile | None
    diagnostics: tuple[Diagnostic, ...] = ()


class ParsedFile(msgspec.Struct, frozen=True, array_like=True):
    """One parsed source file on its way between processes; `blob` is the git blob id of the bytes that were parsed."""

    path: str
    blob: str
    content: BlobFacts
