"""Comments `ecm: ignore[RULE] reason`, in whatever comment syntax a file has, on the line or the line before.

`ecm: ignore[RULE old=NAME]` is only for findings that are about that name.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Final

import msgspec
from ecm_checker.finding import Finding

from ecm_extract.answers.scope import CHANGE_RULES
from ecm_extract.rule_ids import rule_id

Read = Callable[[str], bytes | None]
"""Content of a file of the tree by its path, None when it cannot be read."""

_COMMENT: Final = re.compile(
    r"ecm:\s*ignore\[(?P<rules>[A-Za-z0-9, ]+?)(?:\s+(?P<key>\w+)=(?P<value>[^\]\s]+))?\](?P<reason>.*)"
)


class Comment(msgspec.Struct, frozen=True):
    """One inline answer; `word` must stand in a name that the finding is about."""

    path: str
    line: int
    rules: tuple[str, ...]
    word: str
    reason: str

    def covers(self, finding: Finding) -> bool:
        """Whether the comment answers a finding."""
        place = finding.evidence[0] if finding.evidence else None
        if place is None or place.path != self.path or not self._names(finding.rule):
            return False
        return place.line - self.line in (0, 1) and finding.names(self.word)

    def _names(self, rule: str) -> bool:
        """One change has two rules; to name one of them is enough."""
        return rule in self.rules or (rule in CHANGE_RULES and not CHANGE_RULES.isdisjoint(self.rules))


def comments_in(paths: Iterable[str], read: Read) -> Iterator[Comment]:
    """Yield the comments of files, by path and line."""
    for path in sorted(set(paths)):
        data = read(path)
        if data is None or b"ecm:" not in data:
            continue
        for number, line in enumerate(data.decode("utf-8", "replace").splitlines(), 1):
            match = _COMMENT.search(line)
            if match is not None:
                rules = tuple(rule_id(rule) for rule in match["rules"].split(",") if rule.strip())
                yield Comment(path, number, rules, match["value"] or "", match["reason"].strip(" -*/>"))
