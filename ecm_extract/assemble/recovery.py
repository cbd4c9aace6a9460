"""Recovery: results that mean failure, retries, watchdogs, lifecycle fallback, who is told."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ecm_checker.contract import Evidence, Interface, Recovery, Value
from ecm_checker.hub.roles import roles, served_roles
from ecm_parsers.behavior_tree import retries
from ecm_parsers.numbers import truncated

from ecm_extract.assemble.definitions import Definitions
from ecm_extract.assemble.evidence import inferred, is_watchdog, number_of, of_interfaces, parameters_where
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts

_RETRY = re.compile(
    r"(?:^|_)(?:max_)?(?:retry|retries|num_retries|number_of_retries|attempts|max_attempts|failure_count)$"
)
_TREE = re.compile(r"bt_xml|behavior_tree|behaviour_tree|bt_filename|tree_file")
_NO_FAILURE = frozenset({"NONE", "SUCCESS", "SUCCEEDED", "OK", "SUCCESSFUL", "NO_ERROR"})
_FORMAT = re.compile(r"%[-+ #0-9.]*[a-zA-Z]|\{[^}]*\}")
_NO_WORD = re.compile(r"[^a-z0-9]+")
MAX_MODE = 60
UNGRADED = "unknown"
_FIRST_ALARM = "/diagnostics"
_ALARMS = frozenset({_FIRST_ALARM, "/diagnostics_agg", "/diagnostics_toplevel_state"})


def recovery_of(entry: LinkedModule, facts: PackageFacts, definitions: Definitions) -> Recovery:
    """Return the recovery section of a module."""
    return Recovery(
        failure_modes=_failures(entry, definitions),
        rollback_state=_rollback(entry),
        retry=_retry(entry.interfaces) or _retry_of_trees(entry.interfaces, facts),
        safe_stop=_safe_stop(entry.interfaces),
        escalation=_escalation(entry, facts),
    )


def _failures(module: LinkedModule, definitions: Definitions) -> Value | None:
    """What diagnostics report, with its level; constants of results of actions that are served have none."""
    lines = [told.evidence for told in module.diagnoses if _mode(told.message)]
    graded = {_mode(told.message): told.level for told in reversed(module.diagnoses) if _mode(told.message)}
    named: dict[str, None] = {}
    for entry in module.interfaces:
        if entry.role not in served_roles() or entry.type is None:
            continue
        part = roles()[entry.role].gives
        for name, line in definitions.constants(entry.type, part):
            if name not in _NO_FAILURE:
                named.setdefault(name.lower())
                lines.append(line)
    return inferred({**dict.fromkeys(named, UNGRADED), **graded} if graded else list(named), lines)


def _mode(message: str) -> str:
    """A message as a name: `Frequency too low.` -> `frequency_too_low`."""
    words = _NO_WORD.sub("_", _FORMAT.sub(" ", message).lower()).strip("_")
    return words[:MAX_MODE].rstrip("_")


def _rollback(entry: LinkedModule) -> Value | None:
    """A lifecycle node goes back to inactive when it is deactivated, and when activation fails."""
    place = Evidence(entry.module.path, entry.module.line)
    return inferred("inactive", [place]) if entry.lifecycle else None


def _retry(interfaces: Iterable[Interface]) -> Value | None:
    for entry in parameters_where(interfaces, lambda name: _RETRY.search(name) is not None):
        number = number_of(entry)
        most = truncated(number) if number is not None else None
        if most is not None:
            return inferred({"max": most, "parameter": entry.name}, entry.evidence[:1], "default")
    return None


def _retry_of_trees(interfaces: Iterable[Interface], facts: PackageFacts) -> Value | None:
    """A module that is given behaviour trees tries again as the trees of its package do: at most so often."""
    if not parameters_where(interfaces, lambda name: _TREE.search(name) is not None):
        return None
    found = [(path, node, count) for path, file in facts.trees.items() for node, count in retries(file)]
    lines = [Evidence(path, node.line) for path, node, _ in found]
    most = max((count for _, _, count in found), default=0)
    return inferred({"max": most, "strategy": "behavior_tree"} if most > 0 else None, lines)


def _safe_stop(interfaces: Iterable[Interface]) -> Value | None:
    """A module that stops by itself when commands cease has a parameter for how long it waits."""
    found = parameters_where(interfaces, is_watchdog)
    return of_interfaces([f"stop after {entry.name}" for entry in found], found)


def _escalation(module: LinkedModule, facts: PackageFacts) -> Value | None:
    """Who publishes or fills diagnostics tells of failures; an aggregator of the package passes them on."""
    found = [entry for entry in module.interfaces if entry.row.writes and entry.name in _ALARMS]
    lines = [entry.evidence[0] for entry in found] or [told.evidence for told in module.diagnoses[:1]]
    names = sorted({entry.name for entry in found}) or [_FIRST_ALARM][: len(lines)]
    steps = [f"failure -> {name}" for name in names]
    for path, file in facts.aggregators.items() if steps else ():
        for aggregator in file.aggregators:
            steps.append(f"stale -> {aggregator.base_path or '/diagnostics_agg'}")
            lines.append(Evidence(path, aggregator.line))
    return inferred(list(dict.fromkeys(steps)), lines)
