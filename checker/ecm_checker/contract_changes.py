"""Changes between two contracts of one module, in the form that `diff` and the release rules share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from ecm_checker.contract import Contract
from ecm_checker.delta import gained, lost
from ecm_checker.finding import Dimension
from ecm_checker.grants import asked
from ecm_checker.hub.roles import roles
from ecm_checker.release import Change, ChangeWord
from ecm_checker.view import View

# Fields of which any change may invalidate what was built on the old version.
_SETTLED: Final[Mapping[Dimension, tuple[str, ...]]] = {
    "behavior": ("preconditions", "postconditions", "completion_semantics", "rates"),
    "recovery": ("failure_modes", "rollback_state", "retry", "safe_stop", "escalation"),
}
_GROWING: Final = ("sensors", "actuators", "compute", "timing", "exclusive_locks")


def changes(old: View, new: View) -> tuple[Change, ...]:
    """What changed in the contract of a module."""
    return (*_signature(old, new), *_settled(old, new), *_resources(old, new), *_permissions(old, new))


def _signature(old: View, new: View) -> Iterator[Change]:
    for each in lost(old, new):
        word: ChangeWord = "type_changed" if each.old and each.new else "removed" if each.old else "added"
        name = each.old or None
        after = None if word == "removed" else each.old or each.new
        sure = "{" not in each.old
        yield _change(new, _kind(each.kind), word, (name, after), sure, "signature")
    for kind, name in gained(old, new):
        yield _change(new, _kind(kind), "added", (None, name), False, "signature")


def _kind(told: str) -> str:
    """The kind of name that an endpoint is to others; an input or output is itself."""
    return next((row.provides for role, row in roles().items() if role == told and row.provides), told)


def _settled(old: View, new: View) -> Iterator[Change]:
    for dimension, names in _SETTLED.items():
        for name in names:
            before, now = _value(old.contract, dimension, name), _value(new.contract, dimension, name)
            if before != now:
                yield _field(new, dimension, name, before is not None)


def _resources(old: View, new: View) -> Iterator[Change]:
    for name in _GROWING:
        before, now = _value(old.contract, "resources", name), _value(new.contract, "resources", name)
        if before != now:
            yield _field(new, "resources", name, now is None or _grew(old, new, name))


def _grew(old: View, new: View, name: str) -> bool:
    before, now = getattr(old, _VIEW_NAMES.get(name, name)), getattr(new, _VIEW_NAMES.get(name, name))
    if isinstance(now, tuple):
        return before is None or not set(now) <= set(before)
    return before is None or any(item and before.get(key) != item for key, item in (now or {}).items())


_VIEW_NAMES: Final = {"exclusive_locks": "locks"}


def _permissions(old: View, new: View) -> Iterator[Change]:
    before, now = asked(old), asked(new)
    for key in sorted(before.keys() | now.keys()):
        if before.get(key) != now.get(key):
            yield _field(new, "permissions", key[1], key in now)


def _value(contract: Contract, dimension: Dimension, name: str) -> object:
    value = getattr(getattr(contract, dimension), name)
    return None if value is None else value.value


def _field(new: View, dimension: Dimension, name: str, breaking: bool) -> Change:
    path = f"{dimension}.{name}"
    return _change(new, "field", "signature_changed", (path, path), breaking, dimension)


def _change(
    new: View,
    kind: str,
    word: ChangeWord,
    names: tuple[str | None, str | None],
    breaking: bool,
    dimension: Dimension,
) -> Change:
    return Change(
        kind=kind,
        change=word,
        package=new.package,
        owner=new.id,
        old=names[0],
        new=names[1],
        breaking=breaking,
        dimension=dimension,
    )
