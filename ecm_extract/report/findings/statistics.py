"""How many findings each rule has, and how many of them `lint --fix` mends."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final

import msgspec
from ecm_checker.finding import Finding

SCHEMA: Final = "ecm-extract/statistics/1"


class Row(msgspec.Struct, frozen=True):
    """One rule: its id and name, the number of its findings, and of those that can be mended."""

    rule: str
    name: str
    count: int
    fixable: int


def statistics(findings: Iterable[Finding], is_fixable: Callable[[Finding], bool]) -> tuple[Row, ...]:
    """Return the rules that found something, the most frequent first."""
    found = list(findings)
    counts = Counter((finding.rule, finding.name) for finding in found)
    fixable = Counter(finding.rule for finding in found if is_fixable(finding))
    rows = (Row(rule, name, count, fixable[rule]) for (rule, name), count in counts.items())
    return tuple(sorted(rows, key=lambda row: (-row.count, row.rule)))


def never(_finding: Finding) -> bool:
    """What check finds is for people to mend."""
    return False


def statistics_text(rows: Sequence[Row]) -> str:
    """Return the rows as a table; empty without rows."""
    if not rows:
        return ""
    width = max(len("count"), *(len(str(row.count)) for row in rows))
    lines = [f"{'count':>{width}}  fixable  rule"]
    lines += [f"{row.count:>{width}}  {row.fixable or '-':>7}  {row.rule} {row.name}" for row in rows]
    return "".join(f"{line}\n" for line in lines)


def statistics_json(rows: Sequence[Row]) -> str:
    """Return the rows as one document."""
    document: dict[str, Any] = {"schema": SCHEMA, "rules": rows}
    return msgspec.json.format(msgspec.json.encode(document), indent=2).decode() + "\n"
