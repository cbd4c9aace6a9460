"""Which packages of a tree are built together: a build tool takes one package of each name.

A repository may hold several workspaces: exercises with their solutions, a folder for each version of ROS.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import PurePosixPath

from msgspec import structs

from ecm_extract.read.facts import PackageFacts
from ecm_extract.tree import Entry


def builds(packages: Sequence[PackageFacts]) -> list[list[PackageFacts]]:
    """Return the packages in groups without a name twice, as far as folders tell them apart.

    Folders that hold a package which stands elsewhere too are groups of their own; all others stay together.
    """
    return _groups(_found(packages), "")


def hidden_of(packages: Sequence[PackageFacts]) -> list[PackageFacts]:
    """Return the packages within others that one of their name outside hides."""
    roots = {package.root.path for package in packages}
    inner = {path for path in roots if _around(path, roots) is not None}
    names = {package.name for package in packages if package.root.path not in inner}
    return [package for package in packages if package.root.path in inner and package.name in names]


def _found(packages: Sequence[PackageFacts]) -> list[PackageFacts]:
    """The packages without those that one outside hides; the files of these are of the package around them.

    No build tool looks for packages within a package, so that a name means the one that it finds elsewhere.
    """
    roots = {package.root.path for package in packages}
    hidden = {package.root.path for package in hidden_of(packages)}
    files: dict[str | None, list[Entry]] = defaultdict(list)
    for package in packages:
        if package.root.path in hidden:
            files[_around(package.root.path, roots - hidden)] += package.root.files
    kept = [package for package in packages if package.root.path not in hidden]
    return [_with(package, files[package.root.path]) if package.root.path in files else package for package in kept]


def _with(package: PackageFacts, files: Sequence[Entry]) -> PackageFacts:
    """A package with more files in its folder, of which its build knows nothing."""
    together = sorted((*package.root.files, *files), key=lambda entry: entry.path)
    return replace(package, root=structs.replace(package.root, files=tuple(together)))


def _around(path: str, roots: Collection[str]) -> str | None:
    """The innermost of these folders that a folder lies in."""
    above = ("" if folder == PurePosixPath() else f"{folder}" for folder in PurePosixPath(path).parents)
    return next((folder for folder in above if folder in roots), None)


def _groups(packages: Sequence[PackageFacts], folder: str) -> list[list[PackageFacts]]:
    counts = Counter(package.name for package in packages)
    if all(count == 1 for count in counts.values()):
        return [list(packages)]
    children: dict[str, list[PackageFacts]] = {}
    for package in packages:
        children.setdefault(_child(package.root.path, folder), []).append(package)
    if set(children) == {folder}:
        return [list(packages)]
    torn = {name for name, group in children.items() if any(counts[package.name] > 1 for package in group)}
    rest = [package for name, group in children.items() if name not in torn for package in group]
    found = [rest] if rest else []
    for name in children:
        if name in torn:
            found += _groups(children[name], name) if name != folder else [children[name]]
    return found


def _child(path: str, folder: str) -> str:
    """The folder below another one that holds a path, or that one itself."""
    inside = path.removeprefix(f"{folder}/") if folder else path
    first = inside.partition("/")[0]
    return folder if path == folder else f"{folder}/{first}".lstrip("/")
