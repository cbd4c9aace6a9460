"""LNT056: a launch file uses an argument that it does not have, or includes a file with other arguments than it has."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.launch_arguments import Handing, LaunchArguments
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT056",
    name="launch_argument_unknown",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the launch stops there",
    resolution="declare the argument, or use the name that is declared",
    tier="stable",
)
_KIND: Final = "launch_argument"
_ROS_1: Final = 1


def tell(known: Known) -> Iterator[Finding]:
    """Report arguments of ROS 1 that roslaunch refuses, and of ROS 2 those that no file of a launch can have."""
    launches = LaunchArguments(known)
    yield from _undeclared(known, launches)
    yield from _handed(known, launches)
    for version, include in launches.of_one_version():
        missing = _unset(include, launches) if version == _ROS_1 else _not_handed(include, launches)
        path = known.path_of(*include.target)
        yield from (_missing(each, path, include, known.lines_of(include.target[0], each.lines)) for each in missing)


def _undeclared(known: Known, launches: LaunchArguments) -> Iterator[Finding]:
    """An include cannot give what is not declared; a person who starts the file can, on the command line."""
    into = launches.into
    for asked in known.asked("substitutes_argument"):
        name, file = asked.requirement.name, (asked.consumer.name, asked.requirement.owner)
        callers = into.get(file, ())
        if asked.match.state != "dangling" or any(each.given.forwarded for each in callers):
            continue
        near = nearest(name, launches.named[file])
        text = f"$(arg {name}) is used and {asked.path} declares no such argument" + (
            f"; it has {near}" if near else ""
        )
        yield _refused(text, asked, near) if callers or near else _info(text, asked)


def _handed(known: Known, launches: LaunchArguments) -> Iterator[Finding]:
    """What roslaunch calls an unused argument of an include, and what no file of a launch of ROS 2 reads.

    The latter is an info: many a caller hands all that it has. It is a warning where another name is like it, or where
    the file gives its nodes a parameter of that name, which the caller meant to set.
    """
    fixed = {(asked.path, asked.requirement.name) for asked in known.asked("gives_parameter")}
    given = {(each.user, each.place.line, each.target): set(each.given.names) for each in launches.includes}
    for asked in known.asked("hands_argument"):
        wanted, target = asked.requirement, (asked.requirement.package or "", asked.requirement.owner)
        if asked.match.state != "dangling" or launches.places.get(target) != wanted.ros:
            continue
        user = (asked.consumer.name, asked.consumer.inside(asked.path))
        others = given.get((user, wanted.evidence[0].line, target), set())
        near = nearest(wanted.name, launches.named[target] - others)
        path = known.path_of(*target)
        has = f"; it has {near}" if near else ""
        if wanted.ros == _ROS_1:
            yield _refused(f"{path} is given {wanted.name}, which it does not declare{has}", asked, near)
        else:
            level: Severity = "warning" if near or (path, wanted.name) in fixed else "info"
            yield _unread(f"{path} is given {wanted.name}, which nothing reads{has}", asked, near, level)


class _Lacking(msgspec.Struct, frozen=True):
    """An argument that an include leaves without a value; `text` tells of the included file what it does with it."""

    name: str
    text: str
    lines: tuple[Evidence, ...]
    certainty: Certainty = "proved"


def _unset(include: Handing, launches: LaunchArguments) -> Iterator[_Lacking]:
    """An argument without a value stops roslaunch where it is substituted; one that is only declared never does."""
    substituted = launches.substituted[include.target] if not include.given.forwarded else {}
    for name, declared in _left_out(include, launches):
        if name in substituted:
            used = substituted[name]
            text = f"substitutes $(arg {name}) and this include gives {name} no value"
            yield _Lacking(name, text, (declared, *used.evidence), used.certainty)


def _not_handed(include: Handing, launches: LaunchArguments) -> Iterator[_Lacking]:
    """Launch looks at what the include itself hands over; what is set elsewhere, even by a person, does not help."""
    below = {name for each in launches.includes if each.user == include.target for name in each.given.names}
    for name, declared in _left_out(include, launches):
        if name not in below:
            yield _Lacking(name, f"declares {name} without a default and this include does not give it", (declared,))


def _left_out(include: Handing, launches: LaunchArguments) -> Iterator[tuple[str, Evidence]]:
    """Needed arguments that an include does not give, also not by a name that is a slip for them."""
    given, named = set(include.given.names), launches.named[include.target]
    slips = {nearest(name, named - given) for name in given - named}
    for name, declared in sorted(launches.needed[include.target].items()):
        if name not in given | slips:
            yield name, declared


def _refused(text: str, asked: Asked, near: str | None) -> Finding:
    entity = Entity(_KIND, asked.requirement.name, near or "")
    return RULE.finding(text, entity, asked.consumer.name, asked.requirement.evidence)


def _unread(text: str, asked: Asked, near: str | None, level: Severity) -> Finding:
    return RULE.finding(
        text,
        Entity(_KIND, asked.requirement.name, near or ""),
        asked.consumer.name,
        asked.requirement.evidence,
        certainty="likely",
        severity=level,
        consequence="the launch goes on without the value that was meant",
        resolution="use the name that is declared" if near else "leave it out, or declare it where it is meant",
    )


def _missing(lacking: _Lacking, path: str, include: Handing, lines: list[Evidence]) -> Finding:
    return RULE.finding(
        f"{path} {lacking.text}",
        Entity(_KIND, lacking.name, ""),
        include.user[0],
        [include.place, *lines],
        certainty=lacking.certainty,
        resolution=f"give {lacking.name} in the include, or a default where it is declared",
    )


def _info(text: str, asked: Asked) -> Finding:
    return RULE.finding(
        text,
        Entity(_KIND, asked.requirement.name, ""),
        asked.consumer.name,
        asked.requirement.evidence,
        certainty="likely",
        severity="info",
        consequence="the launch stops unless whoever starts it gives the value",
        resolution="declare the argument, so that it is listed with the others",
    )
