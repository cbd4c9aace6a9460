"""Whether `diff` says the same of stored documents as of sources: `python benchmarks/stored_equality.py CLONES`.

Pairs of release tags that follow each other are drawn by a seed from the clones of a folder. Each pair is compared
from its sources, from two extract documents and from two folders of package documents, with another clone as consumer
in the same form. Printed is a line for each pair, the first difference where there is one, and what documents cost.
Status 1 when a comparison differs.
"""

from __future__ import annotations

import argparse
import os
import random
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import msgspec
from extracted import command

PAIRS: Final = 20
_FAILED: Final = 2
_VERSION: Final = "*[0-9].[0-9]*"


class Drawn(msgspec.Struct, frozen=True):
    """Two releases of a repository, and a tree that uses them; None for none."""

    repo: Path
    old: str
    new: str
    consumer: Path | None = None

    @property
    def name(self) -> str:
        """The pair in one line."""
        used = f" for {self.consumer.name}" if self.consumer is not None else ""
        return f"{self.repo.name} {self.old}..{self.new}{used}"


class Documents(msgspec.Struct, frozen=True):
    """An extract document and a folder of package documents of one tree, and the seconds that writing took."""

    document: Path
    folder: Path
    seconds: float


class Told(msgspec.Struct, frozen=True):
    """What a comparison says, apart from how its sides are called, and the seconds that it took."""

    document: Any
    seconds: float


class Costs(msgspec.Struct, frozen=True):
    """Of one pair: bytes of the new document and of it compressed; seconds."""

    size: int
    compressed: int
    write: float
    read: float
    stored: float
    sources: float


class Judged(msgspec.Struct, frozen=True):
    """A pair with where its comparisons first differ, by the form of the documents; nothing where they are equal."""

    pair: Drawn
    differences: dict[str, str]
    costs: Costs


class Extractor:
    """Documents of trees below a folder, each made once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._made: dict[tuple[Path, str], Documents] = {}

    def documents(self, repo: Path, ref: str) -> Documents:
        """Return the documents of a ref of a clone."""
        key = (repo, ref)
        if key not in self._made:
            self._made[key] = self._make(repo, ref)
        return self._made[key]

    def _make(self, repo: Path, ref: str) -> Documents:
        place = self._folder / f"{repo.name}-{ref.replace('/', '_')}"
        place.mkdir()
        document, folder = place / "extract.json", place / "packages"
        line = ["extract", str(repo), "--ref", ref, "--quiet"]
        started = time.perf_counter()
        document.write_bytes(_run([*line, "--format", "json", "-o", "-"]))
        seconds = time.perf_counter() - started
        _run([*line, "-o", str(folder)])
        return Documents(document, folder, seconds)


def drawn(clones: Path, count: int, seed: int) -> list[Drawn]:
    """Draw pairs from the clones in turn; every second one with another clone as consumer."""
    chance = random.Random(seed)
    repos = sorted(path for path in clones.iterdir() if (path / ".git").exists() or (path / "HEAD").exists())
    pairs = {repo: _shuffled(list(_adjacent(_releases(repo))), chance) for repo in repos}
    turns = [repo for turn in range(count) for repo in repos if turn < len(pairs[repo])][:count]
    found = []
    for number, repo in enumerate(turns):
        old, new = pairs[repo].pop()
        others = [other for other in repos if other != repo]
        found.append(Drawn(repo, old, new, chance.choice(others) if number % 2 and others else None))
    return found


def _releases(repo: Path) -> list[str]:
    out = _output(["git", "-C", str(repo), "tag", "--list", _VERSION, "--sort=version:refname"])
    return out.decode().split()


def _adjacent(tags: Sequence[str]) -> Iterator[tuple[str, str]]:
    yield from pairwise(tags)


def _shuffled(pairs: list[tuple[str, str]], chance: random.Random) -> list[tuple[str, str]]:
    chance.shuffle(pairs)
    return pairs


def judged(pair: Drawn, extractor: Extractor) -> Judged:
    """Compare a pair in all three forms."""
    old, new = (extractor.documents(pair.repo, ref) for ref in (pair.old, pair.new))
    used = extractor.documents(pair.consumer, "HEAD") if pair.consumer is not None else None
    sources = told(pair, pair.old, pair.new, f"{pair.consumer}@HEAD" if pair.consumer is not None else None)
    whole = told(pair, old.document, new.document, used.document if used is not None else None)
    parts = told(pair, old.folder, new.folder, used.folder if used is not None else None)
    found = {
        "extract document": difference(sources.document, whole.document),
        "package documents": difference(sources.document, parts.document),
    }
    differences = {form: text for form, text in found.items() if text is not None}
    return Judged(pair, differences, _costs(new, whole.seconds, sources.seconds))


def told(pair: Drawn, old: str | Path, new: str | Path, consumer: str | Path | None) -> Told:
    """Run a comparison."""
    line = ["diff", str(old), str(new), "--repo", str(pair.repo), "--format", "json", "--fail-on", "never"]
    started = time.perf_counter()
    out = _run([*line, *(["--consumer", str(consumer)] if consumer is not None else [])])
    seconds = time.perf_counter() - started
    document = msgspec.json.decode(out)
    for side in ("old", "new"):
        del document[side]["ref"]
    return Told(document, seconds)


def difference(left: Any, right: Any, place: str = "") -> str | None:
    """Return where two documents first differ, and what each says there; None where they are equal."""
    if type(left) is type(right) and isinstance(left, dict) and list(left) == list(right):
        steps = ((f"{place}.{key}", left[key], right[key]) for key in left)
    elif type(left) is type(right) and isinstance(left, list) and len(left) == len(right):
        steps = ((f"{place}[{index}]", *both) for index, both in enumerate(zip(left, right, strict=True)))
    else:
        return None if left == right else f"{place}: {_shown(left, right)} != {_shown(right, left)}"
    return next((text for at, one, other in steps if (text := difference(one, other, at)) is not None), None)


def _shown(value: Any, other: Any) -> str:
    """A value; of a list what the other lacks."""
    if isinstance(value, list) and isinstance(other, list):
        value = {"length": len(value), "alone": [each for each in value if each not in other][:1]}
    return msgspec.json.encode(value).decode()


def _costs(documents: Documents, stored: float, sources: float) -> Costs:
    from ecm_checker.hub.package import decode_documents

    data = documents.document.read_bytes()
    started = time.perf_counter()
    decode_documents(data)
    read = time.perf_counter() - started
    return Costs(len(data), len(zlib.compress(data)), documents.seconds, read, stored, sources)


def _run(arguments: list[str]) -> bytes:
    return _output([command(), *arguments])


def _output(line: list[str]) -> bytes:
    done = subprocess.run(line, capture_output=True, check=False, env=os.environ)
    if done.returncode >= _FAILED and not done.stdout:
        sys.exit(f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")
    return done.stdout


def report(found: Judged) -> None:
    """Print one pair."""
    costs = found.costs
    print(
        f"{'DIFFERS' if found.differences else 'equal  '} {found.pair.name}: {costs.size / 1e6:.1f} MB, "
        f"{costs.compressed / 1e6:.2f} MB compressed; write {costs.write:.2f} s, read {costs.read:.2f} s; "
        f"diff {costs.stored:.2f} s, of sources {costs.sources:.2f} s",
        flush=True,
    )
    for form, text in found.differences.items():
        print(f"    {form}: {text[:600]}")


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path, help="folder of clones, bare or not")
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    unequal = 0
    pairs = drawn(arguments.clones, arguments.pairs, arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        extractor = Extractor(Path(folder))
        for pair in pairs:
            found = judged(pair, extractor)
            report(found)
            unequal += bool(found.differences)
    print(f"{len(pairs)} pairs, {len(pairs) - unequal} equal")
    sys.exit(1 if unequal else 0)


if __name__ == "__main__":
    main()
