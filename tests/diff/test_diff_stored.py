"""Stored documents say the same as the sources that they were made of: changes, findings and verdict, byte for byte."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest

from ecm_extract.diff.formats import json as diff_json
from ecm_extract.diff.model import RefInfo
from ecm_extract.diff.run import Request, compare
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.report.folder import write_document, write_manifests
from ecm_extract.report.json_document import json_document
from ecm_extract.stored import Stored, read_stored
from ecm_extract.tree import Tree, open_tree

PAIRS = Path(__file__).parents[2] / "fixtures" / "lint"
INFOS = (RefInfo("bad", None, ""), RefInfo("good", None, ""))
OPTIONS = Options(jobs=1, cache=False)


def document_of(old: Tree | Stored, new: Tree | Stored) -> str:
    """What a comparison says."""
    request = Request(old, new, None, "pair", INFOS, consumers=(old,), options=OPTIONS)
    return diff_json.render(compare(request))


def stored(tree: Tree, folder: Path) -> Iterator[Stored]:
    """The tree as an extract document and as documents of its packages."""
    extraction = extract(tree, msgspec.structs.replace(OPTIONS, hub=True))
    yield read_stored(str(write_document(json_document(extraction), folder / "extract.json")))
    write_manifests(extraction, folder / "packages")
    yield read_stored(str(folder / "packages"))


@pytest.mark.parametrize("pair", sorted(PAIRS.iterdir()), ids=lambda path: path.name)
def test_documents_of_a_pair_say_what_its_sources_say(pair: Path, tmp_path: Path) -> None:
    if not (pair / "bad").is_dir() or not (pair / "good").is_dir():
        pytest.skip("no pair")
    old, new = (open_tree(str(pair / side)) for side in ("bad", "good"))
    expected = document_of(old, new)
    forms = zip(stored(old, tmp_path / "bad"), stored(new, tmp_path / "good"), strict=True)
    for before, after in forms:
        assert document_of(before, after) == expected
