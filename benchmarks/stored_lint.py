"""Whether lint says the same of a package alone with documents: `python benchmarks/stored_lint.py CLONE...`.

Of each clone releases are drawn by a seed, of each release packages. A package is linted in its whole tree, and alone
with the documents of the release beside it, all in one process: much cheaper than `stored_equality.py`, which asks the
command line. Printed is a line for each release and each finding that only one of both has. Status 1 when one differs.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from stored_draw import releases
from stored_questions import OF_ONE_TREE, UnreadableError, unpack

from ecm_extract.errors import InputError
from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.stored import package_of
from ecm_extract.test_code import is_test_package
from ecm_extract.tree import open_tree

_MARK: Final = re.compile(r"document:[^/]+/")
_OPTIONS: Final = Options(jobs=1, hub=True)


class Compared(msgspec.Struct, frozen=True):
    """The packages of a release that were linted, and lines on what only one of both ways says, by package."""

    packages: tuple[str, ...]
    differences: dict[str, list[str]]


def compared(clone: Path, tag: str, count: int, chance: random.Random) -> Compared:
    """Lint some packages of a release in both ways."""
    with tempfile.TemporaryDirectory() as folder:
        unpack(clone, tag, Path(folder) / "tree")
        documents = _documents(clone, tag)
        tree = Path(folder) / "tree"
        whole = Workspace(open_tree(tree), _OPTIONS)
        found = findings_of(whole)
        paths = (package.root.path for package in whole.packages)
        roots = [f"{path}/" for path in paths if path and not is_test_package(path)]
        chosen = chance.sample(roots, min(count, len(roots)))
        both = {root: (_below(found, root), _alone(tree, root, documents)) for root in chosen}
    lines = {root: list(_differences(sources, alone, root)) for root, (sources, alone) in both.items()}
    return Compared(tuple(chosen), {root: found for root, found in lines.items() if found})


def _documents(clone: Path, tag: str) -> list[Package]:
    """The packages of a release as documents hold them."""
    found = extract(open_tree(str(clone), tag), _OPTIONS).packages
    return [msgspec.json.decode(msgspec.json.encode(package_of(each)), type=Package) for each in found]


def _alone(tree: Path, root: str, documents: Sequence[Package]) -> list[Finding]:
    found = findings_of(Workspace(open_tree(tree / root), _OPTIONS, stored=documents))
    return [each for each in found if each.evidence and each.rule not in OF_ONE_TREE]


def _below(found: Sequence[Finding], root: str) -> list[Finding]:
    told = (each for each in found if each.evidence and each.rule not in OF_ONE_TREE)
    return [each for each in told if each.evidence[0].path.startswith(root)]


def _differences(sources: Sequence[Finding], alone: Sequence[Finding], root: str) -> Iterator[str]:
    """Lines on what only one of both says, to the byte of its JSON."""
    both = [{_text(each, root): each for each in found} for found in (sources, alone)]
    for name, these, others in (("sources", *both), ("documents", *reversed(both))):
        lines = (each for text, each in these.items() if text not in others)
        yield from (f"{name}: {each.rule} {each.message[:160]} {each.evidence[0]}" for each in lines)


def _text(finding: Finding, root: str) -> str:
    """A finding with the paths of its package from there, and those of others as their tree has them."""
    return _MARK.sub("", msgspec.json.encode(finding).decode()).replace(root, "")


def _told(clone: Path, arguments: argparse.Namespace) -> Iterator[Compared]:
    """Compare and print the drawn releases of a clone."""
    chance = random.Random(f"{arguments.seed} {clone.name}")
    tags = releases(clone)
    for tag in chance.sample(tags, min(arguments.releases, len(tags))):
        try:
            found = compared(clone, tag, arguments.packages, chance)
        except (UnreadableError, InputError) as error:
            print(f"skipped {clone} {tag}: {error}", flush=True)
            continue
        print(
            f"{'DIFFERS' if found.differences else 'equal  '} {clone} {tag}: {len(found.packages)} packages", flush=True
        )
        for root, lines in found.differences.items():
            print(*(f"    {root} {line}" for line in lines), sep="\n", flush=True)
        yield found


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path, nargs="+", help="clones, bare or not")
    parser.add_argument("--releases", type=int, default=2, help="of each clone")
    parser.add_argument("--packages", type=int, default=4, help="of each release")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    found = [each for clone in arguments.clones for each in _told(clone, arguments)]
    packages, unequal = sum(len(each.packages) for each in found), sum(len(each.differences) for each in found)
    print(f"{len(found)} releases, {packages} packages, {packages - unequal} equal")
    sys.exit(1 if unequal else 0)


if __name__ == "__main__":
    main()
