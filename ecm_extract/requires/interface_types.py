"""Interface files: the messages of which their fields are."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required


def interface_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the fields of the messages, services and actions of a package require."""
    for path, definition in facts.interfaces.items():
        for section in definition.sections:
            for field in section.fields:
                owner, _, name = _bare(field.type).partition("/")
                last = name.rpartition("/")[2]
                if last:
                    place = Place(path, field.line, f"{definition.shape} {path.rpartition('/')[2]}")
                    yield required("has_field_of", f"{owner}.msg.{last}", place, package=owner, said=_bare(field.type))


def _bare(text: str) -> str:
    """A type without the bounds of an array or text."""
    return text.partition("[")[0].partition("<")[0]
