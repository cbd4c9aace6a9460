"""What a result is worth: a grade of evidence for each case, by one method.

A case counts for a method when it speaks of the very conflict at the broken state; the strict grade also asks that it
is quiet at every real state after the repair. Source of the grades: the audit of the record, corpus/README.md.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib import resources

import msgspec
from ecm_checker.finding import DIMENSIONS, Dimension, Finding

from ecm_corpus.interface import Substrate
from ecm_corpus.narrative import Conflict, Grade, Narrative
from ecm_corpus.results import CaseResult, Engine, StateResult, Versions

Counts = Callable[[Engine, Finding], bool]


class Method(msgspec.Struct, frozen=True):
    """One way to judge a state.

    Attributes:
        name: for people.
        counts: whether it has a finding.
        steps: whether a step of versions by itself flags an upgrade.
    """

    name: str
    counts: Counts
    steps: Callable[[Versions], bool] = lambda _: False


class Graded(msgspec.Struct, frozen=True, kw_only=True):
    """One row of the ledger.

    Attributes:
        case, substrate, gold: as in its files. paper: what the paper's checker fired; None when not scored there.
        grade: the evidence grade.
        fired: dimensions of findings about the conflict at the broken states, in the order of the model.
        rules, engines: that gave them.
        alarms: states after the repair with a finding about the conflict.
        controls: how many states after the repair there are.
        hints: findings about the conflict at the broken states that are for information only.
        audit: what is wrong or loose in the record.
    """

    case: str
    substrate: Substrate
    gold: tuple[Dimension, ...]
    paper: tuple[Dimension, ...] | None
    grade: Grade
    fired: tuple[Dimension, ...]
    rules: tuple[str, ...]
    engines: tuple[Engine, ...]
    alarms: tuple[str, ...]
    controls: int
    hints: int
    audit: str

    @property
    def flagged(self) -> bool:
        """Whether anything speaks of the conflict at a broken state."""
        return bool(self.fired)

    @property
    def attributed(self) -> bool:
        """Whether it does so in a dimension that the record names."""
        return not set(self.fired).isdisjoint(self.gold)

    @property
    def strict(self) -> bool:
        """Whether the case counts in the strict score."""
        return self.grade == "discriminating"


def graded(result: CaseResult, narrative: Narrative, method: Method) -> Graded:
    """Grade a case by what one method has at its states."""
    found = [hit for name in narrative.buggy for hit in _hits(result, name, narrative, method)]
    scored = [(engine, finding) for engine, finding in found if finding.severity != "info"]
    stepped = any(_steps(result, name, method) for name in narrative.buggy)
    fired = {finding.dimension for _, finding in scored} | ({"versioning"} if stepped else set())
    alarms = tuple(name for name in narrative.controls if _alarms(result, name, narrative, method))
    return Graded(
        case=result.case,
        substrate=result.substrate,
        gold=narrative.gold,
        paper=narrative.paper_fired,
        grade=_grade(narrative, bool(result.states), bool(fired), bool(alarms)),
        fired=tuple(dimension for dimension in DIMENSIONS if dimension in fired),
        rules=tuple(sorted({finding.rule for _, finding in scored})),
        engines=tuple(sorted({engine for engine, _ in scored})),
        alarms=alarms,
        controls=len(narrative.controls),
        hints=len(found) - len(scored),
        audit=narrative.audit,
    )


def is_about(finding: Finding, conflict: Conflict) -> bool:
    """Whether a finding lies on a file of the conflict and names it."""
    return _lies_on(finding, conflict) and _names(finding, conflict)


def _lies_on(finding: Finding, conflict: Conflict) -> bool:
    paths = [f"/{place.path}" for place in finding.evidence]
    return not conflict.files or any(path.endswith(f"/{file}") for path in paths for file in conflict.files)


def _names(finding: Finding, conflict: Conflict) -> bool:
    """Whether a name of the conflict is one that the finding is about, as a whole word: nobody reads its message."""
    about = finding.about.names if finding.about is not None else ()
    said = "\n".join((*about, *finding.subjects, *_speaks_of().get(finding.rule, ())))
    if not conflict.names or any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", said) for name in conflict.names):
        return True
    return any(f"{place.path}:{place.line}".endswith(line) for place in finding.evidence for line in conflict.lines)


@cache
def _speaks_of() -> Mapping[str, tuple[str, ...]]:
    """What each finding of a rule speaks of beside the names that it is about."""
    text = resources.files("ecm_corpus").joinpath("speaks_of.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), dict[str, tuple[str, ...]])


def _hits(result: CaseResult, name: str, narrative: Narrative, method: Method) -> Iterator[tuple[Engine, Finding]]:
    state = result.states.get(name)
    for engine, findings in (state.findings if state is not None else {}).items():
        for finding in findings:
            if method.counts(engine, finding) and is_about(finding, narrative.conflict):
                yield engine, finding


def _steps(result: CaseResult, name: str, method: Method) -> bool:
    state: StateResult | None = result.states.get(name)
    return state is not None and any(method.steps(versions) for versions in state.versions)


def _alarms(result: CaseResult, name: str, narrative: Narrative, method: Method) -> bool:
    hits = _hits(result, name, narrative, method)
    return any(finding.severity != "info" for _, finding in hits) or _steps(result, name, method)


def _grade(narrative: Narrative, has_states: bool, fired: bool, alarmed: bool) -> Grade:
    if narrative.limit == "not_scorable" or not has_states:
        return "not_scorable"
    if not fired:
        return "out_of_reach" if narrative.limit == "out_of_reach" else "missed"
    if alarmed or not narrative.controls:
        return "trigger"
    return "class" if narrative.limit != "none" else "discriminating"
