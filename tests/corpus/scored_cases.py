"""Hand-made results and narratives: one case for each grade."""

from __future__ import annotations

from ecm_checker.contract import Evidence
from ecm_checker.finding import Dimension, Entity, Finding, Severity
from ecm_corpus.narrative import Conflict, Limit, Narrative
from ecm_corpus.results import SCHEMA, CaseResult, Engine, Results, StateResult, Versions

CONFLICT = Conflict(files=("scripts/reader.py",), names=("/gps/fix",))


def finding(
    rule: str = "VER001",
    dimension: Dimension = "versioning",
    severity: Severity = "error",
    about: str = "/gps/fix",
    path: str = "pkg/scripts/reader.py",
) -> Finding:
    return Finding(
        rule=rule,
        name="name",
        dimension=dimension,
        severity=severity,
        message=f"topic {about} is gone",
        resolution="",
        subjects=("ecm.pkg",),
        evidence=(Evidence(path, 7),),
        fingerprint="0" * 16,
        who="graph",
        certainty="proved",
        about=Entity("topic", about),
    )


def state(*findings: Finding, engine: Engine = "diff", versions: tuple[Versions, ...] = ()) -> StateResult:
    return StateResult(
        question="upgrade" if engine == "diff" else "composition",
        commits={},
        documents={},
        versions=versions,
        findings={engine: findings},
    )


def case(name: str, substrate: str = "robust", **states: StateResult) -> CaseResult:
    return CaseResult(
        case=name,
        substrate=substrate,
        input="",
        output="",
        previous="",
        hash="",
        states=states,  # type: ignore[arg-type]
    )


def narrative(
    name: str, limit: Limit = "none", gold: tuple[Dimension, ...] = ("versioning",), **kept: object
) -> Narrative:
    return Narrative(
        case=name,
        title="a title",
        story="a story",
        gold=gold,
        source="somewhere",
        derivable="yes",
        paper_fired=(),
        buggy=kept.get("buggy", ("a",)),  # type: ignore[arg-type]
        controls=kept.get("controls", ("b",)),  # type: ignore[arg-type]
        conflict=CONFLICT,
        limit=limit,
        audit=str(kept.get("audit", "")),
    )


def results(*cases: CaseResult) -> Results:
    return Results(schema=SCHEMA, version="0", extractor="e" * 64, checker="c" * 64, cases=cases)


def small_corpus() -> tuple[Results, dict[str, Narrative]]:
    """Two wins, one by the checker and one by lint, a trigger, a miss, one of another dimension, one without text."""
    qos = finding("BEH001", "behavior")
    lint = finding("LNT007", "signature", "error", "topic /gps/fix has two types")
    cases = (
        case("B-win", "ros2", a=state(qos, engine="check"), b=state(engine="check")),
        case("R-hint", a=state(finding(severity="info")), b=state()),
        case("R-lint", a=state(lint, engine="lint"), b=state(engine="lint")),
        case("R-lost"),
        case("R-other", a=state(finding(dimension="behavior")), b=state()),
        case("R-trigger", a=state(finding()), b=state(finding())),
        case("R-win", a=state(finding(), versions=(Versions("pkg", "1.2.0", "2.0.0"),)), b=state()),
    )
    told = (
        narrative("B-win", gold=("behavior",)),
        narrative("R-hint"),
        narrative("R-lint", gold=("signature", "versioning")),
        narrative("R-lost", "not_scorable", audit="nobody has the text"),
        narrative("R-other"),
        narrative("R-trigger"),
        narrative("R-win"),
    )
    return results(*cases), {entry.case: entry for entry in told}
