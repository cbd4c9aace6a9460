"""What a blind run may see of a case: repositories, refs, packages, and the question; nothing of the story.

A case has several states, such as a composition before and after a repair. Their names and their order say
nothing about which is which: that is in the narrative.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final, Literal, TypeVar

import msgspec
from ecm_parsers.yaml_tree import parse_yaml, plain

from ecm_extract.errors import InputError

Substrate = Literal["robust", "ros2", "replication", "wider"]
_Record = TypeVar("_Record", bound=msgspec.Struct)

SUBSTRATES: Final[tuple[Substrate, ...]] = ("robust", "ros2", "replication", "wider")


class Source(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A repository at a ref.

    Attributes:
        repository: `owner/name` on the forge that the case's URL scheme names.
        ref: tag or full commit id.
        packages: whose contracts are kept and whose findings count; empty for all.
    """

    repository: str
    ref: str
    packages: tuple[str, ...] = ()


class Composition(msgspec.Struct, frozen=True, forbid_unknown_fields=True, tag_field="question", tag="composition"):
    """May what these trees hold run together?

    Attributes:
        trees: read as one workspace.
        launch: files that start the composition, as `<repository's name>/<path>`; empty when any file may.
    """

    trees: tuple[Source, ...]
    launch: tuple[str, ...] = ()


class Upgrade(msgspec.Struct, frozen=True, forbid_unknown_fields=True, tag_field="question", tag="upgrade"):
    """May `new` replace `old` under these consumers?"""

    old: Source
    new: Source
    consumers: tuple[Source, ...] = ()


State = Composition | Upgrade


class InterfaceCase(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The interface part of one case (`corpus/cases/interface/<case>.yaml`).

    Attributes:
        case: id, as in the ledger of the paper (appendix B) with the prefix of its substrate.
        substrate: the set that it is scored in.
        states: what is to be judged, each by itself. Empty when no artefact could be identified.
    """

    case: str
    substrate: Substrate
    states: dict[str, State] = {}


def sources_of(state: State) -> tuple[Source, ...]:
    """Every repository at a ref that a state names, in the order of the file."""
    if isinstance(state, Composition):
        return state.trees
    return state.old, state.new, *state.consumers


def read_interface(path: Path) -> InterfaceCase:
    """The interface part of a case from its file.

    Raises:
        InputError: the file cannot be read, or does not fit; the message names the key.
    """
    return read_record(path, InterfaceCase)


def read_record(path: Path, kind: type[_Record]) -> _Record:
    """One YAML document as a record.

    Raises:
        InputError: the file cannot be read, is not YAML, or does not fit.
    """
    try:
        parsed = parse_yaml(path.read_bytes())
    except OSError as error:
        message = f"cannot read {path}: {error.strerror}"
        raise InputError(message) from error
    for diagnostic in parsed.diagnostics:
        message = f"{path}:{diagnostic.line}: {diagnostic.message}"
        raise InputError(message, "a case is one YAML document")
    try:
        return msgspec.convert(plain(parsed.facts[0]) if parsed.facts else {}, kind)
    except msgspec.ValidationError as error:
        message = f"{path}: {error}"
        raise InputError(message, f"fields: {', '.join(kind.__struct_fields__)}") from error
