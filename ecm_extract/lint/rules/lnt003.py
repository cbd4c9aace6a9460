"""LNT003: a launch file starts a program that its package does not build."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import slip
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT003",
    name="executable_missing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="launch_ros finds no such program and stops the whole launch",
    resolution="correct the name, or install the program",
    tier="stable",
)

_GOES_ON = "roslaunch reports it and goes on without the node"
_GOES_ON_WITHOUT = "roslaunch reports them and goes on without their nodes"
_KIND = "executable"
_SHOWN = 5


def tell(known: Known) -> Iterator[Finding]:
    """Report programs that launch files start and that their package, being known, neither provides nor may build."""
    missing: dict[tuple[str, str, str], list[Asked]] = {}
    for asked in known.asked("starts"):
        wanted = asked.requirement
        if asked.match.state == "dangling":
            missing.setdefault((asked.consumer.name, wanted.package or "", wanted.name), []).append(asked)
    together: dict[tuple[str, str], dict[str, list[Asked]]] = {}
    for (consumer, package, name), group in missing.items():
        if _target(known.near(name, package, _KIND)):
            yield _finding(package, name, group, known)
        else:
            together.setdefault((consumer, package), {})[name] = group
    for (_, package), groups in together.items():
        if len(groups) == 1:
            yield from (_finding(package, name, group, known) for name, group in groups.items())
        else:
            yield _left_over(package, groups)


def _left_over(package: str, groups: Mapping[str, Sequence[Asked]]) -> Finding:
    """One finding for who starts several programs of a package, none of which has nearly the name of one that is."""
    names = list(groups)
    every = [asked for group in groups.values() for asked in group]
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return RULE.finding(
        f"{package} builds no programs {', '.join(names[:_SHOWN])}{more}",
        Entity(_KIND, " ".join(names)),
        every[0].consumer.name,
        [place for asked in every for place in asked.requirement.evidence],
        consequence=_GOES_ON_WITHOUT if every[0].consumer.ros == 1 else "",
        resolution="correct the names, install the programs, or remove what starts them",
    )


def _finding(package: str, name: str, group: list[Asked], known: Known) -> Finding:
    """One finding for a package that names the program several times, in whichever launch files."""
    near = _target(known.near(name, package, _KIND))
    text = f"{package} builds no program {name}" + (f"; it builds {near}" if near else "")
    return RULE.finding(
        text,
        Entity(_KIND, name, near),
        group[0].consumer.name,
        [place for asked in group for place in asked.requirement.evidence],
        consequence=_GOES_ON if group[0].consumer.ros == 1 else "",
        resolution=f"write {near}" if near else "",
        edit=slip(name, near),
    )


def _target(near: str) -> str:
    """A near name that is sure enough to be written: scripts of one folder are often alike and other programs."""
    return near if "." not in near else ""
