"""The chain of hashes over a blind run: whoever changes an input, a contract or a finding later breaks it.

Each link hashes the link before, its input, its output, the extractor and the checker.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Final

import msgspec

from ecm_corpus.interface import InterfaceCase
from ecm_corpus.results import CaseResult, Results

_PACKAGES: Final = ("ecm_parsers", "ecm_extract")
_SOURCES: Final = (".py", ".toml", ".scm")


def canonical(record: object) -> bytes:
    """The bytes of a record that are hashed: JSON with sorted keys."""
    return msgspec.json.encode(record, order="sorted")


def digest_of(record: object) -> str:
    """SHA-256 over a record, in hexadecimal."""
    return hashlib.sha256(canonical(record)).hexdigest()


def extractor_hash() -> str:
    """SHA-256 over names and contents of the sources that read trees."""
    digest = hashlib.sha256()
    for package in _PACKAGES:
        for name, file in sorted(_sources(resources.files(package), f"{package}/")):
            content = file.read_bytes().replace(b"\r\n", b"\n")
            digest.update(f"{name}\0{len(content)}\0".encode())
            digest.update(content)
    return digest.hexdigest()


def chained(cases: Iterable[CaseResult], extractor: str, checker: str) -> Iterator[CaseResult]:
    """Yield the cases with `output`, `previous` and `hash` filled in."""
    previous = ""
    for case in cases:
        output = digest_of((case.missing, case.states))
        mark = _mark(previous, case.case, case.input, output, extractor, checker)
        yield msgspec.structs.replace(case, output=output, previous=previous, hash=mark)
        previous = mark


def broken_links(results: Results, inputs: Sequence[InterfaceCase]) -> tuple[str, ...]:
    """What does not fit in a chain: case ids with what is wrong, in order; nothing when it holds.

    Args:
        results: of the run.
        inputs: the interface parts as they are now.
    """
    known = {case.case: digest_of(case) for case in inputs}
    found = []
    expected = chained(results.cases, results.extractor, results.checker)
    for case, right in zip(results.cases, expected, strict=True):
        if case != right:
            found.append(f"{case.case}: its result is not the one that was hashed")
        if known.get(case.case) != case.input:
            found.append(f"{case.case}: its interface part is not the one that was judged")
    return tuple(found)


def _mark(*parts: str) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def _sources(folder: Traversable, prefix: str) -> Iterator[tuple[str, Traversable]]:
    for entry in folder.iterdir():
        if entry.is_dir():
            yield from _sources(entry, f"{prefix}{entry.name}/")
        elif entry.name.endswith(_SOURCES):
            yield f"{prefix}{entry.name}", entry
