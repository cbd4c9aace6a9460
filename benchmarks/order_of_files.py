"""Whether contracts depend on the order in which files are read: `python benchmarks/order_of_files.py CLONES_DIR`.

Each clone of a folder is read once and linked again under shuffles of its packages and files, and with a file renamed
that has nothing to do with any contract: no evidence stands in it, and no include, import or build file names it.
Printed is a line for each clone and for each module that differs. Status 1 when one differs.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Final

import msgspec
from ecm_parsers.source.facts import SourceFile

from ecm_extract.assemble.contracts import assemble
from ecm_extract.cmake.sources import paths_of
from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.reader import Reader
from ecm_extract.tree import Tree, open_tree

SHUFFLES: Final = 3
_FIRST: Final = "aaa_"
"""Before the name of the renamed file: it comes first where it came anywhere."""


@dataclass(frozen=True)
class ReadTree:
    """A tree and what was read of it."""

    tree: Tree
    packages: Sequence[PackageFacts]

    def contracts(self) -> Mapping[str, bytes]:
        """Return the contracts of modules, encoded, by their ids; packages of one name have modules of one id."""
        found: dict[str, list[bytes]] = defaultdict(list)
        for package in assemble(self.tree, self.packages, Linker(self.packages, form_table()).link()):
            for module in package.modules:
                found[module.ecm.module_id].append(msgspec.json.encode(module))
        return {name: b"\n".join(sorted(texts)) for name, texts in found.items()}


def read_tree(root: Path) -> ReadTree:
    """Read a folder with packages."""
    tree = open_tree(root)
    return ReadTree(tree, Reader(tree, False, (), None).read(1, None))


def shuffled(read: ReadTree, seed: int) -> ReadTree:
    """Return a tree with its packages and their files in another order."""
    rng = random.Random(seed)
    packages = [replace(package, sources=_in_any_order(package.sources, rng)) for package in read.packages]
    rng.shuffle(packages)
    return replace(read, packages=packages)


def _in_any_order(sources: Mapping[str, SourceFile], rng: random.Random) -> dict[str, SourceFile]:
    listed = list(sources.items())
    rng.shuffle(listed)
    return dict(listed)


def with_renamed(read: ReadTree, contracts: Mapping[str, bytes]) -> tuple[str, ReadTree] | None:
    """Return the file that is renamed, and the tree with it; None where every file matters."""
    named = _named(read.packages)
    for package in read.packages:
        for path in package.sources:
            place = PurePosixPath(path)
            if {place.name, place.stem} & named or any(path.encode() in text for text in contracts.values()):
                continue
            renamed = str(place.with_name(f"{_FIRST}{place.name}"))
            sources = {renamed if each == path else each: facts for each, facts in package.sources.items()}
            others = [replace(each, sources=sources) if each is package else each for each in read.packages]
            return path, replace(read, packages=others)
    return None


def _named(packages: Sequence[PackageFacts]) -> set[str]:
    """The names that includes, imports, build files and entry points give to files."""
    found = {"__init__.py", "__init__"}
    for package in packages:
        for facts in package.sources.values():
            found.update(part for entry in facts.imports for part in _parts(entry.module, entry.name))
        for path, file in package.cmake.items():
            found.update(PurePosixPath(each).name for target in file.targets for each in paths_of(target, path))
        entries = (entry for setup in package.setups.values() for entry in setup.entry_points)
        found.update(part for entry in entries for part in entry.module.split("."))
    return found


def _parts(module: str, name: str) -> Iterator[str]:
    yield PurePosixPath(module).name
    yield from module.split(".")
    yield name


def differing(first: Mapping[str, bytes], second: Mapping[str, bytes]) -> list[str]:
    """Return the modules whose contracts differ, or that only one side has."""
    return sorted(name for name in {*first, *second} if first.get(name) != second.get(name))


def differences(read: ReadTree) -> Iterator[str]:
    """Yield a line for each module that another order or name changes."""
    first = read.contracts()
    for seed in range(SHUFFLES):
        for name in differing(first, shuffled(read, seed).contracts()):
            yield f"  shuffle {seed}: {name}"
    renamed = with_renamed(read, first)
    if renamed is not None:
        for name in differing(first, renamed[1].contracts()):
            yield f"  {renamed[0]} renamed: {name}"


def main() -> int:
    """Compare the clones of a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("clones", type=Path, help="folder with clones")
    parser.add_argument("names", nargs="*", help="only these clones")
    asked = parser.parse_args()
    wrong = 0
    for clone in sorted(path for path in asked.clones.iterdir() if path.is_dir()):
        if asked.names and clone.name not in asked.names:
            continue
        lines = list(differences(read_tree(clone)))
        wrong += bool(lines)
        print("\n".join([f"{'differs' if lines else 'same'}: {clone.name}", *lines]), flush=True)
    print(f"{wrong} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
