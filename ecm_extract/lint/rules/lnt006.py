"""LNT006: a remap of a launch file matches no name of its node."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.match.engine import Match

from ecm_extract.link.code.spelling import last_name
from ecm_extract.lint.library_bases import brought_by_bases
from ecm_extract.lint.library_objects import brought_by_objects
from ecm_extract.lint.lines import line_of_name
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.lint.written_names import WrittenNames
from ecm_extract.system.model import Place, Remapping
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.own_names import Renamed, renamed

RULE = LintRule(
    id="LNT006",
    name="remap_without_effect",
    dimension="signature",
    severity="warning",
    who="graph",
    consequence="the node keeps its own name and the two sides never meet",
    resolution="correct the name on the left side, or remove the remap",
    of_sources="remaps of nodes",
)
_PATH = re.compile(r"\w/\w")
_MARKUP = (".launch", ".xml", ".yaml", ".yml")

_Program = tuple[str, str, str]
"""Package, executable and class."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report remaps of nodes whose every name is known.

    A node of which a document alone is known is passed over: documents do not tell what stands in helpers of a source.
    """
    seen: set[tuple[Place, str]] = set()
    written = WrittenNames(workspace)
    systems = [(system.nodes, list(renamed(system.nodes))) for system in workspace.systems]
    for nodes, found in systems:
        alive = {_key(each.remap) for each in found if each.match.state != "dangling"}
        for each in found:
            line = each.remap.place, each.remap.source  # which may be launched many times, for other targets
            if _key(each.remap) not in alive and line not in seen:
                process = [other for other in nodes if other.instance.place == each.node.instance.place]
                is_foreign = any(_may_be_of_library(each.remap, other, workspace) for other in process)
                if not is_foreign and not _is_written(each.remap, process, written):
                    seen.add(line)
                    yield _finding(each.remap, each.node, workspace)
    yield from _outvoted([each for _, found in systems for each in found], workspace)


def _key(remap: Remapping) -> tuple[str, int, str, str]:
    """One remap, or in Python one list of them: it is right when one of the nodes that get it needs it."""
    line = remap.place.line if remap.place.path.endswith(_MARKUP) else 0
    return remap.place.path, line, remap.source, remap.target


def _is_written(remap: Remapping, process: Sequence[SystemNode], written: WrittenNames) -> bool:
    """Tell whether a package of the nodes has the name in a place where no known endpoint is: a helper may use it."""
    modules = [module for node in process for module in node.modules]
    packages = {module.package for module in modules}
    if _PATH.search(remap.source):  # plugins of other packages get the node handed in
        return written.anywhere(remap.source)
    return any(written.holds(package, remap.source) for package in packages)


def _outvoted(found: Sequence[Renamed], workspace: Workspace) -> Iterator[Finding]:
    """Report remaps of names that a node lacks, where a second launch of its program remaps a name that it has.

    This holds for nodes of which some names are not known, too.
    """
    having: dict[tuple[_Program, str], set[Place]] = defaultdict(set)
    for each in found:
        if each.match.found:
            having[_program(each.node), each.remap.target].add(each.node.instance.place)
    lost: dict[Remapping, SystemNode] = {}
    for each in found:
        elsewhere = having[_program(each.node), each.remap.target] - {each.node.instance.place}
        if elsewhere and each.node.modules and _is_open(each.match):
            lost.setdefault(each.remap, each.node)
    for remap, node in lost.items():
        yield _finding(remap, node, workspace)


def _is_open(match: Match) -> bool:
    """Whether a name is not there as far as is known, of what may have more."""
    return match.state == "unknown" and not match.found and match.requirement.certainty != "unknown"


def _program(node: SystemNode) -> _Program:
    return node.instance.package, node.instance.executable, node.instance.plugin


def _may_be_of_library(remap: Remapping, node: SystemNode, workspace: Workspace) -> bool:
    """Tell whether a class outside of the tree, which a node derives from or uses, has or may have the name."""
    if any(module.package not in workspace.by_name for module in node.modules):
        return True  # documents tell the bases of public classes only
    used = (workspace.by_name[module.package].sources.values() for module in node.modules)
    if any(remap.source.lstrip("~/") in brought_by_objects(sources) for sources in used):
        return True
    program = workspace.linker.program
    names = {module.cls for module in node.modules}
    classes = [cls for name in names for cls in program.classes.get(last_name(name), ()) if cls.qualified == name]
    brought = [brought_by_bases(cls, program) for cls in classes]
    return any(names is None or remap.source.lstrip("~/") in names for names in brought)


def _finding(remap: Remapping, node: SystemNode, workspace: Workspace) -> Finding:
    target = f"the remap to {remap.target}" if remap.target else "its remap"
    text = f"{node.name} has nothing called {remap.source}, so {target} has no effect"
    package = workspace.package_of(remap.place.path)
    entity = Entity("remap", remap.source, remap.target)
    line = line_of_name(remap.place.path, remap.place.line, remap.source, workspace)
    return RULE.finding(text, entity, package, [Evidence(remap.place.path, line)], certainty="likely")
