"""Analyzers of diagnostics: the nodes whose names they strip off, which those who publish must be called by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.diagnostics_yaml import Analyzer

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required


def diagnostic_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield the nodes that the analyzers of a package expect, as far as a prefix is a name."""
    for path, file in facts.aggregators.items():
        for aggregator in file.aggregators:
            for analyzer in _all(aggregator.analyzers):
                yield from _of(analyzer, Place(path, analyzer.line, f"analyzer {analyzer.key}"))


def _all(analyzers: Iterable[Analyzer]) -> Iterator[Analyzer]:
    for analyzer in analyzers:
        yield analyzer
        yield from _all(analyzer.analyzers)


def _of(analyzer: Analyzer, place: Place) -> Iterator[Requirement]:
    for prefix in (*analyzer.remove_prefix, *analyzer.find_and_remove_prefix):
        node = prefix.strip("/: ")
        if node.replace("_", "").isalnum():
            yield required("strips_prefix", node, place, "likely", said=analyzer.key)
