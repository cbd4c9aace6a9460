"""VER001 `field_break`: a consumer names what a release took away; one finding per cause, with all its readers."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from typing import Final

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity
from ecm_checker.hub.kinds import kinds
from ecm_checker.release import Change, fingerprint_of

from ecm_extract.diff.model import Located
from ecm_extract.diff.use import Use

RULE: Final = "VER001"
NAME: Final = "field_break"


def findings_of(uses: Iterable[Use]) -> tuple[Finding, ...]:
    """Return one finding for each change that somebody uses."""
    found = [finding_of(located, readers) for located, readers in grouped_uses(uses)]
    return tuple(sorted(found, key=lambda entry: (_rank(entry.severity), entry.message, entry.fingerprint)))


def grouped_uses(uses: Iterable[Use]) -> list[tuple[Located, list[Use]]]:
    """Return changes with the lines that each breaks, in the order of the lines."""
    grouped: dict[object, list[Use]] = defaultdict(list)
    for use in uses:
        grouped[use.located.change].append(use)
    return [(readers[0].located, readers) for readers in grouped.values()]


def line_of(use: Use) -> Evidence:
    """Return the line of a consumer as evidence."""
    return msgspec.structs.replace(use.at, commit=use.commit)


def _rank(severity: Severity) -> int:
    return ("error", "warning", "info").index(severity)


def finding_of(located: Located, uses: Iterable[Use]) -> Finding:
    """Return the finding on a change and the lines that it breaks."""
    change = located.change
    distinct = {(use.path, use.line, use.what): use for use in uses}
    readers = [distinct[place] for place in sorted(distinct, key=lambda place: (bool(distinct[place].kept_for), place))]
    certainty: Certainty = "proved" if any(use.certainty == "proved" for use in readers) else "likely"
    return Finding(
        rule=RULE,
        name=NAME,
        dimension="versioning",
        severity=_severity(change, readers, certainty),
        message=_message(change, readers),
        resolution=_resolution(change, readers),
        subjects=_subjects(change, readers),
        evidence=_evidence(located, readers),
        fingerprint=fingerprint_of(change),
        who=kinds()[change.kind].who,
        certainty=certainty,
        about=Entity(change.kind, change.old or "", change.new or "", change.owner),
    )


def _severity(change: Change, readers: list[Use], certainty: Certainty) -> Severity:
    if change.change == "deprecated" or _is_layout(change, readers) or all(use.kept_for for use in readers):
        return "info"
    if certainty != "proved" or all(use.remapped for use in readers) or change.confidence < 0.5:
        return "warning"
    return "error"


def _message(change: Change, readers: list[Use]) -> str:
    kind = change.kind.replace("_", " ")
    of = f" of {change.owner}" if change.owner else ""
    count = f", and {len(readers) - 1} more" if len(readers) > 1 else ""
    first = f"{readers[0].path}:{readers[0].line} {readers[0].what}{count}"
    ignored = kinds()[change.kind].silence
    if change.change == "deprecated":
        return f"{kind} {change.old}{of} in {change.package} is deprecated: {first}. It still works in this release."
    happened = {
        "added": f"is new: {change.reason}",
        "removed": "is gone",
        "renamed": f"is now {change.new}",
        "moved": f"is now {change.new}",
        "type_changed": f"has another type: {change.reason}",
        "signature_changed": f"has another {'definition' if change.row.generated else 'signature'}: {change.reason}",
    }.get(change.change, f"changed: {change.reason}")
    told = f"{kind} {change.old or change.new}{of} in {change.package} {happened}: {first}."
    if all(use.remapped for use in readers):
        return f"{told} A remap in a launch file keeps the old name alive where it is used."
    if all(use.kept_for for use in readers):
        kept = ", ".join(sorted({use.kept_for for use in readers}))
        return f"{told} The file is kept for {kept}, beside another one; right where the old release runs."
    if _is_layout(change, readers):
        return f"{told} Unless both are built with it, the two sides refuse to connect or wait for ever."
    return f"{told} If ignored, {ignored}."


def _is_layout(change: Change, readers: list[Use]) -> bool:
    """Whether only what both sides compare changed, so that a new build is all that it takes."""
    row = change.row
    if change.change == "added":
        return row.layout or row.fixed
    if row.fixed and all("layout" in use.requirement.row.breaches for use in readers):
        return True  # of those who have the type, nobody names the constant
    return row.generated and change.change == "signature_changed"


def _resolution(change: Change, readers: list[Use]) -> str:
    if _is_layout(change, readers):
        return "build both sides with the new definition, and migrate recorded bags"
    if change.change in {"renamed", "moved"} and change.new:
        return f"write {change.new} instead of {change.old}"
    if change.change in {"signature_changed", "type_changed"}:
        return f"follow the new form: {change.reason}"
    if change.change == "deprecated":
        return f"move to what its deprecation names: {change.reason}"
    if change.row.duty and change.change in {"added", "default_changed"}:
        return f"give {change.new} a value where the file is included"
    return f"stop using {change.old}; {change.reason}"


def _subjects(change: Change, readers: list[Use]) -> tuple[str, ...]:
    provider = f"ecm.{change.package}.{change.owner}" if change.owner else f"ecm.{change.package}"
    return (provider, *sorted({f"ecm.{use.package}" for use in readers}))


def _evidence(located: Located, readers: list[Use]) -> tuple[Evidence, ...]:
    lines = [line_of(use) for use in readers]
    change = located.change
    lines += [entry for entry in (change.evidence_old, change.evidence_new) if entry is not None]
    return tuple(dict.fromkeys(lines))
