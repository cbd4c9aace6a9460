"""The two documents that other programs read: the manifest of a module and the extract of a tree.

Keys are never changed without a new schema number. They differ from the contract model in one place only:
`missing` stands inside section `ecm`, so that a reader sees at the top what is not known.
"""

from __future__ import annotations

from typing import Final, Literal

import msgspec

from ecm_checker.contract import (
    Behavior,
    Permissions,
    Recovery,
    Resources,
    Signature,
    Source,
    Versioning,
)

MANIFEST_SCHEMA: Final = "ecm-extract/manifest/1"
EXTRACT_SCHEMA: Final = "ecm-extract/extract/1"


class Ecm(msgspec.Struct, frozen=True, kw_only=True):
    """Section `ecm`: which module this is, and which required fields of its contract nothing fills."""

    module_id: str
    package: str
    kind: str
    version: str | None
    release_channel: str | None = None
    compatibility_class: str | None = None
    source: Source
    ros: Literal[1, 2] | None
    missing: tuple[str, ...] = ()


class Module(msgspec.Struct, frozen=True, kw_only=True):
    """The contract of one module as it is written; an undeclared field is absent, never an empty list."""

    ecm: Ecm
    signature: Signature = Signature()
    behavior: Behavior = Behavior()
    resources: Resources = Resources()
    permissions: Permissions = Permissions()
    recovery: Recovery = Recovery()
    versioning: Versioning = Versioning()


class Manifest(Module, frozen=True, kw_only=True):
    """A module in a file of its own, with the number of its schema."""

    schema: Literal["ecm-extract/manifest/1"]


class Diagnostic(msgspec.Struct, frozen=True):
    """Something that could not be read: path relative to the tree, 1-based line, 0 for the whole file."""

    severity: Literal["error", "warning", "info"]
    code: str
    path: str
    line: int
    message: str


class NotRead(msgspec.Struct, frozen=True):
    """Something that was not read: path, reason, whether it can declare interfaces, the commit of a submodule."""

    path: str
    reason: str
    carries: bool
    commit: str = ""


class Origin(msgspec.Struct, frozen=True):
    """The tree that was read: as the user named it, and its commit when it has one."""

    path: str
    commit: str | None
