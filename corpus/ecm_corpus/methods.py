"""The methods that are compared: ours with all engines, the pinned checker alone, and the paper's three baselines.

Source: paper section "Methods compared". A baseline sees the findings of the rules that it would have too.
"""

from __future__ import annotations

from functools import cache
from typing import Final

from ecm_checker.catalogue import catalogue
from ecm_checker.finding import Dimension, Finding
from ecm_checker.rule import Tier
from ecm_checker.versions import bump_between

from ecm_corpus.grade import Counts, Method
from ecm_corpus.results import Engine, Versions

_SCHEMA_LINT: Final = frozenset({"LNT007", "LNT010", "LNT017"})
"""Lint rules that compare or resolve interface types, as rosidl and a topic connection do."""
_QOS_LINT: Final = frozenset({"LNT008"})


def full() -> Method:
    """Everything: contracts through the checker, changes against consumers, lint."""
    return Method("ECM (all engines)", lambda _engine, _finding: True)


def checker_only() -> Method:
    """The pinned checker over contracts, which is what the paper calls ECM-full."""
    return Method("checker alone", lambda engine, _finding: engine == "check")


def without_engine(left_out: Engine) -> Method:
    """Everything but one engine."""
    return Method(f"without {left_out}", lambda engine, _finding: engine != left_out)


def without_dimension(left_out: Dimension) -> Method:
    """Everything but one dimension."""
    return Method(f"without {left_out}", lambda _engine, finding: finding.dimension != left_out)


def baselines() -> tuple[Method, ...]:
    """Schema-only, schema+QoS and semver-only."""
    return (
        Method("schema only", _of_tiers(("schema",), _SCHEMA_LINT)),
        Method("schema + QoS", _of_tiers(("schema", "qos"), _SCHEMA_LINT | _QOS_LINT)),
        Method("semver only", _of_tiers(("semver",), frozenset()), _is_major),
    )


def _of_tiers(tiers: tuple[Tier, ...], lint: frozenset[str]) -> Counts:
    rules = _rules(tiers) | lint

    def counts(_engine: Engine, finding: Finding) -> bool:
        return finding.rule in rules

    return counts


@cache
def _rules(tiers: tuple[Tier, ...]) -> frozenset[str]:
    return frozenset(entry.rule.id for entry in catalogue() if entry.rule.tier in tiers)


def _is_major(versions: Versions) -> bool:
    """Before 1.0 nothing is promised, and no step is major."""
    return bump_between(versions.old, versions.new) == "major"
