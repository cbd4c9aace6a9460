"""What a launch file runs and includes, in words that two releases can be compared by."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.provision import HOLE
from ecm_parsers.launch.model import Include, LaunchFile, Node, Unread
from ecm_parsers.launch.templates import plain_text

from ecm_extract.entities.launch_conditions import taken
from ecm_extract.entities.launch_targets import included_file


def runs_of(file: LaunchFile, package: str, own: str) -> tuple[str, ...]:
    """Return the programs, components and files of a launch file, each once; `<*>` for what it does not tell.

    Args:
        file: the launch file.
        package: that it is of.
        own: its path from there.
    """
    return tuple(dict.fromkeys(_runs(file, package, own)))


def _runs(file: LaunchFile, package: str, own: str) -> Iterator[str]:
    for each in taken(file.actions):
        match each.action:
            case Node():
                yield run_by(each.action)
            case Include():
                target = included_file(each.action.path, package, own)
                yield HOLE if target is None or "$" in target[1] else "/".join(target)
            case Unread():
                yield HOLE


def run_by(node: Node) -> str:
    """What a node of a launch file runs: a class where it loads one, else `package/executable`."""
    if node.plugin:
        return (plain_text(node.plugin) or HOLE).replace("::", "/")
    parts = plain_text(node.package), plain_text(node.executable)
    return HOLE if None in parts else "/".join(part or "" for part in parts)
