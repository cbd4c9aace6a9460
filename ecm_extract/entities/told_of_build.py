"""Files that a package may have beside those of its folder: what its install rules put elsewhere, what is not here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Any, Final

import msgspec
from ecm_checker.hub.package import Around
from msgspec import UNSET, UnsetType

from ecm_extract.cmake.sources import built_sources
from ecm_extract.entities.distributions import named_distributions
from ecm_extract.entities.fetched import fetched_repositories
from ecm_extract.entities.install_rules import InstallRule, install_rules, is_open, place_of, tells_installed
from ecm_extract.entities.possible import makers_of, open_kinds, possible_names, runs_files
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import COMPILED
from ecm_extract.tree import Tree
from ecm_extract.tree.checkout import left_out
from ecm_extract.tree.submodules import FILE_NAME, submodule_names

FILE: Final = "file"
_MAKING: Final = frozenset({"add_custom_command", "configure_file"})
_COPYING: Final = frozenset({"FILES", "DIRECTORY"})


class Surroundings(msgspec.Struct, frozen=True):
    """What a tree tells of its packages beside their own files.

    Attributes:
        makers: CMake commands that make programs.
        left_out: paths that git tracks and the checkout lacks.
        filled: folders that something else fills: a submodule, or another package.
        said: what it says for all of them; UNSET where it says nothing.
    """

    makers: frozenset[str]
    left_out: frozenset[str]
    filled: frozenset[str]
    said: Around | UnsetType


def surroundings(tree: Tree, packages: Sequence[PackageFacts]) -> Surroundings:
    """Return the surroundings of the packages of a tree."""
    listing = [FILE_NAME] if any(entry.path == FILE_NAME for entry in tree.files()) else []
    listed = (names for _, data in tree.read_many(listing) for names in submodule_names(data))
    roots = (facts.root.path for facts in packages)
    return Surroundings(makers_of(tree), left_out(tree), frozenset((*listed, *roots)), _said(tree))


def _said(tree: Tree) -> Around | UnsetType:
    """What a tree says of itself; most say nothing."""
    said = Around(tuple(sorted(named_distributions(tree))), tuple(sorted(fetched_repositories(tree))))
    return said if said != Around() else UNSET


def told_of_build(facts: PackageFacts, around: Surroundings) -> dict[str, Any]:
    """Return the fields of a package's document that tell what its build may make, and what its tree says."""
    names = {**possible_names(facts), FILE: set(possible_files(facts, around))}
    return {
        "possible": {kind: tuple(sorted(found)) for kind, found in names.items() if found},
        "open": open_kinds(facts, around.makers),
        "runs_files": runs_files(facts),
        "makes_files": makes_files(facts),
        "tells_installed": tells_installed(facts),
        "unbuilt": tuple(_unbuilt(facts)),
        "around": around.said,
    }


def possible_files(facts: PackageFacts, around: Surroundings) -> Iterator[str]:
    """Yield paths from the share folder of a package; one that ends in a slash stands for all below it."""
    root = f"{facts.root.path}/" if facts.root.path else ""
    yield from _copied(facts, root)
    yield from (path.removeprefix(root) for path in around.left_out if path.startswith(root))
    yield from (f"{path.removeprefix(root)}/" for path in around.filled if path.startswith(root) and path != root)


def makes_files(facts: PackageFacts) -> bool:
    """Tell whether the build of a package may make files, or put some where nothing tells."""
    commands = [command for file in facts.cmake.values() for command in file.commands]
    makes = any(command.name in _MAKING or "DOWNLOAD" in command.args for command in commands)
    return not facts.cmake or makes or not (facts.root.rosbuild or not is_open(facts))


def _unbuilt(facts: PackageFacts) -> list[str]:
    """Sources of C++ that no target has; none where the build does not tell all that it compiles."""
    built = built_sources(facts.cmake) if facts.cmake else None
    sources = (path for path in facts.sources if PurePosixPath(path).suffix in COMPILED)
    return [] if built is None else sorted(path for path in sources if path not in built)


def _copied(facts: PackageFacts, root: str) -> Iterator[str]:
    """Where install rules put files of the share folder that do not lie there in the sources."""
    share = f"share/{facts.name}/"
    for rule in install_rules(facts):
        if rule.kind in _COPYING and f"{rule.destination}/".startswith(share):
            paths = (entry.path for entry in facts.root.files)
            yield from _moved(paths, rule, root, share)


def _moved(paths: Iterable[str], rule: InstallRule, root: str, share: str) -> Iterator[str]:
    for path in paths:
        place = place_of(path, rule)
        if place is not None and place.removeprefix(share) != path.removeprefix(root):
            yield place.removeprefix(share)
