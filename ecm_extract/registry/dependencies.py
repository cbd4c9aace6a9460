"""What a package depends on, as its contracts say."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.contract import Contract


def dependencies_of(contracts: Iterable[Contract]) -> dict[str, str]:
    """Return the ranges of versions that contracts name, by package; `*` for any."""
    found: dict[str, str] = {}
    for contract in contracts:
        declared = contract.versioning.dependencies
        if declared is not None and isinstance(declared.value, dict):
            found |= {str(name): str(wanted or "*") for name, wanted in declared.value.items()}
    return found
