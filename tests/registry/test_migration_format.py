"""The migration of a release, for programs."""

from __future__ import annotations

import msgspec
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


def _all(*changes: Change) -> list[Adapter | None]:
    return [each.adapter for each in migration_of("1", "2", changes).steps]


RENAMED = _change("topic", "/a", "/b")
RETYPED = msgspec.structs.replace(RENAMED, change="type_changed", old_value="x/msg/A", new_value="x/msg/B")


@pytest.mark.parametrize(
    "changes",
    [
        pytest.param([RENAMED, RETYPED], id="another type"),
        pytest.param([RENAMED, msgspec.structs.replace(RETYPED, kind="qos")], id="another QoS"),
        pytest.param([_change("topic", "/{name}/a", "/{name}/b")], id="a pattern"),
        pytest.param([msgspec.structs.replace(RENAMED, change="moved")], id="moved to another node"),
        pytest.param([_change("topic", "/a", None)], id="gone"),
    ],
)
def test_no_adapter_where_none_would_do(changes: list[Change]) -> None:
    """A remap leads to another name, and changes nothing else."""
    assert set(_all(*changes)) == {None}


def test_a_step_tells_of_one_change() -> None:
    """That a topic has another name says nothing of its new type, for which no remap stands."""
    assert list(uncovered(migration_of("1", "2", [RENAMED]), [RENAMED, RETYPED])) == [RENAMED, RETYPED]


@pytest.mark.parametrize(
    ("adapter", "covers"),
    [
        (None, True),
        (Adapter("remap", "/a", "/b"), True),
        (Adapter("remap", "/a", "/c"), False),
        (Adapter("remap", "/b", "/a"), False),
        (Adapter("copy_parameter", "/a", "/b"), False),
    ],
)
def test_an_adapter_must_cover_the_break(adapter: Adapter | None, covers: bool) -> None:
    """A person may write it, or leave it out; one that stands for something else is refused."""
    written = migration_of("1", "2", [RENAMED])
    steps = tuple(msgspec.structs.replace(each, adapter=adapter) for each in written.steps)
    left = list(uncovered(msgspec.structs.replace(written, steps=steps), [RENAMED]))
    assert left == ([] if covers else [RENAMED])


def test_a_step_that_says_nothing_covers_nothing() -> None:
    """Blank words are none."""
    written = migration_of("1", "2", [RENAMED])
    steps = tuple(msgspec.structs.replace(each, instead="  ") for each in written.steps)
    assert list(uncovered(msgspec.structs.replace(written, steps=steps), [RENAMED])) == [RENAMED]
