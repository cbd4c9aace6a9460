"""Extraction: one tree in, the contracts of its packages out."""

from __future__ import annotations

import time

import msgspec

from ecm_extract.extraction_model import Extraction, Options
from ecm_extract.tree import Tree


def extract(tree: Tree, options: Options | None = None) -> Extraction:
    """Read the contracts of every package of a tree.

    Raises:
        TreeError: the tree cannot be listed.
        ConfigError: `ecm.toml` is wrong.
    """
    options = options or Options()
    started = time.perf_counter()
    extraction = _remembered(tree, options) if options.cache else _read(tree, options)
    return msgspec.structs.replace(extraction, elapsed=time.perf_counter() - started)


def _read(tree: Tree, options: Options) -> Extraction:
    # Half of a warm run would go into importing what only a cold one needs.
    from ecm_extract.extraction_run import read_contracts

    return read_contracts(tree, options)[0]


def _remembered(tree: Tree, options: Options) -> Extraction:
    """Take the extraction from the cache, or read the tree and keep it."""
    from ecm_extract.cache.extractions import ExtractionCache

    cache = ExtractionCache(tree, options)
    known = cache.known()
    if known is not None:
        return known
    from ecm_extract.cache.recorded_tree import RecordedTree
    from ecm_extract.extraction_run import read_contracts

    recorded = RecordedTree(tree)
    extraction, sources = read_contracts(recorded, options)
    for path, blob in sources.items():
        recorded.saw(path, blob)
    if recorded.stable:
        cache.add(extraction, recorded.blobs)
    return extraction
