"""Answers of the registry in words: for a terminal, and as the comment of a pull request."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import msgspec
from ecm_checker.json_data import json_data

from ecm_extract.registry.channels import gate_table
from ecm_extract.registry.doubts import Doubt
from ecm_extract.registry.evidence import Added
from ecm_extract.registry.fit import Fit
from ecm_extract.registry.gates import Verdict
from ecm_extract.registry.impact import Break, Impact
from ecm_extract.registry.lock import Lock
from ecm_extract.registry.users import User
from ecm_extract.report.terminal import one_line

MAX_LINES = 20


def impact_text(impact: Impact) -> str:
    """Return what breaks, each change with its users and their lines."""
    return "\n".join(_impact(impact)) + "\n"


def impact_markdown(impact: Impact) -> str:
    """Return what breaks as the comment of a pull request."""
    return "\n".join(_impact_markdown(impact)) + "\n"


def fit_text(found: Fit) -> str:
    """Return whether releases fit, with what stands against them."""
    return "\n".join(_fit(found)) + "\n"


def verdict_text(verdict: Verdict) -> str:
    """Return what the gates said, each with its reasons."""
    return "\n".join(_verdict(verdict)) + "\n"


def lock_text(lock: Lock, *, explain: bool) -> str:
    """Return what was chosen; also who asked for it, and why nothing better was, when asked to explain."""
    return "\n".join(one_line(line, 600) for line in _lock(lock, explain=explain)) + "\n"


def added_lines(added: Sequence[Added]) -> Iterator[str]:
    """Yield how many records were kept of each release, and how many of them cannot confirm it."""
    for release in dict.fromkeys(each.release for each in added):
        names = [each.names_content for each in added if each.release == release]
        other = names.count(False)
        told = f", {other} of them about another content than is stored: they confirm nothing of it" if other else ""
        yield f"{release}: {len(names)} records{told}"


def as_json(document: msgspec.Struct) -> str:
    """Return a document as JSON, indented by one space."""
    data: Any = json_data(msgspec.to_builtins(document))
    return msgspec.json.format(msgspec.json.encode(data), indent=1).decode() + "\n"


def _impact(impact: Impact) -> Iterator[str]:
    for each in impact.breaks:
        yield from _break(each)
    yield one_line(_sum(impact), 500)
    yield from _unknown(impact.missing, impact.doubts)


def _unknown(missing: Sequence[str], doubts: Sequence[Doubt]) -> Iterator[str]:
    yield from (one_line(f"not stored, so nothing is known of it: {name}") for name in missing)
    yield from (one_line(f"not known: {_doubt(each)}", 600) for each in doubts[:MAX_LINES])
    if len(doubts) > MAX_LINES:
        yield f"not known: {len(doubts) - MAX_LINES} more places; --format json has them all"


def _doubt(doubt: Doubt) -> str:
    at = f"{doubt.path}:{doubt.line}" if doubt.line else doubt.path
    return f"{doubt.release} {at} {doubt.why}"


def doubts_text(doubts: Sequence[Doubt]) -> str:
    """Return places of which nothing is known, each on a line; empty when there are none."""
    return "".join(f"{line}\n" for line in _unknown((), doubts))


def _break(each: Break) -> Iterator[str]:
    yield one_line(f"{each.severity}: {each.message}", 1000)
    for user in each.users:
        yield from (one_line(f"    {line}", 600) for line in _lines(user))
    yield one_line(f"    do: {each.instead}", 600)
    yield ""


def _lines(user: User) -> Iterator[str]:
    for at in user.lines[:MAX_LINES]:
        yield f"{user.package}@{user.version} {at.path}:{at.line} {at.what} ({at.certainty})"
    if len(user.lines) > MAX_LINES:
        yield f"{user.package}@{user.version} and {len(user.lines) - MAX_LINES} more lines"


def _sum(impact: Impact) -> str:
    count = len(impact.broken)
    verdict = impact.verdict
    nobody = "nobody breaks" if impact.is_whole else "nobody is known to break, and not everything is known"
    who = f"{count} releases break: {', '.join(impact.broken)}" if count else nobody
    step = f"{verdict.compatibility_class}, needs {verdict.required_bump}, takes {verdict.declared_bump or 'unknown'}"
    return f"{impact.old} -> {impact.new} ({step}): {who}; asked: {impact.scope}"


def _impact_markdown(impact: Impact) -> Iterator[str]:
    yield f"**ecm-extract impact**: {_cell(_sum(impact))}"
    yield ""
    if impact.breaks:
        yield "| | who | line | what | what to write instead |"
        yield "|---|---|---|---|---|"
    for each in impact.breaks:
        for user in each.users:
            yield from _rows(each, user)
    yield from (f"- {_cell(line)}" for line in _unknown(impact.missing, impact.doubts))


def _rows(each: Break, user: User) -> Iterator[str]:
    who = _cell(f"{user.package} {user.version}")
    for at in user.lines[:MAX_LINES]:
        yield f"| {each.severity} | {who} | `{_cell(at.path)}:{at.line}` | {_cell(at.what)} | {_cell(each.instead)} |"
    if len(user.lines) > MAX_LINES:
        yield f"| {each.severity} | {who} | | {len(user.lines) - MAX_LINES} more lines | |"


def _cell(text: str) -> str:
    return one_line(text, 600).replace("|", "\\|").replace("<", "&lt;").replace("`", "'")


def _fit(found: Fit) -> Iterator[str]:
    for impact in found.impacts:
        yield from _impact(impact)
    for need in found.needs:
        yield one_line(f"{'review' if need.state == 'unknown' else 'error'}: {need.text}")
    for finding in found.findings:
        yield one_line(f"{finding.severity}: {finding.message} [{finding.rule}]", 1000)
        yield one_line(f"    do: {finding.resolution}", 600)
    yield one_line(f"{found.outcome}: {', '.join(found.releases)} among {found.scope}", 600)
    yield from _unknown(found.missing, found.doubts)


def _verdict(verdict: Verdict) -> Iterator[str]:
    step = f"needs {verdict.required}, takes {verdict.declared or 'unknown'}"
    yield one_line(f"{verdict.release}: {verdict.compatibility_class}, {verdict.action.replace('_', ' ')}; {step}")
    for each in verdict.gates:
        yield f"  {each.state:8} {each.gate:14} ({each.level})"
        yield from (one_line(f"    {reason}", 600) for reason in each.reasons)
        if each.waiver is not None:
            yield one_line(f"    {each.waiver.name} answers for it until {each.waiver.ends}: {each.waiver.reason}", 600)
    if verdict.table != gate_table():
        yield "judged by a table of the project (--gates), not by that of the paper"
    went = "goes" if verdict.passed else "does not go"
    yield one_line(f"{verdict.release} {went} from {verdict.inputs.source} to {verdict.inputs.channel}")


def _lock(lock: Lock, *, explain: bool) -> Iterator[str]:
    for each in lock.releases:
        yield f"{each.package}@{each.version}  {each.channel}  {each.contract[:19]}"
        if explain:
            yield f"    for {', '.join(each.by)}"
            passed = (one for one in lock.passed if one.release.partition("@")[0] == each.package)
            yield from (f"    not {one.release}: {one.reason}" for one in passed)
    for out in lock.outside:
        known = "installed" if out.known else "not in the registry, so nothing is known of it"
        if explain or not out.known:
            yield f"{out.package} {out.wanted} for {out.by}: {known}"
    for finding in lock.findings:
        if finding.severity != "info":
            yield f"{finding.severity}: {finding.message} [{finding.rule}]"
