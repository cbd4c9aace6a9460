"""The tier of each lint rule is the one that the judged rows give it."""

from __future__ import annotations

from lint_precision import Record, Repository, Row, Sample, records, samples

from ecm_extract.lint.catalogue import catalogue

BY_COMPARISON = {"LNT019", "LNT030"}
"""What `lint --base` takes from diff, on request; their rows are those of benchmarks/diff_precision."""
OF_OVERLAYS = {"LNT018", "LNT070"}
"""What a person wrote in an ecm.yaml, for this tool alone: no public repository has one to judge."""


def row(verdict: str, *, shaped: bool = False) -> Row:
    return Row("LNT001", "error", "a.launch", 1, verdict, "read", shaped)  # type: ignore[arg-type]


def sample(*repositories: tuple[Row, ...]) -> Sample:
    return Sample("", tuple(Repository(f"a/{at}", "0", rows) for at, rows in enumerate(repositories)))


def test_every_rule_has_the_tier_that_it_earned() -> None:
    """Neither is a rule on by default that nobody has judged, nor one held back that has shown what it is worth."""
    earned = records(samples())
    tiers = {
        entry.rule.id: entry.rule.tier for entry in catalogue() if entry.rule.id not in BY_COMPARISON | OF_OVERLAYS
    }
    expected = {rule: earned[rule].tier if rule in earned else "preview" for rule in tiers}
    assert tiers == expected


def test_rows_name_rules_and_places() -> None:
    """A row can be read again."""
    known = {entry.rule.id for entry in catalogue()}
    for found in samples():
        names = [repository.repository for repository in found.repositories]
        assert len(names) == len(set(names))
        for repository in found.repositories:
            assert all(each.rule in known and each.path and each.why for each in repository.rows)


def test_ten_repositories_make_a_rule_stable() -> None:
    """Nine do not, and many findings of one repository are one repository."""
    assert records([sample(*[(row("wanted"),)] * 10)])["LNT001"].tier == "stable"
    assert records([sample(*[(row("wanted"),) * 9] * 9)])["LNT001"].tier == "preview"


def test_noise_counts_as_much_as_a_false_one() -> None:
    """One of ten is below 95 of 100."""
    for verdict in ("noise", "false"):
        one = [(row("wanted"),)] * 9 + [(row(verdict),)]
        assert records([sample(*one)])["LNT001"].tier == "preview"


def test_what_shaped_a_rule_does_not_count_for_it() -> None:
    """Neither against it, since it was mended, nor for it."""
    shaped = (row("wanted"), row("false", shaped=True))
    found = records([sample(shaped, *[(row("wanted"),)] * 9)])["LNT001"]
    assert found == Record(frozenset(f"a/{at}" for at in range(1, 10)), 9, 9)
