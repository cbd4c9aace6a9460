"""What was seen against what contracts promise."""

from __future__ import annotations

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.outcome import ordered

from ecm_extract.observe.catalogue import catalogue
from ecm_extract.observe.watch import Watch


def compare(watch: Watch) -> tuple[Finding, ...]:
    """Return what every rule says, most severe first; the order does not depend on that of the observation."""
    found = (finding for entry in catalogue() for finding in entry.check(watch))
    return ordered(_doubted(watch, finding) for finding in found)


def _doubted(watch: Watch, finding: Finding) -> Finding:
    """What is said of a contract is not proved where the node may be an instance of another one."""
    others = sorted({other for subject in finding.subjects for other in watch.rivals.get(subject, ())})
    if not others:
        return finding
    severity = "warning" if finding.severity == "error" else finding.severity
    certainty = "likely" if finding.certainty == "proved" else finding.certainty
    message = f"{finding.message} (unless what was seen is of {', '.join(others)})"
    return msgspec.structs.replace(finding, severity=severity, certainty=certainty, message=message)
