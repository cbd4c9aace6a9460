"""An observation and what it says of contracts, as one document and as a summary for people."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any, Final, Literal

from ecm_checker.finding import Finding
from ecm_checker.json_data import record_data

from ecm_extract.observe.evidence import digest
from ecm_extract.observe.model import Observation
from ecm_extract.observe.watch import Watch
from ecm_extract.report.findings.data import finding_data
from ecm_extract.report.terminal import one_line

SCHEMA: Final = "ecm-extract/observe/1"
Verdict = Literal["as_promised", "as_far_as_seen", "differs", "not_all_seen", "nothing_promised", "nothing_there"]

_MOST_NAMES: Final = 8


def verdict(watch: Watch, findings: Sequence[Finding]) -> Verdict:
    """What the whole run says.

    `as_promised` only where everything was read, every contract was seen, and the source can see all that they promise;
    `as_far_as_seen` where only the last of these is missing.
    """
    if any(each.severity != "info" and each.rule != "OBS020" for each in findings):
        return "differs"
    if watch.seen.gaps or (watch.modules and _unseen(watch)):
        return "not_all_seen"
    if watch.is_empty:
        return "nothing_there"
    if not watch.modules:
        return "nothing_promised"
    return "as_far_as_seen" if watch.invisible else "as_promised"


def report_json(watch: Watch, findings: Sequence[Finding]) -> str:
    """One JSON document, schema `ecm-extract/observe/1`."""
    data: dict[str, Any] = {
        "schema": SCHEMA,
        "verdict": verdict(watch, findings),
        "modules": [{"module_id": each.module.id, "node": each.node} for each in watch.present],
        "not_seen": _unseen(watch),
        "cannot_be_seen": watch.invisible,
        "findings": [finding_data(each) for each in findings],
        "observation": {**record_data(watch.seen), "digest": digest(watch.seen)},
    }
    return json.dumps(data, indent=1) + "\n"


def summary_text(watch: Watch, findings: Sequence[Finding]) -> str:
    """What was seen, which modules were, what was not, and the verdict."""
    return "".join(f"{one_line(line, 400)}\n" for line in _lines(watch, findings))


def counted(seen: Observation) -> str:
    """How much was seen, in one line."""
    messages = sum(stream.count for stream in seen.streams)
    parts = (
        (len(seen.nodes), "nodes"),
        (len(seen.endpoints), "endpoints"),
        (len(seen.parameters), "parameters"),
        (messages, "messages"),
        (len(seen.transforms), "transforms"),
    )
    return ", ".join(f"{count} {word}" for count, word in parts)


def _lines(watch: Watch, findings: Sequence[Finding]) -> Iterator[str]:
    seen = watch.seen
    yield f"{seen.source} {seen.target}: {counted(seen)} in {seen.seconds:.1f} s"
    if watch.contracts:
        yield f"  contracts: {len(watch.modules)} modules, {len(watch.present)} of them seen"
    unseen = _unseen(watch)
    if unseen:
        yield f"  not seen: {', '.join(unseen[:_MOST_NAMES])}{' ...' if len(unseen) > _MOST_NAMES else ''}"
    for node, modules in watch.modules_of.items():
        if len(modules) > 1:
            yield f"  {node} may be an instance of {' or '.join(each.id for each in modules)}"
    if watch.invisible:
        kinds = ", ".join(f"{count} {kind.replace('_', ' ')}" for kind, count in sorted(watch.invisible.items()))
        yield f"  promised, and not to be seen this way: {kinds}"
    for gap in seen.gaps:
        yield f"  not read: {gap.what}: {gap.why}"
    counts = Counter(each.severity for each in findings)
    told = ", ".join(f"{count} {severity}" for severity, count in sorted(counts.items())) or "nothing found"
    yield f"  {told}; {verdict(watch, findings).replace('_', ' ')}"


def _unseen(watch: Watch) -> list[str]:
    present = {each.module.id for each in watch.present}
    return [module.id for module in watch.modules if module.id not in present]
