"""Messages, services and actions with their fields and constants."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePosixPath

from ecm_checker.hub.provision import Provision
from ecm_parsers.interface_facts import Constant, Definition, Field

from ecm_extract.read.facts import PackageFacts


def interface_name(package: str, path: str, definition: Definition) -> str:
    """Return `package/msg|srv|action/Name`."""
    return f"{package}/{definition.shape}/{PurePosixPath(path).stem}"


def interface_names(facts: PackageFacts) -> Iterator[Provision]:
    """Yield every interface of a package, without what is in it."""
    for path, definition in sorted(facts.interfaces.items()):
        name = interface_name(facts.name, path, definition)
        told = {"kind": "message", "type": definition.shape, "ros": facts.ros}
        yield Provision(package=facts.name, owner="", name=name, path=path, line=1, **told)  # type: ignore[arg-type]


def interface_entities(facts: PackageFacts) -> Iterator[Provision]:
    """Yield every interface of a package, its fields and constants."""
    yield from interface_names(facts)
    for path, definition in sorted(facts.interfaces.items()):
        name = interface_name(facts.name, path, definition)
        for section in definition.sections:
            prefix = "" if section.name == "message" else f"{section.name}."
            for field in section.fields:
                yield _member(facts, path, name, prefix, "message_field", field)
            for constant in section.constants:
                yield _member(facts, path, name, prefix, "constant", constant)


def _member(facts: PackageFacts, path: str, owner: str, prefix: str, kind: str, member: Field | Constant) -> Provision:
    notes = f"{member.comment}\n{member.doc}"
    return Provision(
        kind=kind,
        package=facts.name,
        owner=owner,
        name=prefix + member.name,
        facet=prefix.rstrip("."),
        type=_full_type(facts.name, member) if isinstance(member, Field) else member.type,
        default=member.value if isinstance(member, Constant) else member.default,
        ros=facts.ros,
        deprecated=" ".join(notes.split()) if "deprecated" in notes.lower() else None,
        path=path,
        line=member.line,
    )


def _full_type(package: str, field: Field) -> str:
    """A nested type with its package, so that `Pose` and `geometry_msgs/Pose` inside geometry_msgs are the same."""
    head, bracket, bound = field.type.partition("[")
    parts = head.split("/")
    if len(parts) == 3:
        head = f"{parts[0]}/{parts[2]}"
    elif len(parts) == 1 and field.package is not None:
        head = f"{field.package}/{head}"
    elif len(parts) == 1 and head[:1].isupper():
        head = f"{package}/{head}"
    return head + bracket + bound
