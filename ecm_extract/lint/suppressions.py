"""Findings that a person has answered: by a comment on the line, or by fingerprint in a committed file.

A comment is `ecm: ignore[RULE] reason`, in whatever comment syntax the file has, on the line or the line before;
`ecm: ignore[RULE old=NAME]` only for findings that are about that name. The file is `ecm-accepted.toml`.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator
from datetime import date
from typing import Protocol

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.errors import ConfigError
from ecm_extract.rule_ids import rule_id

FILE_NAME = "ecm-accepted.toml"
_COMMENT = re.compile(
    r"ecm:\s*ignore\[(?P<rules>[A-Za-z0-9, ]+?)(?:\s+(?P<key>\w+)=(?P<value>[^\]\s]+))?\](?P<reason>.*)"
)


class Reader(Protocol):
    """What reads a file of the tree."""

    def read(self, path: str) -> bytes | None:
        """Return the bytes of a file, None when it cannot be read."""


class Accepted(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One accepted finding: its fingerprint, why, and the day after which it counts again."""

    fingerprint: str
    reason: str
    rule: str = ""
    until: date | None = None


class Comment(msgspec.Struct, frozen=True):
    """One inline suppression; `word` must stand in the message when it is set."""

    path: str
    line: int
    rules: tuple[str, ...]
    word: str
    reason: str


class Answered(msgspec.Struct, frozen=True):
    """What is left of the findings, what was answered, and answers that match nothing."""

    findings: tuple[Finding, ...]
    suppressed: int
    unused: tuple[str, ...]


def parse_accepted(data: bytes, path: str = FILE_NAME) -> tuple[Accepted, ...]:
    """Read the file of accepted findings.

    Raises:
        ConfigError: it is not TOML, or a row is wrong.
    """
    try:
        table = tomllib.loads(data.decode("utf-8"))
        return msgspec.convert(table.get("accept", []), tuple[Accepted, ...])
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ConfigError(path, 0, "accept", f"{error}") from None


def accepted_row(entry: Accepted) -> str:
    """Return one row as it is written into the file."""
    until = f"until = {entry.until.isoformat()}\n" if entry.until is not None else ""
    rule = f"rule = {_quoted(entry.rule)}\n" if entry.rule else ""
    return f"\n[[accept]]\nfingerprint = {_quoted(entry.fingerprint)}\n{rule}reason = {_quoted(entry.reason)}\n{until}"


def answered(findings: Iterable[Finding], accepted: Iterable[Accepted], files: Reader, today: date) -> Answered:
    """Take out what was answered.

    Args:
        findings: of a run.
        accepted: rows of the file; one whose day has passed counts no longer.
        files: read the lines that may hold a comment.
        today: the day of the run.
    """
    rows = {row.fingerprint: row for row in accepted}
    valid = {key for key, row in rows.items() if row.until is None or row.until >= today}
    every = list(findings)
    comments = list(_comments({entry.path for each in every for entry in each.evidence[:1]}, files))
    used: set[object] = set()
    left = []
    for finding in every:
        comment = next((each for each in comments if _covers(each, finding)), None)
        if finding.fingerprint in valid:
            used.add(finding.fingerprint)
        elif comment is not None:
            used.add(comment)
        else:
            left.append(finding)
    unused = [f"{FILE_NAME}: {key} matches no finding ({row.reason})" for key, row in rows.items() if key not in used]
    unused += [
        f"{each.path}:{each.line}: ignore[{', '.join(each.rules)}] matches no finding"
        for each in comments
        if each not in used
    ]
    return Answered(tuple(left), len(every) - len(left), tuple(unused))


def _comments(paths: Iterable[str], files: Reader) -> Iterator[Comment]:
    for path in sorted(paths):
        data = files.read(path)
        if data is None or b"ecm:" not in data:
            continue
        for number, line in enumerate(data.decode("utf-8", "replace").splitlines(), 1):
            match = _COMMENT.search(line)
            if match is not None:
                rules = tuple(rule_id(rule) for rule in match["rules"].split(",") if rule.strip())
                yield Comment(path, number, rules, match["value"] or "", match["reason"].strip(" -*/>"))


def _covers(comment: Comment, finding: Finding) -> bool:
    place = finding.evidence[0] if finding.evidence else None
    if place is None or place.path != comment.path or finding.rule not in comment.rules:
        return False
    return place.line - comment.line in (0, 1) and comment.word in finding.message


def _quoted(text: str) -> str:
    plain = "".join(char for char in text if char.isprintable())
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
