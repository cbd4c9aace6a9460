"""The order in which files are read decides nothing."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from ecm_parsers.source.facts import SourceFile

from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

FIXTURES = Path(__file__).parents[2] / "fixtures"
TREES = ("demo_robot", "arm_robot", "paper")


@pytest.mark.parametrize("name", TREES)
@pytest.mark.parametrize("seed", range(3))
def test_contracts_do_not_depend_on_the_order_of_files(name: str, seed: int) -> None:
    """Three shuffles of packages and of their sources give the same endpoints."""
    packages = Reader(open_tree(FIXTURES / name), False, (), False).read(1, None)
    shuffled = [replace(each, sources=_shuffled(each.sources, seed)) for each in packages]
    random.Random(seed).shuffle(shuffled)
    assert _told(shuffled) == _told(packages)


def _shuffled(sources: Mapping[str, SourceFile], seed: int) -> Mapping[str, SourceFile]:
    entries = list(sources.items())
    random.Random(seed).shuffle(entries)
    return dict(entries)


def _told(packages: Sequence[PackageFacts]) -> list[tuple[str, str, str]]:
    linked = Linker(packages, form_table()).link()
    return sorted((each.module.name, each.node or "", repr(each.interfaces)) for each in linked)
