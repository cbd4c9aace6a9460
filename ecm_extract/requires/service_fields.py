"""Fields of service requests and responses that calls give and variables have, where the service is known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Given, Requirement

from ecm_extract.link.code.units import File
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required
from ecm_extract.requires.service_calls import ServiceCall, service_calls
from ecm_extract.requires.service_members import Touched, touched_members

REQUEST: Final = "request"
_SPREAD: Final = "**"


def service_field_requirements(
    files: Sequence[File], linked: Sequence[LinkedModule], packages: Sequence[PackageFacts]
) -> Iterator[tuple[str, Requirement]]:
    """Yield package and requirement of each field that a call of a proxy gives, and a request or response has."""
    for call in service_calls(files, linked):
        for found in _of_call(call):
            yield call.file.package, found
    for touched in touched_members(files, packages):
        yield touched.file.package, _of_member(touched)


def _of_call(call: ServiceCall) -> Iterator[Requirement]:
    names = tuple(name for name, _ in call.call.keywords if name and name != _SPREAD)
    place = Place(call.file.path, call.line, f"file {call.file.path}")
    for name in names:
        given = Given(names=names)
        yield _field("gives_field", name, REQUEST, call.service, place, given)


def _of_member(touched: Touched) -> Requirement:
    place = Place(touched.file.path, touched.line, f"file {touched.file.path}")
    return _field("has_field", touched.field, touched.section, touched.service, place, None)


def _field(use: str, name: str, section: str, service: str, place: Place, given: Given | None) -> Requirement:
    package = service.partition("/")[0]
    evidence = (Evidence(place.path, place.line),)
    return required(use, f"{section}.{name}", place, package=package, owner=service, given=given, evidence=evidence)
