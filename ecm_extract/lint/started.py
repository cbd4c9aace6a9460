"""What launch files start, and Python that nothing of the tree starts, installs or imports."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Mapping

from ecm_parsers.launch.model import Node
from ecm_parsers.launch.templates import all_actions, plain_text

from ecm_extract.lint.installed_files import is_imported, is_in_use
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts


def programs_started(workspace: Workspace) -> dict[str, set[str]]:
    """Programs that launch files of the workspace, and of documents beside it, start, by package."""
    found: dict[str, set[str]] = defaultdict(set)
    for facts in (*workspace.launches.values(), *workspace.beside.launches.values()):
        for action in all_actions(facts.actions):
            if isinstance(action, Node):
                package, name = plain_text(action.package), plain_text(action.executable)
                if package and name:
                    found[package].add(name)
    return found


def is_left_aside(path: str, package: str, started: Mapping[str, Collection[str]], workspace: Workspace) -> bool:
    """Tell whether nothing of the tree runs a Python file, while others of its package are run.

    Where none of a package is, all of them are run by hand.
    """
    facts = workspace.by_name.get(package)
    names = started.get(package, ())
    if facts is None or _is_run(path, facts, names, workspace):
        return False
    others = (each for each, source in facts.sources.items() if each != path and source.language == "python")
    return any(_is_run(each, facts, names, workspace) for each in others)


def _is_run(path: str, package: PackageFacts, started: Collection[str], workspace: Workspace) -> bool:
    """Tell whether a launch file starts a Python file, a build installs it, or a source imports it."""
    name, packages = path.rpartition("/")[2], workspace.packages
    return name in started or is_imported(path, packages) or is_in_use(path, package, packages)
