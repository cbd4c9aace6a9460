"""What only the score may see of a case: its story, its gold dimensions, and which state is the broken one."""

from __future__ import annotations

from pathlib import Path
from typing import Final, Literal

import msgspec
from ecm_checker.finding import Dimension

from ecm_corpus.interface import read_record

Grade = Literal["discriminating", "trigger", "class", "not_scorable", "out_of_reach", "missed"]
GRADES: Final[tuple[Grade, ...]] = ("discriminating", "trigger", "class", "missed", "out_of_reach", "not_scorable")

Limit = Literal["none", "class", "not_scorable", "out_of_reach"]


class Fact(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A line that the case rests on: `owner/name@ref:path:line`, and what it shows in our own words."""

    at: str
    shows: str


class Conflict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a finding must be about to count for the case.

    Attributes:
        files: one of them is in the finding's evidence, compared from the end of the path; empty for any.
        names: one of them stands, as a whole word, in the names that the finding is about or in what its rule
            speaks of; empty for any.
        lines: `path:line` in the evidence counts like a name: of several things with one cause a finding is about the
            first, and has the lines of all.
        old, new: the entity before and after, where there is one.
    """

    files: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    lines: tuple[str, ...] = ()
    old: str = ""
    new: str = ""


class Narrative(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The narrative part of one case (`corpus/cases/narrative/<case>.yaml`).

    Attributes:
        case: id, as in the interface part.
        title, story: what happened, in our own words.
        gold: dimensions that the corpus's own taxonomy gives, by the paper's crosswalk.
        source: where it was documented.
        paper_fired: dimensions that the paper's checker fired on; empty for a miss.
            None where it was not scored there.
        derivable: whether the conflict can be read from source, as found in the repositories.
        buggy, controls: names of states; a control must be quiet about the conflict.
        conflict: what a finding must be about.
        limit: the best grade that the record allows: `class` when the pair is a stand-in of the same kind,
            `not_scorable` without text or artefact, `out_of_reach` when no artefact shows the fault.
        audit: where the record is wrong or loose, and why the limit.
        facts: lines that the case rests on.
    """

    case: str
    title: str
    story: str
    gold: tuple[Dimension, ...]
    source: str
    derivable: Literal["yes", "partly", "no"]
    paper_fired: tuple[Dimension, ...] | None = None
    buggy: tuple[str, ...] = ()
    controls: tuple[str, ...] = ()
    conflict: Conflict = Conflict()
    limit: Limit = "none"
    audit: str = ""
    facts: tuple[Fact, ...] = ()


class Excluded(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A documented bug that is not scored, and why."""

    case: str
    source: str
    reason: str


class ExcludedList(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """`corpus/cases/excluded.yaml`."""

    excluded: tuple[Excluded, ...]


def read_narrative(path: Path) -> Narrative:
    """The narrative part of a case from its file.

    Raises:
        InputError: the file cannot be read, or does not fit; the message names the key.
    """
    return read_record(path, Narrative)
