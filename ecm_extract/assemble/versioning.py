"""Versioning: dependencies of the manifest, public entities of interface files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from ecm_checker.contract import Entity, Evidence, Use, Value, Versioning
from ecm_parsers.interface_facts import Definition

from ecm_extract.assemble.definitions import Definitions
from ecm_extract.read.facts import PackageFacts


def versioning_of(facts: PackageFacts, definitions: Definitions | None = None) -> Versioning:
    """Return the versioning section of a module of a package.

    Args:
        facts: of the package.
        definitions: given, what its interface files declare is listed too, messages with their fingerprint.
    """
    manifest = facts.manifest
    entities = tuple(_entities(facts, definitions)) if definitions is not None else ()
    uses = tuple(_uses(facts)) if definitions is not None else ()
    if manifest is None or facts.root.manifest is None:
        return Versioning(entities=entities, uses=uses)
    path = facts.root.manifest
    ranges: dict[str, str] = {}
    for entry in manifest.dependencies:
        if entry.kind not in {"test", "doc"}:
            ranges.setdefault(entry.name, " ".join(f"{sign}{version}" for sign, version in entry.versions) or "*")
    evidence = tuple(Evidence(path, entry.line) for entry in manifest.dependencies[:1])
    deprecated = None
    if manifest.deprecated is not None:
        deprecated = Value(manifest.deprecated, "inferred", "literal", (Evidence(path, manifest.line),))
    return Versioning(
        dependencies=Value(ranges, "inferred", "literal", evidence),
        deprecated=deprecated,
        entities=entities,
        uses=uses,
    )


def _uses(facts: PackageFacts) -> Iterator[Use]:
    """Topics that recorders of the package record, and diagnostics that its aggregators expect."""
    for path, recorders in sorted(facts.recorders.items()):
        for recorder in recorders:
            for topic in recorder.topics:
                yield Use("topic", topic, (Evidence(path, recorder.line),))
    for path, file in sorted(facts.aggregators.items()):
        for aggregator in file.aggregators:
            for analyzer in aggregator.analyzers:
                for name in (*analyzer.expected, *analyzer.names):
                    yield Use("diagnostic", name, (Evidence(path, analyzer.line),))


def _entities(facts: PackageFacts, definitions: Definitions) -> Iterator[Entity]:
    for path, definition in sorted(facts.interfaces.items()):
        name = f"{facts.name}/{definition.shape}/{PurePosixPath(path).stem}"
        fingerprint = definitions.fingerprint(name, definition, facts.ros).value
        yield Entity("message", facts.name, "", name, (Evidence(path, 1),), fingerprint)
        yield from _of_interface(facts.name, name, path, definition)


def _of_interface(package: str, name: str, path: str, definition: Definition) -> Iterator[Entity]:
    for section in definition.sections:
        prefix = "" if section.name == "message" else f"{section.name}."
        for field in section.fields:
            evidence = (Evidence(path, field.line),)
            yield Entity("message_field", package, name, prefix + field.name, evidence, field.type, field.default)
        for constant in section.constants:
            evidence = (Evidence(path, constant.line),)
            yield Entity("constant", package, name, prefix + constant.name, evidence, constant.type, constant.value)
