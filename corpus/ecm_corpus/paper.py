"""The paper's own numbers (`corpus/cases/paper.yaml`), to stand beside ours."""

from __future__ import annotations

from pathlib import Path

import msgspec
from ecm_checker.finding import Dimension

from ecm_corpus.interface import Substrate, read_record


class PaperTables(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Hits by substrate: of each method, and of the paper's ECM-full by dimension."""

    recall: dict[Substrate, dict[str, int]] = {}
    dimensions: dict[Substrate, dict[Dimension, int]] = {}


def read_paper(path: Path) -> PaperTables:
    """The tables from their file.

    Raises:
        InputError: the file cannot be read, or does not fit.
    """
    return read_record(path, PaperTables)
