"""The contract of one module: six sections, every value with where it was read.

Source: paper, sections "Contract Model" and "Complete Contract Schema"; field names are the wire names.
A field that is None is *undeclared*; an empty list means that an artefact shows there is none.
"""

from __future__ import annotations

from typing import Any, Literal

import msgspec

from ecm_checker.hub.condition import Condition
from ecm_checker.hub.roles import Role, RoleKind, roles

Confidence = Literal["literal", "folded", "default", "one_of", "pattern"]
Origin = Literal["declared", "observed", "inferred", "default"]


class Evidence(msgspec.Struct, frozen=True, omit_defaults=True, gc=False):
    """A place in a tree: path relative to its root, 1-based line, 1-based column in characters where it is known."""

    path: str
    line: int
    end_line: int | None = None
    commit: str | None = None
    column: int | None = None


class Qos(msgspec.Struct, frozen=True, omit_defaults=True):
    """DDS policies of an endpoint; a policy not set in source has its default and is named in `defaulted`.

    Durations are in milliseconds; None is infinite. `profile` is the preset it was built from, such as
    `sensor_data`.
    """

    reliability: str | None = None
    durability: str | None = None
    history: str | None = None
    depth: int | None = None
    deadline_ms: float | None = None
    lifespan_ms: float | None = None
    liveliness: str | None = None
    lease_ms: float | None = None
    profile: str | None = None
    defaulted: tuple[str, ...] = ()


class Interface(msgspec.Struct, frozen=True):
    """One ROS endpoint or parameter of a module.

    Attributes:
        role: what the module does with it.
        name: resolved in the namespace `/`; a part that no artefact shows stays as `{hole}`.
        raw_name: as written in source, after folding.
        type: `package/msg|srv|action/Name`, or the parameter's type; None when not known.
        qos: ROS 2 policies, ROS 1 queue size as depth; None for parameters and transforms.
        default: of a parameter, as data; None when it has none or it cannot be folded.
        frame: `header.frame_id` or the transform's frames, where seen.
        confidence: `literal`, `folded` (computed from constants, exactly this one), `default` (from a parameter's
            default), `one_of` (one of several that the code can give it), `pattern`.
        evidence: the line that names it first, the outermost call of wrappers, then inwards; see the manual.
        inherited_from: class or package that brings it, when not the module itself.
        when: conditions under which it is made, as far as they are known; all of them hold then.
        needed: of a parameter, whether the module stops where nobody sets it.
    """

    role: Role
    name: str
    raw_name: str
    type: str | None
    qos: Qos | None
    frame: str | None
    confidence: Confidence
    evidence: tuple[Evidence, ...]
    default: Any = None
    inherited_from: str | None = None
    when: tuple[Condition, ...] = ()
    needed: bool = False

    @property
    def row(self) -> RoleKind:
        """What its role is to others."""
        return roles()[self.role]


class Source(msgspec.Struct, frozen=True):
    """Where the module was read: repository, commit, and the file in it that declares the module."""

    repository: str | None
    commit: str | None
    path: str


class Identity(msgspec.Struct, frozen=True):
    """Section `ecm`: which module this is.

    `kind`: node, component, nodelet, controller, hardware, plugin, script; of a package without any of them interface,
    launch (it only starts others) or library.
    """

    module_id: str
    package: str
    kind: str
    version: str | None
    source: Source
    ros: Literal[1, 2] | None
    release_channel: str | None = None
    compatibility_class: str | None = None


class Value(msgspec.Struct, frozen=True, omit_defaults=True):
    """A contract field with its origin: what is known, how surely, and from which lines."""

    value: Any
    origin: Origin
    confidence: Confidence = "literal"
    evidence: tuple[Evidence, ...] = ()

    def __post_init__(self) -> None:
        """Hold the default itself, which msgspec leaves out by identity: equal values are equal bytes."""
        if self.confidence == "literal":
            msgspec.structs.force_setattr(self, "confidence", "literal")


class Signature(msgspec.Struct, frozen=True):
    """What the module computes, in what representation."""

    interfaces: tuple[Interface, ...] = ()
    input_schema: Value | None = None
    output_schema: Value | None = None
    coordinate_frame: Value | None = None
    timeout_ms: Value | None = None
    invocation_mode: Value | None = None
    state_object: Value | None = None


class Behavior(msgspec.Struct, frozen=True):
    """Under what conditions its behavior matches its specification."""

    preconditions: Value | None = None
    postconditions: Value | None = None
    invariants: Value | None = None
    assumptions: Value | None = None
    completion_semantics: Value | None = None
    rates: Value | None = None
    qos: Value | None = None


class Resources(msgspec.Struct, frozen=True):
    """What it needs of the robot and the computer."""

    sensors: Value | None = None
    actuators: Value | None = None
    compute: Value | None = None
    timing: Value | None = None
    communication: Value | None = None
    exclusive_locks: Value | None = None


class Permissions(msgspec.Struct, frozen=True):
    """What it must be authorised to do."""

    physical: Value | None = None
    data: Value | None = None
    network: Value | None = None
    operational: Value | None = None
    audit: Value | None = None


class Recovery(msgspec.Struct, frozen=True):
    """How it fails and what the system can rely on when it does."""

    failure_modes: Value | None = None
    rollback_state: Value | None = None
    retry: Value | None = None
    safe_stop: Value | None = None
    escalation: Value | None = None


class Entity(msgspec.Struct, frozen=True, omit_defaults=True):
    """A public name that others can depend on; kinds: topic, parameter, message_field, ..."""

    kind: str
    package: str
    owner: str
    name: str
    evidence: tuple[Evidence, ...]
    signature: str | None = None
    default: Any = None


class Use(msgspec.Struct, frozen=True, omit_defaults=True):
    """A place that depends on an entity; `package` and `owner` are None where the name alone is known."""

    kind: str
    name: str
    evidence: tuple[Evidence, ...]
    package: str | None = None
    owner: str | None = None
    signature: str | None = None


class Versioning(msgspec.Struct, frozen=True):
    """How it relates to its predecessor and its dependencies."""

    compat_level: Value | None = None
    dependencies: Value | None = None
    deprecated: Value | None = None
    resource_change: Value | None = None
    policy_change: Value | None = None
    entities: tuple[Entity, ...] = ()
    uses: tuple[Use, ...] = ()


class Contract(msgspec.Struct, frozen=True):
    """The six dimensions of one module, and which required fields nothing fills."""

    ecm: Identity
    signature: Signature = Signature()
    behavior: Behavior = Behavior()
    resources: Resources = Resources()
    permissions: Permissions = Permissions()
    recovery: Recovery = Recovery()
    versioning: Versioning = Versioning()
    missing: tuple[str, ...] = ()
