"""What a blind run leaves behind: findings of each state, and a chain of hashes that ties them to their inputs."""

from __future__ import annotations

from typing import Final, Literal

import msgspec
from ecm_checker.finding import Finding

from ecm_corpus.interface import Substrate

SCHEMA: Final = "ecm-corpus/results/2"

Engine = Literal["check", "diff", "lint"]
ENGINES: Final[tuple[Engine, ...]] = ("check", "diff", "lint")


class Versions(msgspec.Struct, frozen=True):
    """Old and new version number of a package in an upgrade; None when it has none."""

    package: str
    old: str | None
    new: str | None


class StateResult(msgspec.Struct, frozen=True, kw_only=True):
    """What was said of one state.

    Attributes:
        question: `composition` or `upgrade`.
        commits: `owner/name@ref` -> commit id.
        documents: `<side>/<package>` -> SHA-256 of its document, the name of its file in the store. Sides are `tree`
            and `launched` in a composition, and `old`, `new` and `consumer` in an upgrade.
        versions: of the packages that are upgraded.
        findings: by engine: the pinned checker over the documents, consumers against the changed entities, and the
            linter over the trees.
    """

    question: Literal["composition", "upgrade"]
    commits: dict[str, str]
    documents: dict[str, str]
    versions: tuple[Versions, ...]
    findings: dict[Engine, tuple[Finding, ...]]


class CaseResult(msgspec.Struct, frozen=True, kw_only=True):
    """One link of the chain.

    Attributes:
        case, substrate: as in the interface part.
        input: SHA-256 of the interface part. output: of the states.
        previous: hash of the link before; empty for the first.
        hash: SHA-256 over all of these, the extractor and the checker.
        missing: repositories without a local clone, as URLs; then there are no states.
        states: by name.
    """

    case: str
    substrate: Substrate
    input: str
    output: str
    previous: str
    hash: str
    missing: tuple[str, ...] = ()
    states: dict[str, StateResult]


class Results(msgspec.Struct, frozen=True, kw_only=True):
    """`corpus/results.json`.

    Attributes:
        extractor: version, and SHA-256 over its sources.
        checker: content hash of the pinned checker.
        cases: the chain, in the order of their ids.
    """

    schema: str
    version: str
    extractor: str
    checker: str
    cases: tuple[CaseResult, ...]
