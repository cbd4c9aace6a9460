"""Releases that broke others, replayed: `python benchmarks/real_breaks.py --clones DIR [FILE...]`.

Each file of benchmarks/real_breaks holds releases of one provider and the consumers that they broke, read in git: the
lines are those that the consumers' own fixing commits change, at the parent of the fix, and the first line of a call
that goes over several. Printed are, by kind of change,
consumers of which a line that broke is named, changed names that are told, and lines that are named. Status 1 when the
share of consumers is below the figure.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
from comparisons import Change, Evidence
from extracted import command

FOLDER = Path(__file__).parent / "real_breaks"
FIGURE = 0.80
_ANSWERS = frozenset({0, 2})
"""Status 2 also says that something in the trees could not be read; the answer stands."""


class Broken(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A consumer that a release broke.

    Attributes:
        repository: `owner/name`; its clone is `<name>.git`.
        ref: the commit before the one that mends it.
        kind: of the name that changed; name: the changed name.
        use: what the lines do with it. lines: `path:line` at the ref.
    """

    repository: str
    ref: str
    kind: str
    name: str
    use: str
    lines: tuple[str, ...]


class Release(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Two tags of a provider, and whom the second one broke."""

    before: str
    after: str
    consumers: tuple[Broken, ...]


class Provider(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The releases of a repository, `owner/name`."""

    provider: str
    releases: tuple[Release, ...]


class _Finding(msgspec.Struct, frozen=True):
    rule: str
    message: str = ""
    evidence: tuple[Evidence, ...] = ()


class _Document(msgspec.Struct, frozen=True):
    changes: tuple[Change, ...]
    findings: tuple[_Finding, ...]


class Replayed(msgspec.Struct, frozen=True):
    """A consumer with what is said of it: broken lines that are named, and whether the changed name is told."""

    release: str
    broken: Broken
    named: tuple[str, ...]
    told: bool
    others: tuple[str, ...]


def load(path: Path) -> Provider:
    """Read a file of releases; an unknown key is an error."""
    return msgspec.yaml.decode(path.read_bytes(), type=Provider)


def replayed(provider: Provider, clones: Path, saved: Path | None = None) -> Iterator[Replayed]:
    """Replay the releases of a provider for each of its consumers; those without a clone are said and left out."""
    repo = _clone(provider.provider, clones)
    for release in provider.releases:
        for broken in release.consumers:
            consumer = _clone(broken.repository, clones)
            if repo.is_dir() and consumer.is_dir():
                label = f"{provider.provider} {release.before}..{release.after}"
                yield judged(label, broken, _answer(repo, release, f"{consumer}@{broken.ref}", saved))
            else:
                print(f"skipped: no clone {repo.name} or {consumer.name}", file=sys.stderr)


def _clone(repository: str, clones: Path) -> Path:
    return clones / f"{repository.rpartition('/')[2]}.git"


def _answer(repo: Path, release: Release, consumer: str, saved: Path | None) -> _Document:
    name = f"{repo.stem}.{release.before}.{release.after}.{consumer.rpartition('/')[2]}.json"
    kept = saved / name if saved is not None else None
    if kept is not None and kept.is_file():
        return msgspec.json.decode(kept.read_bytes(), type=_Document)
    data = _run(repo, release, consumer)
    if kept is not None:
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_bytes(data)
    return msgspec.json.decode(data, type=_Document)


def _run(repo: Path, release: Release, consumer: str) -> bytes:
    refs = [release.before, release.after, "--repo", str(repo), "--consumer", consumer]
    line = [command(), "diff", *refs, "--format", "json", "--fail-on", "never"]
    done = subprocess.run(line, capture_output=True, check=False)
    if done.returncode not in _ANSWERS or not done.stdout:
        sys.exit(f"{' '.join(refs)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    return done.stdout


def judged(label: str, broken: Broken, answer: _Document) -> Replayed:
    """Hold what is told of a release against the lines that it broke."""
    findings = [each for each in answer.findings if each.rule == "VER001"]
    told = {f"{at.path}:{at.line}" for each in findings for at in each.evidence}
    named = tuple(line for line in broken.lines if line in told)
    others = tuple(each.message for each in findings if not _lines(each) & set(broken.lines))
    return Replayed(label, broken, named, any(_is_about(broken.name, change) for change in answer.changes), others)


def _lines(finding: _Finding) -> set[str]:
    return {f"{at.path}:{at.line}" for at in finding.evidence}


def _is_about(name: str, change: Change) -> bool:
    """Whether a change is of a name, which may be written without its namespace or folder."""
    old = (change.old or "").replace("::", "/").rstrip("/")
    wanted = name.replace("::", "/")
    return old == wanted or old.rpartition("/")[2] == wanted.rpartition("/")[2]


def table(entries: list[Replayed], key: Callable[[Replayed], str]) -> None:
    """Print the three figures by a key."""
    for name in sorted({key(entry) for entry in entries}):
        print(f"  {name:18} {_figures([entry for entry in entries if key(entry) == name])}")


def _figures(entries: list[Replayed]) -> str:
    consumers = sum(bool(entry.named) for entry in entries)
    told = sum(entry.told for entry in entries)
    lines = sum(len(entry.named) for entry in entries)
    total = sum(len(entry.broken.lines) for entry in entries)
    return f"consumers {consumers:2} of {len(entries):2}   names told {told:2}   lines {lines:3} of {total:3}"


def report(entries: list[Replayed], every: bool) -> float:
    """Print everything and return the share of consumers of which a line that broke is named."""
    table(entries, lambda entry: entry.broken.kind)
    print(f"  {'all':18} {_figures(entries)}")
    for entry in entries:
        if not entry.named:
            broken, name = entry.broken, "told" if entry.told else "not told"
            print(f"- missed: {entry.release} {broken.repository}: {broken.kind} {broken.name} ({name}), {broken.use}")
            print(f"    {broken.lines[0]}")
        for message in entry.others if every else ():
            print(f"  other: {entry.broken.repository}: {message}")
    return sum(bool(entry.named) for entry in entries) / max(1, len(entries))


def main() -> int:
    """Replay the files that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--clones", type=Path, required=True, help="folder of clones, `<name>.git` each")
    parser.add_argument("--others", action="store_true", help="print what else is said of the consumers, to be judged")
    parser.add_argument("--saved", type=Path, help="folder of the answers of an earlier run, or for those of this one")
    given = parser.parse_args()
    paths = given.files or sorted(FOLDER.glob("*.yaml"))
    entries = [entry for path in paths for entry in replayed(load(path), given.clones, given.saved)]
    share = report(entries, given.others)
    print(f"consumers named by a line that broke: {share:.3f}; figure to reach {FIGURE:.2f}")
    return int(share < FIGURE)


if __name__ == "__main__":
    sys.exit(main())
