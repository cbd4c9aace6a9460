"""Profiles: what a robot has, what its governance allows, what is installed on it, what a caller brings.

Source: paper, "System Overview" and "Installation Compatibility". A field that is left out says nothing:
what needs it is decided as `review`, never silently.
"""

from __future__ import annotations

from typing import Any, Final

import msgspec

from ecm_checker.terms import normal_keys


class Embodiment(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What the robot has.

    Attributes:
        name: of the robot.
        sensors, actuators: `kind`, `kind@mount` or `kind@30Hz`.
        compute: amounts, e.g. `{cpu_cores: 8, gpu: true, gpu_memory: 8 GB}`.
        control_hz: fastest control loop that it runs, in hertz.
        latency_ms: shortest latency that it guarantees, in milliseconds.
        latency_budget_ms: longest time that a chain of modules may take, in milliseconds.
        command_interfaces: exported by its hardware, e.g. `joint1/position`.
        transforms: pairs of frames between which a transform is published.
    """

    name: str = ""
    sensors: tuple[str, ...] | None = None
    actuators: tuple[str, ...] | None = None
    compute: dict[str, Any] | None = None
    control_hz: float | None = None
    latency_ms: float | None = None
    latency_budget_ms: float | None = None
    command_interfaces: tuple[str, ...] | None = None
    transforms: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        """Read keys as contracts do."""
        if self.compute is not None:
            msgspec.structs.force_setattr(self, "compute", normal_keys(self.compute))


class Policy(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What governance allows.

    Attributes:
        name: of the policy.
        physical: allowed scopes and limits: a truth value for a scope (`motion`, `restricted_zone`,
            `human_contact`), a number for a limit (`max_force_n`, `human_proximity` as the least distance).
        data: data permissions granted; `read:*` grants all reads.
        network: true, false, or the hosts and services that may be reached.
        operational: operational permissions granted.
        audit: strongest audit that is offered: none, basic, standard, full.
        release_channels: channels that may run.
        forbidden_together: permissions that no composition may hold between them.
    """

    name: str = ""
    physical: dict[str, Any] | None = None
    data: tuple[str, ...] | None = None
    network: bool | tuple[str, ...] | None = None
    operational: tuple[str, ...] | None = None
    audit: str | None = None
    release_channels: tuple[str, ...] | None = None
    forbidden_together: tuple[tuple[str, ...], ...] = ()

    def __post_init__(self) -> None:
        """Read keys as contracts do."""
        if self.physical is not None:
            msgspec.structs.force_setattr(self, "physical", normal_keys(self.physical))


class Runtime(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What is installed and holds.

    Attributes:
        name: of the deployment.
        versions: of services, packages and modules.
        complete: whether `versions` names everything that is installed.
        locks: exclusive resource -> module that holds it.
        states: names of states that the system can return to; None when not known.
        facts: what is known to hold, e.g. `{arm_ready: true, localization_confidence: 0.95}`.
    """

    name: str = ""
    versions: dict[str, str] = {}
    complete: bool = True
    locks: dict[str, str] = {}
    states: tuple[str, ...] | None = None
    facts: dict[str, Any] = {}


class Call(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """What a caller brings to an invocation.

    Attributes:
        caller: who calls.
        inputs: fields as in a contract's `input_schema`.
        state: what holds now.
        handles: failure modes that the caller can handle; `*` for all; None when not known.
        completion: completion semantics that it can go on from; None when not known.
    """

    caller: str = "caller"
    inputs: Any = None
    state: dict[str, Any] = {}
    handles: tuple[str, ...] | None = None
    completion: tuple[str, ...] | None = None


class Profiles(msgspec.Struct, frozen=True):
    """The profiles of a check; None when not given."""

    embodiment: Embodiment | None = None
    policy: Policy | None = None
    runtime: Runtime | None = None


NO_PROFILES: Final = Profiles()
