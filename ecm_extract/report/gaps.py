"""What an extraction could not resolve, grouped by cause, for people: few reasons, not many lines."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_checker.contract import Contract, Evidence, Interface
from ecm_checker.hub.roles import roles

from ecm_extract.extraction_model import Extraction, LocatedDiagnostic
from ecm_extract.overlay.problems import is_of_overlay


class Spot(msgspec.Struct, frozen=True):
    """One place where something is not known.

    Attributes:
        place: `path:line`; the path alone when the file as a whole is meant.
        detail: what is written there, or the message.
    """

    place: str
    detail: str


class Gap(msgspec.Struct, frozen=True):
    """One cause for which something is not known.

    Attributes:
        cause: in words for interfaces, `severity: code` for diagnostics.
        count: how often, in all modules.
        spots: the different places, in the order of the extraction.
    """

    cause: str
    count: int
    spots: tuple[Spot, ...]


def gaps(extraction: Extraction) -> list[Gap]:
    """All causes, the most frequent first."""
    found: dict[str, list[Spot]] = {}
    for cause, place, detail in [*_interface_gaps(extraction), *_diagnostic_gaps(extraction)]:
        found.setdefault(cause, []).append(Spot(place, detail))
    causes = [Gap(cause, len(spots), tuple(dict.fromkeys(spots))) for cause, spots in found.items()]
    return sorted(causes, key=lambda gap: (-gap.count, gap.cause))


def modules(extraction: Extraction) -> Iterator[Contract]:
    """The contracts of all packages."""
    for package in extraction.packages:
        yield from package.modules


def interfaces(extraction: Extraction) -> Iterator[Interface]:
    """The interfaces of all modules."""
    for module in modules(extraction):
        yield from module.signature.interfaces


def _interface_gaps(extraction: Extraction) -> Iterator[tuple[str, str, str]]:
    for interface in interfaces(extraction):
        place = _place(interface.evidence)
        if interface.confidence == "pattern":
            yield "name is computed when it runs", place, interface.name
        if interface.type is None and roles()[interface.role].shape:
            yield "type is not known", place, interface.name


def _diagnostic_gaps(extraction: Extraction) -> Iterator[tuple[str, str, str]]:
    """Those of overlays are a person's own and told one by one, see `overlay.problems`."""
    for each in extraction.diagnostics:
        if is_of_overlay(each):
            continue
        yield f"{each.severity}: {each.code}", _line_of(each), each.message


def _place(evidence: tuple[Evidence, ...]) -> str:
    return f"{evidence[0].path}:{evidence[0].line}" if evidence else "no evidence"


def _line_of(diagnostic: LocatedDiagnostic) -> str:
    return f"{diagnostic.path}:{diagnostic.line}" if diagnostic.line else diagnostic.path
