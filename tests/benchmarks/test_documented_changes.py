"""A documented change is found by its kind, name and word; the same name with another word is told apart."""

from __future__ import annotations

from pathlib import Path

import pytest
from comparisons import Change
from documented_changes import Row, load, same_name, verdict

FOLDER = Path(__file__).parents[2] / "benchmarks" / "diff_recall"


def _change(word: str, old: str | None, new: str | None, kind: str = "parameter") -> Change:
    return Change(kind, word, "pkg", "node", old, new, breaking=True)


@pytest.mark.parametrize(
    ("documented", "told", "expected"),
    [
        ("rate", "<*>.rate", True),
        ("<stream>_width", "depth_width", True),
        ("depth_width", "<*>_width", True),
        ("~/cmd_vel", "/cmd_vel", True),
        ("rate", "frame_rate", False),
        ("rate", "<*>", False),
        ("a::B", "owner: a::B", True),
    ],
)
def test_names_are_compared_below_any_namespace(documented: str, told: str, expected: bool) -> None:
    """A guide names a parameter without its prefix and leaves parts of names open."""
    assert same_name(documented, told) is expected


def test_removed_and_added_is_not_a_documented_rename() -> None:
    """What a guide calls a rename must be told as one change."""
    row = Row("parameter", "renamed", 1, old="a", new="b")
    assert verdict(row, (_change("renamed", "a", "b"),)) == "found"
    assert verdict(row, (_change("removed", "a", None), _change("added", None, "b"))) == "wrong change"
    assert verdict(row, (_change("renamed", "a", "c"),)) == "wrong change"
    assert verdict(row, (_change("renamed", "a", "b", "topic"),)) == "missed"


def test_a_replacement_is_found_when_the_old_name_goes() -> None:
    """What takes over the work of a name need not be alike."""
    row = Row("parameter", "replaced", 1, old="a", new="b")
    assert verdict(row, (_change("removed", "a", None),)) == "found"
    assert verdict(row, (_change("default_changed", "a", "a"),)) == "wrong change"


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.yaml")), ids=lambda path: path.stem)
def test_every_file_is_well_formed(path: Path) -> None:
    """A row that is not an addition names what there was, and has the line that says so."""
    for guide in load(path).comparisons:
        assert "@" in guide.guide
        for row in guide.rows:
            assert row.old or row.change == "added"
            assert row.line > 0
