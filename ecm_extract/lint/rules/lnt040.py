"""LNT040: an analyzer cuts off the name of a node that nothing starts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.package import Package

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT040",
    name="diagnostics_prefix_unknown",
    dimension="behavior",
    severity="warning",
    who="config",
    consequence="diagnostics keep their prefix, and who looks for them by name does not find them",
    resolution="write the name of the node that publishes them",
)
_KIND = "node"
_NAMING = ("reads_file", "names_file")
_STATUSES = "diagnostic_msgs/msg/DiagnosticArray"
_UPDATER = "diagnostic_updater"
"""It puts the name of the node before those of its statuses."""


def tell(known: Known) -> Iterator[Finding]:
    """Report prefixes of analyzers of a package whose launch files, which load them, start no node of that name."""
    names = {name.rpartition("/")[2] for name in known.launched(_KIND)}
    started = _unnamed(known)
    loaded, reaching, by_hand = _loaded(known), _reaching(known), _names_statuses(known)
    for asked in known.asked("strips_prefix"):
        is_loaded = asked.path.rpartition("/")[2] in loaded.get(asked.consumer.name, ())
        if not is_loaded or asked.consumer.name in reaching or _is_start(asked.requirement.name, names | started):
            continue
        if not by_hand or nearest(asked.requirement.name, sorted(names)):
            yield _finding(asked, names)


def _is_start(prefix: str, names: set[str]) -> bool:
    """Tell whether it is how the name of a node begins, or all of it."""
    return any(name.startswith(prefix) for name in names)


def _names_statuses(known: Known) -> bool:
    """Tell whether somebody fills in statuses by hand, whose names are no names of nodes."""
    packages = known.packages.by_name.values()
    own = (package for package in packages if _UPDATER not in known.needed_by(package.name))
    return any(row.type == _STATUSES for package in own for row in package.provides)


def _finding(asked: Asked, names: set[str]) -> Finding:
    key, node = asked.requirement.said, asked.requirement.name
    near = nearest(node, sorted(names))
    text = f"remove_prefix of the analyzer {key} is {node}, and no launch file starts a node of that name"
    text += f"; one starts {near}" if near else ""
    entity = Entity("parameter", key, node)
    return RULE.finding(text, entity, asked.consumer.name, asked.requirement.evidence, certainty="likely")


def _unnamed(known: Known) -> set[str]:
    """Programs of launch files that give fewer names than they start nodes: such a node goes by its program."""
    starts = [(asked.path, asked.requirement.name) for asked in known.asked("starts")]
    unnamed = Counter(path for path, _ in starts) - Counter(asked.path for asked in known.asked("names_node"))
    return {name for path, name in starts if path in unnamed}


def _loaded(known: Known) -> dict[str, set[str]]:
    """Names of the files that launch files of each package name which start nodes."""
    starting = {asked.path for asked in known.asked("starts")}
    found: dict[str, set[str]] = {}
    for use in _NAMING:
        for asked in known.asked(use):
            if asked.path in starting:
                found.setdefault(asked.consumer.name, set()).add(asked.requirement.name.rpartition("/")[2])
    return found


def _reaching(known: Known) -> set[str]:
    """Packages with launch files that include those of packages that are not known, whose nodes are not either."""
    asked = known.asked("includes_launch")
    return {each.consumer.name for each in asked if not _is_known(each.requirement.package, known.packages.by_name)}


def _is_known(package: str | None, known: Mapping[str, Package]) -> bool:
    return package is not None and package in known
