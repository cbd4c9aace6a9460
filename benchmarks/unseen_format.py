"""The interface of a node as its source says it, row by row with file and line: truth_unseen/*.yaml."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec
from truth_format import Row


class SourceRow(Row, frozen=True, forbid_unknown_fields=True):
    """One interface that the source has.

    `name` is as written, before remapping: `~x` is private, a hole `{x}` is what no source decides. `qos` has the
    policies that the source decides (of ROS 1 the queue, and durability of a latched publisher), `default` is the
    declared one where it is a literal, `when` the condition of a row that not every run has.
    """

    qos: dict[str, object] = msgspec.field(default_factory=dict)
    default: object = None
    when: str | None = None


class SourceNode(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One node.

    Attributes:
        node: what it is called in the report.
        name: what it is called when it runs; a hole where no source decides it.
        package: name of its package.
        files: what was read for it, from the root of the repository; rows with evidence there are compared.
        shared: those of the files that other nodes use too; a row that meets the node only there is compared when
            nothing of its evidence is elsewhere.
        interfaces: what a reader finds there.
        also: what libraries add for it (neither asked for nor counted).
        notes: what a row cannot say.
    """

    node: str
    name: str
    package: str
    files: list[str]
    interfaces: list[SourceRow]
    shared: list[str] = []
    also: list[SourceRow] = []
    notes: list[str] = []


class Repository(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One truth file: `tree` is the folder of the checkout at `commit` below CLONES_DIR."""

    repository: str
    tree: str
    commit: str
    nodes: list[SourceNode]


def load(path: Path) -> Repository:
    """Read a truth file; an unknown key is an error."""
    return msgspec.yaml.decode(path.read_bytes(), type=Repository)


def resolved(name: str, node: str) -> str:
    """A name in the namespace `/` under the name of its node, all holes written alike."""
    full = f"/{node}/{name[1:].lstrip('/')}" if name.startswith("~") else f"/{name.lstrip('/')}"
    return re.sub(r"\{[^{}]*\}", "{}", full)
