"""One comparison from two trees to its result."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
from ecm_parsers.source.facts import SourceFile
from msgspec.structs import replace

from ecm_extract.asked import refuse_unknown_packages
from ecm_extract.collector import without_collector
from ecm_extract.diff.break_findings import findings_of, line_of
from ecm_extract.diff.broken_names import BrokenNames
from ecm_extract.diff.changes import changes_of
from ecm_extract.diff.consumers import uses_of
from ecm_extract.diff.git_renames import renamed_files
from ecm_extract.diff.hidden_names import hiding_files
from ecm_extract.diff.history import History
from ecm_extract.diff.likened_packages import without_likened
from ecm_extract.diff.model import Comparison, Located, RefInfo
from ecm_extract.diff.pair import Pairing
from ecm_extract.diff.sides import Sides, both_sides, consumers_of
from ecm_extract.diff.still_there import Evidence
from ecm_extract.diff.unread import SideRead, UnreadPart, unread_parts
from ecm_extract.diff.use import Use
from ecm_extract.diff.verdict import package_verdicts, repository_verdict
from ecm_extract.entities.side import Side
from ecm_extract.extraction_model import Options
from ecm_extract.stored import Stored
from ecm_extract.tree import Tree, Unread, unread_of


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
        NothingThereError: a side holds no package, or not one that was asked for.
    """
    parsed: dict[str, SourceFile] = {}
    with without_collector():
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
    refuse_unknown_packages(request.packages, {*old.packages, *new.packages}, _both_labels(request))
    located = located_changes(request, old, new)
    packages = sides.own()
    broken = BrokenNames(located, old, new, packages)
    own = list(uses_of(packages, broken, new.commit, own=True))
    theirs = [(each, _uses(each, request, parsed, broken)) for each in request.consumers]
    findings = findings_of([*own, *(use for _, uses in theirs for use in uses)])
    changes = tuple(entry.change for entry in located)
    unread = (*unread_between(request, old, new), *hiding_files(located))
    return Comparison(
        repo=request.name,
        old=request.infos[0],
        new=request.infos[1],
        changes=changes,
        findings=findings,
        verdict=repository_verdict(changes, old, new, unread),
        packages=package_verdicts(changes, old, new, unread),
        unread=unread,
        homes={line_of(use): each.label for each, uses in theirs for use in uses},
    )


def _uses(other: Tree | Stored, request: Request, parsed: dict[str, SourceFile], broken: BrokenNames) -> list[Use]:
    return list(uses_of(consumers_of(other, request.options, parsed), broken, other.commit))


def _both_labels(request: Request) -> str:
    return " or ".join(info.ref for info in request.infos)


def unread_between(request: Request, old: Side, new: Side) -> tuple[UnreadPart, ...]:
    """Return what was not read until now: the trees tell it once all that is wanted of them was read."""
    consumers = [unread for each in request.consumers for unread in _unread_of(each)]
    before, after = (
        SideRead(tuple(dict.fromkeys((*side.unread, *_unread_of(origin)))), side.paths)
        for side, origin in ((old, request.old), (new, request.new))
    )
    parts = unread_parts(before, after, consumers)
    folders = [side.packages[name].path for side in (old, new) for name in request.packages if name in side.packages]
    return tuple(part if _concerns(part, folders) else replace(part, limits=False) for part in parts)


def _concerns(part: UnreadPart, folders: Sequence[str]) -> bool:
    """Whether something lies in a package that was asked for; all packages were where none is named."""
    return not folders or part.side == "consumer" or any(_is_below(part.path, each) for each in folders)


def _is_below(path: str, folder: str) -> bool:
    """Whether a file or folder lies in a folder; empty stands for the root."""
    return not folder or f"{path}/".startswith(f"{folder}/")


def _unread_of(origin: Tree | Stored) -> Sequence[Unread]:
    return origin.unread if isinstance(origin, Stored) else unread_of(origin.diagnostics)


def located_changes(request: Request, old: Side, new: Side) -> list[Located]:
    """Pair the entities of two sides, and return what changed."""
    files = without_likened(renamed_files(old, new, request.repo), old, new)
    evidence = Evidence(
        files, History(old, new, request.repo), new.bound, new.quoted, new.reads, before=frozenset(old.blobs)
    )
    pairs = Pairing(old.entities, new.entities, evidence).run()
    located = changes_of(pairs, old, new)
    if not request.packages:
        return located
    return [entry for entry in located if entry.packages & set(request.packages)]
