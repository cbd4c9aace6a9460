"""The names and texts of a source, whichever language it is in; comments are neither."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source import cpp_written, python_written
from ecm_parsers.source.written import Written

_PYTHON: Final = "python"


def names_in(data: bytes, language: str) -> Iterator[Written]:
    """Yield the names that a source of C++ or Python writes, words of the language among them."""
    return python_written.names(data) if language == _PYTHON else cpp_written.names(data)


def texts_in(data: bytes, language: str) -> Iterator[Written]:
    """Yield the texts that such a source writes; those that stand side by side are one."""
    return python_written.texts(data) if language == _PYTHON else cpp_written.texts(data)
