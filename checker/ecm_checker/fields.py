"""The fields of a contract and which of them a complete contract must fill.

Source: paper, table "ECM Contract Schema" (column Req.). Where the paper's name differs from the contract
model's (`coord_frame`, `handoff_semantics`, `physical_perms`, ...) it is kept beside it.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Final, NamedTuple

from ecm_checker.contract import Contract


class FieldRow(NamedTuple):
    """One row of the table: where the field is in a contract and whether it must be filled.

    Attributes:
        path: `section.field` of the contract model.
        paper_name: as the paper spells it; empty for a field that the table does not have.
        required: column Req.
        meaning: one line for people.
    """

    path: str
    paper_name: str
    required: bool
    meaning: str


FIELDS: Final = (
    FieldRow("ecm.module_id", "module_id", True, "name of the module: ecm.<package>.<module>"),
    FieldRow("ecm.version", "version", True, "semantic version of the package that releases it"),
    FieldRow("signature.input_schema", "input_schema", True, "what it consumes, with units and frames"),
    FieldRow("signature.output_schema", "output_schema", True, "what it produces, with units and frames"),
    FieldRow("signature.coordinate_frame", "coord_frame", True, "frame in which its data is given"),
    FieldRow("signature.timeout_ms", "timeout_ms", True, "how long a call may take, in milliseconds"),
    FieldRow("signature.invocation_mode", "", False, "synchronous, asynchronous or event-triggered"),
    FieldRow("signature.state_object", "", False, "observable state, for monitoring"),
    FieldRow("behavior.preconditions", "preconditions", True, "what must hold before it is activated"),
    FieldRow("behavior.postconditions", "postconditions", True, "what holds after it succeeded"),
    FieldRow("behavior.invariants", "invariants", False, "what holds throughout"),
    FieldRow("behavior.assumptions", "", False, "what it takes for granted of the world"),
    FieldRow("behavior.completion_semantics", "handoff_semantics", True, "what 'done' means to the next module"),
    FieldRow("behavior.rates", "", False, "how often it acts, in hertz"),
    FieldRow("behavior.qos", "", False, "delivery policies, per endpoint"),
    FieldRow("resources.sensors", "sensors", True, "sensors that it reads"),
    FieldRow("resources.actuators", "actuators", True, "actuators that it moves"),
    FieldRow("resources.compute", "compute", True, "processor, GPU and memory that it needs"),
    FieldRow("resources.timing", "", False, "control period and latency bounds"),
    FieldRow("resources.communication", "", False, "bandwidth, transports, shared memory"),
    FieldRow("resources.exclusive_locks", "exclusive_locks", False, "what only one module may hold at a time"),
    FieldRow("permissions.physical", "physical_perms", True, "motion, zones and forces that it must be allowed"),
    FieldRow("permissions.data", "data_perms", False, "data that it must be allowed to read or write"),
    FieldRow("permissions.network", "", False, "hosts and services that it talks to"),
    FieldRow("permissions.operational", "", False, "irreversible or safety-critical acts"),
    FieldRow("permissions.audit", "audit_req", False, "what must be logged"),
    FieldRow("recovery.failure_modes", "failure_modes", True, "how it fails, with a severity each"),
    FieldRow("recovery.rollback_state", "rollback_state", True, "safe state that it returns to"),
    FieldRow("recovery.retry", "retry_policy", True, "whether, how often and how it tries again"),
    FieldRow("recovery.safe_stop", "", False, "what it does when it cannot recover"),
    FieldRow("recovery.escalation", "escalation", True, "who is called when retries are used up"),
    FieldRow("versioning.compat_level", "compat_level", True, "compatibility with the release before"),
    FieldRow("versioning.dependencies", "dependencies", True, "what it needs, with version ranges"),
    FieldRow("versioning.deprecated", "", False, "whether it is going away, and what replaces it"),
    FieldRow("versioning.resource_change", "", False, "resources differ from the release before"),
    FieldRow("versioning.policy_change", "policy_change", True, "permissions differ from the release before"),
)


def required_fields(kind: str = "node") -> tuple[str, ...]:
    """Paths of the fields that a complete contract fills, in the order of the table.

    Args:
        kind: of the module; one that is not known needs what a node needs.
    """
    every = tuple(row.path for row in FIELDS if row.required)
    wanted = _by_kind().get(kind, every)
    return tuple(path for path in every if path in wanted)


def missing_fields(contract: Contract) -> tuple[str, ...]:
    """Fields that a module of its kind needs and nothing declares, infers or defaults, in the order of the table."""
    return tuple(path for path in required_fields(contract.ecm.kind) if _read(contract, path) is None)


def runs_by_itself(kind: str) -> bool:
    """Whether a module of a kind runs, and so can be seen to run."""
    return kind not in _by_kind()


@cache
def _by_kind() -> Mapping[str, tuple[str, ...]]:
    text = (resources.files("ecm_checker") / "data" / "required.toml").read_text("utf-8")
    return MappingProxyType({kind: tuple(paths) for kind, paths in tomllib.loads(text)["kinds"].items()})


def _read(contract: Contract, path: str) -> object:
    section, field = path.split(".")
    return getattr(getattr(contract, section), field)
