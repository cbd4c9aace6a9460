"""What catkin targets wait for, and which generated headers their sources include."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from ecm_parsers.cmake_facts import CmakeFile

from ecm_extract.read.facts import PackageFacts

_ACTION_PARTS = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
_SERVICE_PARTS = ("", "Request", "Response")
_ORDERING = frozenset({"add_dependencies", "target_link_libraries"})
_INCLUDE = "/include/"


def generated_headers(packages: Sequence[PackageFacts]) -> dict[str, str]:
    """Return the package of each header that ROS 1 generates from files of the tree."""
    found = {}
    for package in packages:
        for path, definition in package.interfaces.items():
            stem = path.rpartition("/")[2].rpartition(".")[0]
            parts = {"msg": ("",), "srv": _SERVICE_PARTS, "action": _ACTION_PARTS}[definition.shape]
            found.update({f"{package.name}/{stem}{part}.h": package.name for part in parts})
        for path in package.reconfigure:
            stem = path.rpartition("/")[2].rpartition(".")[0]
            found[f"{package.name}/{stem}Config.h"] = package.name
    return found


def build_dependencies(file: CmakeFile) -> dict[str, set[str]]:
    """Return what each target waits for, as far as its file says: by add_dependencies, and by what it links."""
    found: dict[str, set[str]] = {target.name: set(target.links) for target in file.targets}
    for command in file.commands:
        if command.name in _ORDERING and command.args:
            found.setdefault(command.args[0], set()).update(command.args[1:])
    return found


def own_headers(package: PackageFacts) -> Mapping[str, Sequence[str]]:
    """Return the headers of a package below its folders of headers, by how they are included."""
    found: dict[str, list[str]] = defaultdict(list)
    for path in package.sources:
        parts = f"/{path}".split(_INCLUDE)
        for at in range(1, len(parts)):
            found[_INCLUDE.join(parts[at:])].append(path)
    return found


def included(package: PackageFacts, headers: Mapping[str, Sequence[str]], source: str) -> Iterator[str]:
    """Yield what a source includes, also through headers of its own package."""
    pending, seen = [source], {source}
    while pending:
        facts = package.sources.get(pending.pop())
        for entry in facts.imports if facts is not None else ():
            yield entry.module
            new = [path for path in headers.get(entry.module, ()) if path not in seen]
            seen.update(new)
            pending += new
