"""What packages require of others that are not among them: met, or not there, as soon as somebody has shown these."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.match.packages import Packages
from ecm_checker.rules.sig014 import RULE
from ecm_checker.unmet_findings import unmet_findings

RULE_ID: Final = RULE.id


class Outside(msgspec.Struct, frozen=True):
    """What others provide.

    Attributes:
        shown: which releases are meant, in words.
        packages: that are known, as providers: what they require in turn is not asked.
        unknown: names of packages that are required and not known.
        documents: those of the packages that are known by documents that were named.
    """

    shown: str
    packages: tuple[Package, ...]
    unknown: tuple[str, ...]
    documents: tuple[Package, ...] = ()

    @property
    def released(self) -> tuple[Package, ...]:
        """Those of the packages that a registry tells of."""
        return tuple(each for each in self.packages if each not in self.documents)


Known = Callable[[Sequence[Package]], Outside]
"""Gives what is known outside of packages."""


def gathered(documents: Sequence[Package], registry: Known | None) -> Known:
    """Return what gives all that is known outside: documents that were named, and what a registry has beside."""

    def known(inside: Sequence[Package]) -> Outside:
        found = registry(inside) if registry is not None else Outside("", (), ())
        named = {each.name for each in documents}
        others = tuple(each for each in found.packages if each.name not in named)
        unknown = tuple(name for name in found.unknown if name not in named)
        return Outside(found.shown, (*documents, *others), unknown, tuple(documents))

    return known


def outside_findings(inside: Sequence[Package], outside: Outside) -> Iterator[Finding]:
    """Yield a finding for each name that packages require of others and that these do not provide.

    Lines are those of who requires: those of others are not in the tree.

    Args:
        inside: who requires; what they require of each other is not asked here.
        outside: who provides; of packages that are not among them nothing is said.
    """
    own = {each.name for each in inside}
    askers = [msgspec.structs.replace(each, provides=(), bound=()) for each in inside]
    unmet = (each for each in Packages([*outside.packages, *askers]).unmet() if each.requirement.package not in own)
    lines = {at for each in inside for entry in each.requires for at in entry.evidence}
    for finding in unmet_findings(RULE, unmet):
        yield msgspec.structs.replace(finding, evidence=tuple(at for at in finding.evidence if at in lines))


def told(outside: Outside) -> Iterator[str]:
    """Yield what was known and what was not, in words."""
    if outside.documents:
        yield f"known from documents: {len(outside.documents)} packages"
    if outside.shown:
        yield f"known from the registry: {len(outside.packages) - len(outside.documents)} packages ({outside.shown})"
    if outside.unknown:
        yield f"not in the registry, so nothing is known of them: {', '.join(outside.unknown)}"
