"""Which packages of a tree are built together: a build tool takes one package of each name.

A repository may hold several workspaces: exercises with their solutions, a folder for each version of ROS.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ecm_extract.read.facts import PackageFacts


def builds(packages: Sequence[PackageFacts], folder: str = "") -> list[list[PackageFacts]]:
    """Return the packages in groups without a name twice, as far as folders tell them apart.

    Folders that hold a package which stands elsewhere too are groups of their own; all others stay together.
    """
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
            found += builds(children[name], name) if name != folder else [children[name]]
    return found


def _child(path: str, folder: str) -> str:
    """The folder below another one that holds a path, or that one itself."""
    inside = path.removeprefix(f"{folder}/") if folder else path
    first = inside.partition("/")[0]
    return folder if path == folder else f"{folder}/{first}".lstrip("/")
