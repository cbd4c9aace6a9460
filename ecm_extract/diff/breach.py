"""Whether a line that means what changed is broken by the change, and how surely."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.finding import Certainty
from ecm_checker.hub.provision import Form, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import HEADER, SYMBOL, Consumer
from ecm_checker.match.fit import AGAIN, FORM, NAMES, is_future, misfit

from ecm_extract.diff.broken_names import GONE, BrokenNames
from ecm_extract.diff.effects import placed
from ecm_extract.diff.model import Located
from ecm_extract.diff.overriding import no_longer_overridable


def breach(requirement: Requirement, consumer: Consumer, located: Located, broken: BrokenNames) -> Certainty | None:
    """Return how surely a change breaks a requirement that means what changed; None when it does not.

    Args:
        requirement: of the consumer.
        consumer: the package that requires.
        located: the change.
        broken: all changes, and what the new side provides.
    """
    row, word = requirement.row, located.change.change
    if _names_successor(requirement, located, consumer):
        return None
    if word == "deprecated":
        return requirement.needs if row.warned and _is_warned(requirement, located) else None
    if word in GONE:
        return _lost(requirement, consumer, located, broken) if "gone" in row.breaches else None
    if word == "type_changed" and "type" in row.breaches:
        return _retyped(requirement, located)
    if word == "signature_changed" and "signature" in row.breaches:
        return requirement.needs if _no_longer_fits(requirement, located) else None
    return None


def _is_warned(requirement: Requirement, located: Located) -> bool:
    """Of a method only the form that a line overrides may be deprecated."""
    new, given = located.pair.new, requirement.given
    if requirement.row.fit != FORM or new is None or given is None:
        return True
    return any(form.deprecated and form.types == given.types for form in new.forms)


def _lost(requirement: Requirement, consumer: Consumer, located: Located, broken: BrokenNames) -> Certainty | None:
    old, new = located.pair.old, located.pair.new
    if old is None or _is_other(requirement, located):
        return None
    if old.row.is_placed and new is not None and new.name == old.name:
        return requirement.needs if _is_by_path(requirement, old.path) else None
    if requirement.row.tells == HEADER and new is not None and new.name == requirement.name:
        # another package answers the include now, and must be depended on
        return None if broken.brought.reaches(consumer, new.package) else "likely"
    if requirement.row.tells == SYMBOL and new is not None and new.name == old.name:
        return None  # the include that brought it is what is gone
    for entity in broken.after.named(requirement, consumer):
        if requirement.row.leads and entity.facet != old.facet:
            continue  # a remap leads to a side; who listens does not take the place of who spoke
        known = entity.package == old.package or not entity.is_computed or entity.name == old.name
        if known and misfit(requirement, entity) is None:
            return None
    return requirement.needs


def _is_by_path(requirement: Requirement, path: str) -> bool:
    """Whether a launch file is included from the folder that it lay in."""
    return f"/{requirement.target}".endswith(f"/{placed(path)}")


def _names_successor(requirement: Requirement, located: Located, consumer: Consumer) -> bool:
    """Whether a C++ file has the new name as well: it chooses by a condition."""
    new, path = located.change.new, requirement.evidence[0].path
    if new is None or new == requirement.name:
        return False
    if requirement.row.tells == HEADER:
        return new in consumer.headers_of(path)
    return requirement.row.tells == SYMBOL and any(
        name == new or name.startswith(f"{new}::") for name in consumer.symbols_of(path)
    )


def _is_other(requirement: Requirement, located: Located) -> bool:
    """Whether it is another topic of that name: a message that moved to another package keeps its own name."""
    old = located.pair.old
    if old is None or not old.is_endpoint or None in (requirement.type, old.type):
        return False
    return (requirement.type or "").rpartition("/")[2] != (old.type or "").rpartition("/")[2]


def _retyped(requirement: Requirement, located: Located) -> Certainty | None:
    old, new = located.pair.old, located.pair.new
    if old is None or new is None:
        return None
    if old.row.wire and old.row.part:
        return "likely"
    if old.row.symbol:
        inside = requirement.given is not None and requirement.given.inside
        return "likely" if inside else None  # who only names it may do with another type
    was_right = requirement.type is not None and requirement.type == old.type
    return requirement.needs if was_right and misfit(requirement, new) == "type" else None


def _no_longer_fits(requirement: Requirement, located: Located) -> bool:
    old, new = located.pair.old, located.pair.new
    if old is None or new is None:
        return False
    if requirement.row.fit == AGAIN:
        return _is_no_longer_shared(old.forms, new.forms)
    if requirement.row.fit == NAMES and requirement.given is not None:
        # `**kwargs` may hand it on to what refuses it, so a name that was told and is not any more is lost
        return not _told(old.forms).intersection(requirement.given.names) <= _told(new.forms)
    if requirement.row.fit == FORM and requirement.given is not None:
        closed = {form.types for form in no_longer_overridable(old, new)}
        return requirement.given.types in closed or _is_refused(requirement, old, new)
    return _is_refused(requirement, old, new)


def _is_refused(requirement: Requirement, old: Provision, new: Provision) -> bool:
    return misfit(requirement, old) is None and misfit(requirement, new) is not None


def _told(forms: Iterable[Form]) -> frozenset[str]:
    """Names of parameters that a function tells."""
    return frozenset(name for form in forms for name in form.names if not name.startswith("*"))


def _is_no_longer_shared(old: Iterable[Form], new: Iterable[Form]) -> bool:
    """Whether a form keeps its parameters and gives a future that is no longer shared."""
    before = {form.types: form.returns for form in old}
    return any(is_future(before.get(form.types, ""), True) and is_future(form.returns, False) for form in new)
