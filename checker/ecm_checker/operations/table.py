"""Which dimensions and which sub-checks each operation consults.

Source: paper, table "Compatibility Operations and Checked Contract Dimensions" and the operators below it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal

import msgspec

from ecm_checker.finding import DIMENSIONS, Dimension
from ecm_checker.rule import SubCheck

Name = Literal["install", "invoke", "compose", "chain", "upgrade", "system"]
Profile = Literal["embodiment", "policy", "runtime"]

_WITHOUT_VERSIONING: Final = DIMENSIONS[:5]


class Operation(msgspec.Struct, frozen=True):
    """One row of the table."""

    name: Name
    dimensions: tuple[Dimension, ...]
    sub_checks: tuple[SubCheck, ...]


_COMPOSE: Final[tuple[SubCheck, ...]] = ("SigMatch", "BehMatch", "ResJointSat", "PermChainSafe", "RecMatch")

OPERATIONS: Final[Mapping[Name, Operation]] = {
    row.name: row
    for row in (
        Operation(
            "install",
            ("resources", "permissions", "versioning"),
            ("DepSat", "ResSat", "PermSat", "Complete", "LockSafe"),
        ),
        Operation("invoke", _WITHOUT_VERSIONING, ("InputSat", "PreSat", "AllocSat", "PermSat", "FailureSat")),
        Operation("compose", _WITHOUT_VERSIONING, _COMPOSE),
        Operation("chain", _WITHOUT_VERSIONING, (*_COMPOSE, "GlobalSafe")),
        Operation("upgrade", DIMENSIONS, ("DepSat", "DepPreserve", "PermDeltaSafe", "ResDeltaSafe", "RecDeltaSafe")),
        Operation("system", _WITHOUT_VERSIONING, (*_COMPOSE, "GlobalSafe")),
    )
}

# A sub-check of which nothing can be asked without this profile.
NEEDS: Final[Mapping[SubCheck, Profile]] = {
    "DepSat": "runtime",
    "LockSafe": "runtime",
    "AllocSat": "runtime",
    "ResSat": "embodiment",
    "ResJointSat": "embodiment",
    "PermSat": "policy",
    "PermChainSafe": "policy",
}
