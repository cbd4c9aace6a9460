"""LNT055: package.xml names a dependency that no distribution and no key of rosdep has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final, NamedTuple

from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.known_packages import known_packages
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT055",
    name="dependency_unknown",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="rosdep and the build farm stop: they cannot tell what to install",
    resolution="correct the name, remove it, or name it under externals in ecm.toml",
)
_NEAR: Final = 0.93
_LONG: Final = 9
"""Shorter names are alike by chance."""

_VENDOR: Final = re.compile(r"(?:lib)?(?:ignition|gz|sdformat|gazebo)(?:-[a-z]+)*-?\d+(?:-dev)?")
"""Keys of the list of Gazebo's makers (github.com/osrf/osrf-rosdep), where each major version has its own."""
_MANIFEST: Final = "package.xml"
_LAUNCHING: Final = ("starts", "includes_launch")
"""Uses by which launch files name packages."""
_TAKING_IN: Final = ("imports", "includes")
_TOP: Final = re.compile(r"[./]")


def tell(known: Known) -> Iterator[Finding]:
    """Report each name once for a package; what holds under a condition only is left alone."""
    own, launched = frozenset(known.packages.by_name), _launched(known)
    found, coded, first = _by_build(known), _coded(known), dict[tuple[str, str], Asked]()
    for asked in known.asked("depends"):
        if asked.path.endswith(_MANIFEST):
            first.setdefault((asked.consumer.name, asked.requirement.name), asked)
    for (package, name), asked in first.items():
        if name in own or asked.requirement.conditions or _VENDOR.fullmatch(name) is not None:
            continue
        needed = known.needed_by(package)
        used = launched.get(package, frozenset()) - needed
        meant = next((each for each in sorted(used) if _spelled(each) == _spelled(name)), None)
        if meant is not None and known_packages().get(name) is None:
            yield _misspelled(asked, meant)
        elif name not in known.elsewhere:
            empty: frozenset[str] = frozenset()
            written = coded.get(package, empty) - needed
            yield from _of(asked, _Wanting(found.get(package, empty), launched.get(package, empty), written), own)


def _launched(known: Known) -> dict[str, frozenset[str]]:
    """Names of packages that launch files of each package use."""
    found: dict[str, set[str]] = {}
    for use in _LAUNCHING:
        for asked in known.asked(use):
            if asked.requirement.package:
                found.setdefault(asked.consumer.name, set()).add(asked.requirement.package)
    return {package: frozenset(names) for package, names in found.items()}


def _coded(known: Known) -> dict[str, frozenset[str]]:
    """Released packages whose modules or headers the code of each package takes in."""
    found: dict[str, set[str]] = {}
    for use in _TAKING_IN:
        for asked in known.asked(use):
            top = _TOP.split(asked.requirement.name)[0]
            if known_packages().get(top) is not None:
                found.setdefault(asked.consumer.name, set()).add(top)
    return {package: frozenset(names) for package, names in found.items()}


def _spelled(name: str) -> str:
    return name.replace("-", "_").lower()


def _misspelled(asked: Asked, meant: str) -> Finding:
    """A list of sources that has the same slip does not help: the name that launch files ask for is another one."""
    name, package = asked.requirement.name, asked.consumer
    text = f"{package.name} asks for {name}, and its launch files use {meant}"
    return RULE.finding(text, Entity("package", name), package.name, asked.requirement.evidence, severity="error")


def _by_build(known: Known) -> dict[str, frozenset[str]]:
    """Names that the build files of each package look for."""
    found: dict[str, set[str]] = {}
    for asked in known.asked("depends"):
        if not asked.path.endswith(_MANIFEST):
            found.setdefault(asked.consumer.name, set()).add(asked.requirement.name)
    return {package: frozenset(names) for package, names in found.items()}


class _Wanting(NamedTuple):
    """Names of packages that the build of one looks for, and that its launch files and undeclared its code use."""

    found: frozenset[str]
    launched: frozenset[str]
    coded: frozenset[str]


def _of(asked: Asked, wanting: _Wanting, own: frozenset[str]) -> Iterator[Finding]:
    """A finding on a name that is not known for the ROS of its package."""
    name, package = asked.requirement.name, asked.consumer
    where = known_packages().get(name)
    if where is not None and not _is_of_other_ros(where, package.ros):
        return
    level: Severity = "warning"
    if where is not None:
        if name in wanting.found | wanting.launched:
            level = "info"  # its build or a launch finds it: somebody has it from source
        if package.ros == 1:
            level = "info"  # what is released for ROS 2 now may have been there before, unreleased
        text = f"{package.name} asks for {name}, which was released for ROS {where} only"
    else:
        near = _meant(name, wanting, own - {package.name})
        text = f"{package.name} asks for {name}, which no distribution and no key of rosdep has"
        text += f"; {near.words} {near.name}" if near else ""
        level = "error" if near else "info"
        alike = None if near else nearest(name, _alike(name), _NEAR)
        text += f"; released is {alike}" if alike else ""
    yield RULE.finding(text, Entity("package", name), package.name, asked.requirement.evidence, severity=level)


def _alike(name: str) -> list[str]:
    return [other for other in known_packages() if other[:1] == name[:1]] if len(name) >= _LONG else []


class _Meant(NamedTuple):
    """A name that a typing error made another one of, and words for who has it."""

    name: str
    words: str


def _meant(name: str, wanting: _Wanting, own: frozenset[str]) -> _Meant | None:
    """The name that was meant.

    Only what the build of the package finds, or the workspace holds, is meant: among ten thousand names of released
    packages some are alike by chance. A short one is where its code takes in the one with the very same letters.
    """
    found = wanting.found
    turned = next((other for other in sorted(wanting.coded) if sorted(other) == sorted(name)), None)
    if turned is not None and name not in found:
        return _Meant(turned, "its code uses")
    if len(name) < _LONG or name in found:
        return None
    for names, words in ((found & known_packages().keys(), "its CMakeLists.txt finds"), (own, "the workspace has")):
        near = nearest(name, names, _NEAR)
        if near is not None:
            return _Meant(near, words)
    return None


def _is_of_other_ros(where: str, ros: int | None) -> bool:
    return where in {"1", "2"} and ros is not None and where != str(ros)
