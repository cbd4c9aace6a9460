"""The migration of a release, for programs."""

from __future__ import annotations

import pytest
from ecm_checker.release import Change

from ecm_extract.diff.migration import Adapter, Edit, Step, migration_of, uncovered


def _change(kind: str, old: str | None, new: str | None, breaking: bool = True) -> Change:
    word = "renamed" if old and new else "removed" if old else "added"
    return Change(
        kind=kind,
        change=word,  # type: ignore[arg-type]
        package="driver",
        owner="drive",
        old=old,
        new=new,
        breaking=breaking,
        dimension="versioning",
    )


def _step(change: Change) -> Step:
    return migration_of("1", "2", [change]).steps[0]


@pytest.mark.parametrize(
    ("kind", "adapter"),
    [
        ("topic", Adapter("remap", "a", "b")),
        ("service", Adapter("remap", "a", "b")),
        ("parameter", Adapter("copy_parameter", "a", "b")),
        ("plugin", None),
    ],
)
def test_an_adapter_where_something_stands_for_the_old_name(kind: str, adapter: Adapter | None) -> None:
    """A remap, a copied parameter, or nothing."""
    assert _step(_change(kind, "a", "b")).adapter == adapter
    assert _step(_change(kind, "a", None)).adapter is None


def test_what_to_write_in_each_language() -> None:
    """A message is included and imported by names that a build makes of it."""
    edits = _step(_change("message", "a_msgs/msg/OldState", "b_msgs/msg/NewState")).edits
    assert Edit("cpp", "a_msgs/msg/old_state.hpp", "b_msgs/msg/new_state.hpp") in edits
    assert Edit("python", "a_msgs.msg.OldState", "b_msgs.msg.NewState") in edits
    assert Edit("yaml", "a", "b") in _step(_change("parameter", "a", "b")).edits


def test_what_breaks_nobody_is_no_step() -> None:
    """A migration tells what must be done."""
    assert migration_of("1", "2", [_change("topic", None, "b", breaking=False)]).steps == ()


def test_a_migration_covers_or_does_not() -> None:
    """Each breaking change must have its step."""
    told, untold = _change("topic", "a", "b"), _change("topic", "c", None)
    assert list(uncovered(migration_of("1", "2", [told]), [told, untold])) == [untold]
