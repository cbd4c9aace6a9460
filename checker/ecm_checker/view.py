"""A contract made ready for rules: endpoints by role and name, free-form values in one shape.

Made once per contract, so that a check of a pair only compares.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import msgspec

from ecm_checker import terms
from ecm_checker.contract import Contract, Evidence, Interface, Value
from ecm_checker.hub.roles import Role, roles, writing_roles
from ecm_checker.names import is_known, near_keys
from ecm_checker.predicates import Predicate, parse

Endpoints = Mapping[str, tuple[Interface, ...]]

_KINDS_THAT_DO_NOT_RUN: Final = frozenset({"interface", "library"})
_NONE: Final[Endpoints] = {}


class View(msgspec.Struct, frozen=True, kw_only=True):
    """What rules read of one module; None is undeclared. Fields are named after those of the contract."""

    contract: Contract
    id: str
    package: str
    runs: bool
    by_role: Mapping[Role, Endpoints]
    near_keys: Mapping[Role, frozenset[str]]
    unmatched: tuple[Interface, ...]
    inputs: tuple[terms.Field, ...] | None
    outputs: tuple[terms.Field, ...] | None
    preconditions: tuple[Predicate, ...] | None
    postconditions: tuple[Predicate, ...] | None
    invariants: tuple[Predicate, ...] | None
    assumptions: tuple[Predicate, ...] | None
    completion: str | None
    rates: Mapping[str, float]
    sensors: tuple[terms.Spec, ...] | None
    actuators: tuple[terms.Spec, ...] | None
    compute: Mapping[str, Any] | None
    timing: Mapping[str, Any] | None
    locks: tuple[str, ...] | None
    physical: Mapping[str, Any] | None
    data: tuple[str, ...] | None
    network: tuple[str, ...] | bool | None
    operational: tuple[str, ...] | None
    audit: str | None
    failure_modes: Mapping[str, Any] | None
    rollback: str | None
    retry: terms.Retry | None
    safe_stop: tuple[str, ...] | None
    escalation: tuple[terms.Escalation, ...] | None
    dependencies: Mapping[str, Any] | None

    def endpoints(self, role: Role) -> Endpoints:
        """Endpoints of a role whose name is known, by name."""
        return self.by_role.get(role, _NONE)

    @property
    def written(self) -> Iterator[Interface]:
        """What it gives to whoever listens, under names that are known."""
        return (each for role in writing_roles() for named in self.endpoints(role).values() for each in named)

    def evidence(self, *paths: str) -> tuple[Evidence, ...]:
        """Where fields (`section.field`) were read."""
        found: list[Evidence] = []
        for path in paths:
            section, _, name = path.partition(".")
            value: Value | None = getattr(getattr(self.contract, section), name)
            found.extend(value.evidence if value is not None else ())
        return tuple(found)

    def moves(self) -> bool:
        """Whether it declares that it moves the robot."""
        return bool(self.actuators) or bool((self.physical or {}).get("motion"))


def view(contract: Contract) -> View:
    """Make a contract ready for rules."""
    behavior, resources, recovery = contract.behavior, contract.resources, contract.recovery
    signature = contract.signature
    by_role = _by_role(signature.interfaces)
    return View(
        contract=contract,
        id=contract.ecm.module_id,
        package=contract.ecm.package,
        runs=contract.ecm.kind not in _KINDS_THAT_DO_NOT_RUN,
        by_role=by_role,
        near_keys={role: near_keys(by_role[role]) for role, row in roles().items() if row.peer and role in by_role},
        unmatched=tuple(entry for entry in signature.interfaces if not _is_matched(entry)),
        inputs=_fields(signature.input_schema),
        outputs=_fields(signature.output_schema),
        preconditions=_predicates(behavior.preconditions),
        postconditions=_predicates(behavior.postconditions),
        invariants=_predicates(behavior.invariants),
        assumptions=_predicates(behavior.assumptions),
        completion=terms.word(behavior.completion_semantics),
        rates=terms.rates(behavior.rates),
        sensors=terms.specs(resources.sensors),
        actuators=terms.specs(resources.actuators),
        compute=terms.normal_pairs(resources.compute),
        timing=terms.normal_pairs(resources.timing),
        locks=_known(terms.texts(resources.exclusive_locks)),
        failure_modes=terms.pairs(recovery.failure_modes),
        rollback=terms.word(recovery.rollback_state),
        retry=terms.retry(recovery.retry),
        safe_stop=terms.texts(recovery.safe_stop),
        escalation=terms.escalations(recovery.escalation),
        dependencies=terms.pairs(contract.versioning.dependencies),
        **_permissions(contract),
    )


def _permissions(contract: Contract) -> dict[str, Any]:
    permissions = contract.permissions
    network = permissions.network
    truth = network.value if network is not None and isinstance(network.value, bool) else None
    return {
        "physical": terms.normal_pairs(permissions.physical),
        "data": terms.texts(permissions.data),
        "network": terms.texts(network) if truth is None else truth,
        "operational": terms.texts(permissions.operational),
        "audit": terms.word(permissions.audit),
    }


def _by_role(interfaces: Iterable[Interface]) -> dict[Role, Endpoints]:
    found: defaultdict[Role, defaultdict[str, list[Interface]]] = defaultdict(lambda: defaultdict(list))
    for entry in interfaces:
        if _is_matched(entry):
            found[entry.role][entry.name].append(entry)
    return {role: {name: tuple(entries) for name, entries in by_name.items()} for role, by_name in found.items()}


def _is_matched(entry: Interface) -> bool:
    return is_known(entry.name) and entry.confidence != "pattern"


def _fields(value: Value | None) -> tuple[terms.Field, ...] | None:
    return None if value is None else terms.fields(value.value)


def _predicates(value: Value | None) -> tuple[Predicate, ...] | None:
    found = terms.texts(value)
    return None if found is None else tuple(map(parse, found))


def _known(names: tuple[str, ...] | None) -> tuple[str, ...] | None:
    return None if names is None else tuple(dict.fromkeys(filter(is_known, names)))
