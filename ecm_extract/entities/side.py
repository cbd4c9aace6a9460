"""One side of a comparison: what its packages offer, and what helps to find it again on the other side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from ecm_checker.hub.provision import Key, Provision
from ecm_parsers.interface_facts import Definition

from ecm_extract.entities.notes import no_notes
from ecm_extract.tree.unread import Unread


@dataclass(frozen=True, slots=True)
class PackageInfo:
    """What a verdict needs of a package."""

    name: str
    version: str | None
    path: str
    manifest: str | None
    ros: int | None


Notes = Callable[[Sequence[str]], Mapping[str, Sequence[str]]]
"""Sentences of changelogs, of those of some paths that there are."""


@dataclass(slots=True)
class Side:
    """A tree, or stored documents of one, with its public entities.

    Attributes:
        commit: that it was read at; None of a work tree.
        packages: by name. entities: by key. interfaces: definition by `package/msg|srv|action/Name`.
        paths: of the files of packages, and of what outside of them concerns all. blobs: their ids, where known.
        bound: dotted names that Python modules offer without declaring them; see `bound_names`.
        quoted: dotted names that they give by text; see `quoted_names`.
        reads: package and name of each parameter that is read by name.
        notes: what people wrote in changelogs, read when it is asked for.
        unread: what was not read until then; a tree that is read in another process tells it here only.
    """

    commit: str | None
    packages: dict[str, PackageInfo] = field(default_factory=dict)
    entities: dict[Key, Provision] = field(default_factory=dict)
    interfaces: dict[str, Definition] = field(default_factory=dict)
    paths: frozenset[str] = frozenset()
    blobs: dict[str, str] = field(default_factory=dict)
    bound: frozenset[str] = frozenset()
    quoted: frozenset[str] = frozenset()
    reads: frozenset[tuple[str, str]] = frozenset()
    notes: Notes = no_notes
    unread: tuple[Unread, ...] = ()
