"""One state judged: trees to documents, changes and findings."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.outcome import ordered

from ecm_corpus.clones import clone_of, open_source
from ecm_corpus.documents import digest, document, instances, packed
from ecm_corpus.interface import Composition, Source, State, Upgrade, sources_of
from ecm_corpus.results import StateResult, Versions
from ecm_corpus.verdict import CONSUMER, LAUNCHED, NEW, OLD, TREE, check_findings
from ecm_extract.diff.model import RefInfo
from ecm_extract.diff.run import Request, compare
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.system.contracts import instance_contracts
from ecm_extract.system.model import Given
from ecm_extract.system.started import STARTED, started_package
from ecm_extract.system.system import read_system
from ecm_extract.tree import Tree
from ecm_extract.tree.joined import JoinedTree

Side = dict[str, tuple[Package, ...]]
"""The packages of a side by name."""


class Judged(msgspec.Struct, frozen=True):
    """A state's result, and the files of the store that it names, by SHA-256."""

    result: StateResult
    files: dict[str, bytes]


def judge(state: State, clones: Path, options: Options) -> Judged:
    """Judge one state from local clones.

    Raises:
        InputError: a clone is missing, or lacks a ref.
    """
    if isinstance(state, Composition):
        return _composition(state, clones, options)
    return _upgrade(state, clones, options)


def _composition(state: Composition, clones: Path, options: Options) -> Judged:
    tree = _joined(state.trees, clones)
    packages = _packages(state.trees)
    documents = {TREE: _kept(tree, options, packages)}
    if state.launch:
        started = read_system(tree, [_inside(path, state) for path in state.launch], Given(), options)
        documents[LAUNCHED] = {STARTED: (instances(started_package(started), instance_contracts(started)),)}
    workspace = Workspace(tree, options)
    lint = [finding for finding in findings_of(workspace, preview=True) if _is_within(finding, workspace, packages)]
    return _judged("composition", _commits(sources_of(state), clones), documents, {"lint": ordered(lint)})


def _upgrade(state: Upgrade, clones: Path, options: Options) -> Judged:
    old, new = open_source(state.old, clones), open_source(state.new, clones)
    packages = _packages(sources_of(state))
    extracted = {
        OLD: _kept(old, options, _packages([state.old])),
        NEW: _kept(new, options, _packages([state.new])),
    }
    trees = [open_source(source, clones) for source in state.consumers]
    if trees:
        users = [_kept(tree, options, _packages([s])) for tree, s in zip(trees, state.consumers, strict=True)]
        extracted[CONSUMER] = {name: found for user in users for name, found in user.items()}
    comparison = compare(_request(state, old, new, trees, clones, options))
    diff = [finding for finding in comparison.findings if _concerns(finding, packages) and _hits(finding, trees)]
    judged = _judged("upgrade", _commits(sources_of(state), clones), extracted, {"diff": ordered(diff)})
    return msgspec.structs.replace(judged, result=msgspec.structs.replace(judged.result, versions=_versions(extracted)))


def _joined(sources: Sequence[Source], clones: Path) -> Tree:
    """One tree as it is, several below folders that are named after their repositories."""
    trees = [open_source(source, clones) for source in sources]
    if len(trees) == 1:
        return trees[0]
    return JoinedTree({source.repository.rpartition("/")[2]: tree for source, tree in zip(sources, trees, strict=True)})


def _inside(path: str, state: Composition) -> str:
    """A launch file, written `<repository's name>/<path>`, as it lies in the tree of the state."""
    return path if len(state.trees) > 1 else path.partition("/")[2]


def _request(state: Upgrade, old: Tree, new: Tree, users: Sequence[Tree], clones: Path, options: Options) -> Request:
    return Request(
        old=old,
        new=new,
        repo=clone_of(state.new.repository, clones) if state.old.repository == state.new.repository else None,
        name=state.new.repository,
        infos=(RefInfo(state.old.ref, old.commit, "named"), RefInfo(state.new.ref, new.commit, "named")),
        consumers=tuple(users),
        options=options,
    )


def _packages(sources: Iterable[Source]) -> frozenset[str]:
    """Names of the packages that count; empty for all, as when one source names none."""
    named = [source.packages for source in sources]
    return frozenset(name for names in named for name in names) if all(named) else frozenset()


def _kept(tree: Tree, options: Options, packages: frozenset[str]) -> Side:
    found: Side = defaultdict(tuple)
    for package in extract(tree, msgspec.structs.replace(options, hub=True)).packages:
        if not packages or package.name in packages:
            found[package.name] = (*found[package.name], document(package))
    return dict(sorted(found.items()))


def _is_within(finding: Finding, workspace: Workspace, packages: frozenset[str]) -> bool:
    """Whether a finding is on the packages that are composed, and on no other of their repositories."""
    owners = {workspace.package_of(place.path) for place in finding.evidence} - {""}
    return not packages or (_concerns(finding, packages) and owners <= packages)


def _concerns(finding: Finding, packages: frozenset[str]) -> bool:
    """Subjects are packages, or modules as `ecm.<package>.<module>`."""
    named = (subject.removeprefix("ecm.").partition(".")[0] for subject in finding.subjects)
    return not packages or not packages.isdisjoint(named)


def _hits(finding: Finding, users: Sequence[Tree]) -> bool:
    """The question is about the consumers: what the new side does to itself is another one."""
    commits = {tree.commit for tree in users}
    return not users or any(place.commit in commits for place in finding.evidence)


def _commits(sources: Iterable[Source], clones: Path) -> dict[str, str]:
    return {f"{source.repository}@{source.ref}": open_source(source, clones).commit or "" for source in sources}


def _judged(
    question: str,
    commits: dict[str, str],
    sides: dict[str, Side],
    findings: dict[str, tuple[Finding, ...]],
) -> Judged:
    files, names = dict[str, bytes](), dict[str, str]()
    for side, packages in sides.items():
        for name, documents in packages.items():
            data = packed(documents)
            names[f"{side}/{name}"] = digest(data)
            files[digest(data)] = data
    flat = {side: [each for found in packages.values() for each in found] for side, packages in sides.items()}
    result = StateResult(
        question=question,  # type: ignore[arg-type]
        commits=commits,
        documents=names,
        versions=(),
        findings={"check": check_findings(flat), **findings},  # type: ignore[dict-item]
    )
    return Judged(result, files)


def _versions(sides: dict[str, Side]) -> tuple[Versions, ...]:
    old, new = ({name: _version(found) for name, found in sides[side].items()} for side in (OLD, NEW))
    return tuple(Versions(name, old.get(name), new.get(name)) for name in sorted({*old, *new}))


def _version(packages: tuple[Package, ...]) -> str | None:
    versions = (contract.ecm.version for package in packages for contract in package.contracts())
    return next(versions, None)
