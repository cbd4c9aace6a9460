"""Facts of source files by content."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from cache_trees import extraction, keys, package
from ecm_parsers.result import Diagnostic
from ecm_parsers.source import cpp, python
from ecm_parsers.source.facts import Function, SourceFile

from ecm_extract.cache.blobs import BlobCache
from ecm_extract.cache.store import Store
from ecm_extract.read import parallel
from ecm_extract.read.parsed_file import BlobFacts
from ecm_extract.read.reader import Reader
from ecm_extract.read.select import SourceKind
from ecm_extract.tree import open_tree

FACTS = BlobFacts(
    3, SourceFile("cpp", functions=(Function("f", "", (), "", 1, 1),)), (Diagnostic("info", "c", 1, "m"),)
)
SLOW = BlobFacts(3, SourceFile("cpp"), (Diagnostic("warning", "cpp-too-slow", 0, "m"),))


@pytest.fixture
def parsed(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """Contents that were parsed since."""
    found: list[bytes] = []
    real = parallel.parse_source

    def parse(data: bytes, kind: SourceKind) -> object:
        found.append(data)
        return real(data, kind)

    monkeypatch.setattr(parallel, "parse_source", parse)
    return found


def test_facts_come_back_whole(store: Store) -> None:
    """Facts, diagnostics and size are those of the parser."""
    BlobCache(store).add({("cpp", "b"): FACTS, ("script", "c"): BlobFacts(1, None)})
    known = BlobCache(store).known([("cpp", "b"), ("script", "c"), ("python", "b")])
    assert known == {("cpp", "b"): FACTS, ("script", "c"): BlobFacts(1, None)}


def test_time_limit_is_not_kept(store: Store) -> None:
    """A machine that has more time may read more."""
    BlobCache(store).add({("cpp", "b"): SLOW})
    assert BlobCache(store).known([("cpp", "b")]) == {}


def test_parsers_name_their_time_limit_alike() -> None:
    """The codes by which the cache knows a cut result are those that the parsers give."""
    for module in (cpp, python):
        source = Path(str(module.__file__)).read_text("utf-8")
        assert "-too-slow" in source


def test_other_version_is_not_read(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """What another version of the program has kept is not even decoded."""
    BlobCache(store).add({("cpp", "b"): FACTS})
    monkeypatch.setattr("ecm_extract.cache.blobs.version_of", lambda packages: "other")
    monkeypatch.setattr(msgspec.msgpack, "Decoder", _never_decoding)
    assert BlobCache(store).known([("cpp", "b")]) == {}


def test_no_version_keeps_nothing(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """A program that cannot tell its version does without."""
    monkeypatch.setattr("ecm_extract.cache.blobs.version_of", lambda packages: "")
    BlobCache(store).add({("cpp", "b"): FACTS})
    assert BlobCache(store).known([("cpp", "b")]) == {}
    assert not store.folder.exists()


def test_foreign_value_is_parsed_again(store: Store) -> None:
    """A value that does not decode is not known."""
    cache = BlobCache(store)
    cache.add({("cpp", "b"): FACTS})
    (key,) = [f"facts {cache._version} cpp b"]
    store.put({key: b"\xc1"})
    assert cache.known([("cpp", "b")]) == {}


def test_content_is_parsed_once(store: Store, tmp_path: Path, parsed: list[bytes]) -> None:
    """The same content in another place is taken from the cache: also a script that is no Python."""
    Reader(open_tree(package(tmp_path / "one"))).read(1)
    assert len(parsed) == 3
    found = Reader(open_tree(package(tmp_path / "two"))).read(1)
    assert len(parsed) == 3
    assert sorted(found[0].sources) == ["pkg/b.py", "src/a.cpp"]


def test_changed_content_is_parsed(store: Store, tmp_path: Path, parsed: list[bytes]) -> None:
    """Of a changed tree only the changed file is parsed."""
    extraction(package(tmp_path / "one"))
    del parsed[:]
    extraction(package(tmp_path / "one", "other"))
    assert len(parsed) == 1
    assert b"other" in parsed[0]


def test_switched_off_cache_is_left_alone(store: Store, tmp_path: Path, parsed: list[bytes]) -> None:
    """Without the cache everything is parsed, and nothing kept."""
    for _ in range(2):
        extraction(package(tmp_path / "one"), cache=False)
    assert len(parsed) == 6
    assert keys(store) == []


def _never_decoding(kind: object) -> object:
    class Decoder:
        def decode(self, data: bytes) -> object:
            raise AssertionError

    return Decoder()
