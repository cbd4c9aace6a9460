"""What a person may declare of a module, field by field: the model behind `overlay.schema.json`.

The readers of `terms` take free forms of a field as one; here stands which forms there are. None is undeclared.
"""

from __future__ import annotations

from typing import Annotated, Any, Final, Literal

import msgspec
from msgspec import Meta

OVERLAY_SCHEMA: Final = "ecm-extract/overlay/1"

Text = Annotated[str, Meta(min_length=1)]
Names = Text | list[Any] | dict[str, Any]
"""Names: several, one, or a mapping whose keys they are."""
Milliseconds = Annotated[float, Meta(gt=0)]
Count = Annotated[float, Meta(ge=0)]
RetryWord = Annotated[str, Meta(pattern=r"^(retry_)?(once|twice|never|none|no_retry|forever|unlimited)$")]


class _Section(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Base of the sections."""


class Signature(_Section, frozen=True):
    """Fields of section `signature`."""

    input_schema: Names | None = None
    output_schema: Names | None = None
    coordinate_frame: Text | dict[str, Text] | None = None
    timeout_ms: Milliseconds | None = None
    invocation_mode: Text | None = None
    state_object: Names | None = None


class Behavior(_Section, frozen=True):
    """Fields of section `behavior`."""

    preconditions: Names | None = None
    postconditions: Names | None = None
    invariants: Names | None = None
    assumptions: Names | None = None
    completion_semantics: Text | None = None
    rates: dict[str, float | str] | None = None
    qos: dict[str, dict[str, Any]] | None = None


class Resources(_Section, frozen=True):
    """Fields of section `resources`."""

    sensors: Names | None = None
    actuators: Names | None = None
    compute: Names | None = None
    timing: Names | None = None
    communication: Names | None = None
    exclusive_locks: Names | None = None


class Permissions(_Section, frozen=True):
    """Fields of section `permissions`."""

    physical: Names | None = None
    data: Names | None = None
    network: bool | Names | None = None
    operational: Names | None = None
    audit: bool | Names | None = None


class Retry(msgspec.Struct, frozen=True):
    """How often it tries again at most, and whatever else is known of it."""

    max: Count


class Recovery(_Section, frozen=True):
    """Fields of section `recovery`."""

    failure_modes: Names | None = None
    rollback_state: Text | None = None
    retry: RetryWord | Count | Retry | None = None
    safe_stop: bool | Names | None = None
    escalation: Names | None = None


class Versioning(_Section, frozen=True):
    """Fields of section `versioning`."""

    compat_level: Text | None = None
    dependencies: Names | None = None
    deprecated: bool | Text | None = None
    resource_change: bool | None = None
    policy_change: bool | None = None


class Sections(_Section, frozen=True):
    """What is declared of a module."""

    signature: Signature | None = None
    behavior: Behavior | None = None
    resources: Resources | None = None
    permissions: Permissions | None = None
    recovery: Recovery | None = None
    versioning: Versioning | None = None


class Defaults(Sections, frozen=True):
    """What fills a field that nothing else fills, under a name."""

    name: str = ""


class Overlay(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One `ecm.yaml`."""

    schema: Literal["ecm-extract/overlay/1"]
    defaults: Defaults | None = None
    all: Sections | None = None
    modules: dict[str, Sections | None] | None = None


def is_declarable(section: str, field: str, value: object) -> bool:
    """Tell whether a value can be meant for a field.

    Args:
        section: one of the six.
        field: of that section.
        value: as plain data.
    """
    try:
        msgspec.convert({section: {field: value}}, Sections)
    except msgspec.ValidationError:
        return False
    return True
