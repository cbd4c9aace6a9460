"""One comparison from two trees to its result."""

from __future__ import annotations

from pathlib import Path

import msgspec
from ecm_checker.match.consumer import Consumer
from ecm_parsers.source.facts import SourceFile

from ecm_extract.diff.break_findings import findings_of
from ecm_extract.diff.broken_names import BrokenNames
from ecm_extract.diff.changes import changes_of
from ecm_extract.diff.consumers import uses_of
from ecm_extract.diff.git_renames import renamed_files
from ecm_extract.diff.history import History
from ecm_extract.diff.model import Comparison, Located, RefInfo
from ecm_extract.diff.pair import Evidence, Pairing
from ecm_extract.diff.sides import Sides, both_sides
from ecm_extract.diff.verdict import package_verdicts, repository_verdict
from ecm_extract.entities.side import Side, read_workspace
from ecm_extract.extraction_model import Options
from ecm_extract.requires.collect import consumers
from ecm_extract.stored import Stored, stored_consumers
from ecm_extract.tree import Tree


class Request(msgspec.Struct, frozen=True):
    """What is compared.

    Attributes:
        old, new: the trees, or stored documents of them.
        repo: folder of the repository, for renames and history; None without one.
        name: of the repository. infos: how the two sides are written.
        consumers: trees whose uses are matched; the new side is always one of them.
        packages: only these; empty for all.
        options: of the extraction.
    """

    old: Tree | Stored
    new: Tree | Stored
    repo: Path | None
    name: str
    infos: tuple[RefInfo, RefInfo]
    consumers: tuple[Tree | Stored, ...] = ()
    packages: tuple[str, ...] = ()
    options: Options = Options()


def compare(request: Request) -> Comparison:
    """Read both sides, pair their entities and match the uses of consumers.

    Raises:
        TreeError: a tree cannot be listed.
        ConfigError: an `ecm.toml` is wrong.
    """
    parsed: dict[str, SourceFile] = {}
    sides = both_sides(request.old, request.new, request.options, parsed)
    return compared(request, sides, parsed)


def compared(request: Request, sides: Sides, parsed: dict[str, SourceFile]) -> Comparison:
    """Compare two sides that are read already.

    Args:
        request: what is compared.
        sides: its two trees down to their entities.
        parsed: facts by blob id, for the consumers to take from.
    """
    old, new = sides.old, sides.new
    located = located_changes(request, old, new)
    broken = BrokenNames(located, old, new)
    uses = list(uses_of(sides.own(), broken, new.commit, own=True))
    for other in request.consumers:
        uses += uses_of(_consumers(other, request.options, parsed), broken, other.commit)
    findings = findings_of(uses)
    changes = tuple(entry.change for entry in located)
    return Comparison(
        repo=request.name,
        old=request.infos[0],
        new=request.infos[1],
        changes=changes,
        findings=findings,
        verdict=repository_verdict(changes, old, new),
        packages=package_verdicts(changes, old, new),
    )


def _consumers(other: Tree | Stored, options: Options, parsed: dict[str, SourceFile]) -> list[Consumer]:
    if isinstance(other, Stored):
        return stored_consumers(other)
    return consumers(read_workspace(other, options, parsed))


def located_changes(request: Request, old: Side, new: Side) -> list[Located]:
    """Pair the entities of two sides, and return what changed."""
    files = renamed_files(old, new, request.repo)
    evidence = Evidence(files, History(old, new, request.repo), new.bound, new.quoted, new.reads)
    pairs = Pairing(old.entities, new.entities, evidence).run()
    located = changes_of(pairs, old, new)
    if not request.packages:
        return located
    return [entry for entry in located if entry.change.package in request.packages]
