"""Which requirements of consumers were met before a change and are not after it (paper, "Release Discipline")."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ecm_checker.finding import Certainty
from ecm_checker.hub.kinds import UseKind, uses
from ecm_checker.hub.provision import Form
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import misfit
from ecm_checker.match.names import is_of_program
from ecm_checker.match.spelling import graph_name_matches

from ecm_extract.diff.broken_names import GONE, BrokenNames
from ecm_extract.diff.effects import placed
from ecm_extract.diff.model import Located
from ecm_extract.diff.use import Use

_IN_GRAPH: Final = frozenset({"subscribes", "publishes", "calls_service", "calls_action"})
_ENDPOINTS: Final = frozenset({"topic", "service", "action"})
_FUTURE: Final = re.compile(r"future", re.IGNORECASE)
_SHARED: Final = re.compile(r"shared", re.IGNORECASE)


def uses_of(consumers: Sequence[Consumer], broken: BrokenNames, commit: str | None, own: bool = False) -> Iterator[Use]:
    """Yield the lines of consumers that changes break, each once for a change.

    Args:
        consumers: packages of one tree or document.
        broken: the changes.
        commit: that the consumers were read at.
        own: whether they are the new side itself, which builds: only names that are gone count there.
    """
    if broken.is_empty():
        return
    remaps = _of_use("remaps", consumers)
    named = frozenset(entry.name for entry in _of_use("names_node", consumers))
    seen: set[tuple[str, str | None, str, int]] = set()
    for consumer in consumers:
        for requirement in consumer.requirements:
            for located, certainty, what in _broken(requirement, consumer, broken):
                if (own and not _is_forgotten(requirement, located)) or _is_answered(requirement, located):
                    continue
                if requirement.kind == "node" and requirement.name in named:
                    continue  # a launch file gives the name, whatever the program calls itself
                if _is_led_elsewhere(requirement, consumer.package, remaps):
                    continue
                alive = _is_kept_alive(located, remaps)
                for at in requirement.evidence:
                    mark = (requirement.use, located.change.old or located.change.new, at.path, at.line)
                    if mark not in seen:
                        seen.add(mark)
                        yield Use(located, consumer.package, requirement, at, commit, what, certainty, alive)


def _of_use(use: str, consumers: Sequence[Consumer]) -> list[Requirement]:
    return [entry for consumer in consumers for entry in consumer.requirements if entry.use == use]


def _is_led_elsewhere(requirement: Requirement, package: str, remaps: Sequence[Requirement]) -> bool:
    """Whether a launch file connects the name that a program uses: then the remap is what breaks, or nothing."""
    if requirement.use not in _IN_GRAPH:
        return False
    return any(each.package == package and _is_own(each.name, requirement.name) for each in remaps)


def _is_own(remapped: str, used: str) -> bool:
    """Whether a remap is of a name that its program uses; a private one may be told below the name of the node."""
    private = remapped.startswith("~") and graph_name_matches(remapped, used)
    return private or _bare(remapped) == _bare(used)


def _bare(name: str) -> str:
    return name.lstrip("~/")


def _broken(
    requirement: Requirement, consumer: Consumer, broken: BrokenNames
) -> Iterator[tuple[Located, Certainty, str]]:
    if requirement.certainty == "unknown":
        return
    row = uses()[requirement.use]
    if "layout" in row.breaches:
        found = broken.layout_of(requirement.name)
        if found is not None:
            yield found, requirement.certainty, requirement.phrase
        return
    for located in broken.meant(requirement, consumer):
        entity = located.pair.old
        if entity is None or (row.built and entity.package == consumer.package):
            continue
        certainty = _breach(requirement, row, located, consumer, broken)
        if certainty is not None:
            yield located, *_told_of(requirement, entity.package, certainty, entity.kind == "package")
    if "duty" in row.breaches:
        yield from _duties(requirement, broken)


def _told_of(
    requirement: Requirement, package: str, certainty: Certainty, is_package: bool = False
) -> tuple[Certainty, str]:
    """How surely a line breaks, and what it does; a remap of the changed program itself names the changed name.

    What went with a whole package may have gone to another repository.
    """
    if is_package and requirement.kind != "package":
        return "likely", requirement.phrase
    if requirement.use == "remaps" and is_of_program(requirement, package):
        return "proved", f"remaps {requirement.name}"
    return certainty, requirement.phrase


def _duties(requirement: Requirement, broken: BrokenNames) -> Iterator[tuple[Located, Certainty, str]]:
    given = requirement.given
    for located in broken.duties_of(requirement.package, requirement.name):
        new = located.pair.new
        if new is not None and (given is None or new.name not in given.names):
            forwarded = given is not None and given.forwarded
            what = f"includes {requirement.name} without {new.name}"
            yield located, "likely" if forwarded else "proved", what


def _breach(
    requirement: Requirement, row: UseKind, located: Located, consumer: Consumer, broken: BrokenNames
) -> Certainty | None:
    """Return how surely a change breaks a requirement that means what changed; None when it does not."""
    word = located.change.change
    if _names_successor(requirement, located, consumer):
        return None
    if word == "deprecated":
        return requirement.certainty if row.warned and _is_warned(requirement, located) else None
    if word in GONE:
        return _lost(requirement, located, consumer, broken) if "gone" in row.breaches else None
    if word == "type_changed" and "type" in row.breaches:
        return _retyped(requirement, located)
    if word == "signature_changed" and "signature" in row.breaches:
        return requirement.certainty if _no_longer_fits(requirement, located) else None
    return None


def _is_warned(requirement: Requirement, located: Located) -> bool:
    """Of a method only the form that a line overrides may be deprecated."""
    new, given = located.pair.new, requirement.given
    if requirement.use != "overrides" or new is None or given is None:
        return True
    return any(form.deprecated and form.types == given.types for form in new.forms)


def _lost(requirement: Requirement, located: Located, consumer: Consumer, broken: BrokenNames) -> Certainty | None:
    old, new = located.pair.old, located.pair.new
    if old is None or _is_other(requirement, located):
        return None
    if old.kind == "launch_file" and new is not None and new.name == old.name:
        return requirement.certainty if _is_by_path(requirement, old.path) else None
    if requirement.use == "includes" and new is not None and new.name == requirement.name:
        return "likely"  # another package answers the include now, and must be depended on
    if requirement.use == "names_symbol" and new is not None and new.name == old.name:
        return None  # the include that brought it is what is gone
    for entity in broken.after.named(requirement, consumer):
        if requirement.use == "remaps" and entity.facet != old.facet:
            continue  # a remap leads to a side; who listens does not take the place of who spoke
        known = entity.package == old.package or not entity.is_computed or entity.name == old.name
        if known and misfit(requirement, entity) is None:
            return None
    return requirement.certainty


def _is_by_path(requirement: Requirement, path: str) -> bool:
    """Whether a launch file is included from the folder that it lay in."""
    return f"/{requirement.said}".endswith(f"/{placed(path)}")


def _names_successor(requirement: Requirement, located: Located, consumer: Consumer) -> bool:
    """Whether a C++ file has the new name as well: it chooses by a condition."""
    new, path = located.change.new, requirement.evidence[0].path
    if new is None or new == requirement.name:
        return False
    if requirement.use == "includes":
        return new in consumer.headers_of(path)
    return requirement.use == "names_symbol" and any(
        name == new or name.startswith(f"{new}::") for name in consumer.symbols_of(path)
    )


def _is_other(requirement: Requirement, located: Located) -> bool:
    """Whether it is another topic of that name: a message that moved to another package keeps its own name."""
    old = located.pair.old
    if old is None or old.kind not in _ENDPOINTS or None in (requirement.type, old.type):
        return False
    return (requirement.type or "").rpartition("/")[2] != (old.type or "").rpartition("/")[2]


def _retyped(requirement: Requirement, located: Located) -> Certainty | None:
    old, new = located.pair.old, located.pair.new
    if old is None or new is None:
        return None
    if old.kind in {"message_field", "constant"}:
        return "likely"
    if old.kind == "member":
        return "likely" if requirement.said else None  # who only names it may do with another type
    was_right = requirement.type is not None and requirement.type == old.type
    return requirement.certainty if was_right and misfit(requirement, new) == "type" else None


def _no_longer_fits(requirement: Requirement, located: Located) -> bool:
    old, new = located.pair.old, located.pair.new
    if old is None or new is None:
        return False
    if requirement.use == "takes_again":
        return _is_no_longer_shared(old.forms, new.forms)
    if requirement.use == "gives_keyword" and requirement.given is not None:
        # `**kwargs` may hand it on to what refuses it, so a name that was told and is not any more is lost
        return not _told(old.forms).intersection(requirement.given.names) <= _told(new.forms)
    return misfit(requirement, old) is None and misfit(requirement, new) is not None


def _told(forms: Iterable[Form]) -> frozenset[str]:
    """Names of parameters that a function tells."""
    return frozenset(name for form in forms for name in form.names if not name.startswith("*"))


def _is_no_longer_shared(old: Iterable[Form], new: Iterable[Form]) -> bool:
    """Whether a form keeps its parameters and gives a future that is no longer shared."""
    before = {form.types: form.returns for form in old}
    return any(_is_future(before.get(form.types, ""), True) and _is_future(form.returns, False) for form in new)


def _is_future(written: str, shared: bool) -> bool:
    return _FUTURE.search(written) is not None and (_SHARED.search(written) is not None) is shared


def _is_forgotten(requirement: Requirement, located: Located) -> bool:
    """Whether a line of the new side can be one that the release forgot.

    Its C++ was built with the change; a publisher that lost its listener in the same release is no accident.
    """
    entity, change = located.pair.old, located.change
    if change.kind == "launch_argument":
        return True
    if entity is None or change.change == "deprecated" or uses()[requirement.use].built:
        return False
    if entity.facet == "subscribed":
        return False
    return change.change in GONE or entity.kind not in {"message_field", "constant"}


def _is_answered(requirement: Requirement, located: Located) -> bool:
    """Whether a comment on the line says that the break is known."""
    names = located.change.old or "", located.change.new or "", requirement.name, requirement.owner
    return any(word in name for word in requirement.ignored for name in names)


def _is_kept_alive(located: Located, remaps: Sequence[Requirement]) -> bool:
    """Whether a remap joins the old and the new name of the topic or service that a use needs."""
    change = located.change
    if change.kind not in _ENDPOINTS or not change.old or not change.new:
        return False
    names = (change.old, change.new)
    return any(_joins(names, (remap.name, remap.said)) or _joins(names, (remap.said, remap.name)) for remap in remaps)


def _joins(names: tuple[str, str], ends: tuple[str, str]) -> bool:
    return all(_means(offered, used) for offered, used in zip(names, ends, strict=True))


def _means(offered: str, used: str) -> bool:
    return _bare(offered) == _bare(used) or graph_name_matches(offered, used)
