"""LNT029: a script of the workspace uses a name that the workspace offers under another one, with the same type."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.provision import HOLE, Provision
from ecm_checker.hub.roles import asking_uses

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT029",
    name="name_moved_away",
    dimension="versioning",
    severity="warning",
    who="graph",
    consequence="the subscriber or client waits for ever, without an error",
    resolution="use the name that is offered now",
)
_SCRIPT: Final = ".py"
MAX_PROVIDERS: Final = 3
_COMPARED: Final = 2
"""Parts of a name, from its end, by which one that nobody else can mean is told from another namespace."""
_NEVER_ROOT: Final = 3
"""Parts of a name that is no plain one of its namespace."""


def tell(known: Known) -> Iterator[Finding]:
    """Report lines of Python none of whose possible names is offered, while one thing of the type ends the same."""
    level: Severity = "info" if _starts_foreign(known) else "warning"
    for use in asking_uses():
        offered = _offered(known, use)
        for asked in _lines(known, use).values():
            providers = offered.get(asked[0].requirement.type or "", ())
            for each, near in _moved(asked, providers):
                if _is_related(each.consumer.name, near.package, known):
                    lines = known.lines_of(near.package, [Evidence(near.path, near.line)])
                    yield _finding(each, near, lines, level)


def _lines(known: Known, use: str) -> Mapping[Evidence, Sequence[Asked]]:
    """What scripts ask for by line, which may choose from several names; a private one is there to be remapped."""
    found: dict[Evidence, list[Asked]] = defaultdict(list)
    for asked in known.asked(use):
        wanted = asked.requirement
        if wanted.type and not wanted.owner and asked.path.endswith(_SCRIPT):
            found[wanted.evidence[0]].append(asked)
    return found


def _offered(known: Known, use: str) -> Mapping[str, Sequence[Provision]]:
    """What a use may mean, by its type."""
    row = uses()[use]
    found: dict[str, list[Provision]] = defaultdict(list)
    for kind in row.of:
        for each in known.packages.provisions.of_kind(kind):
            if row.facet in {"", each.facet}:
                for shown in (each.type, *each.others):
                    found[shown or ""].append(each)
    return found


def _moved(asked: Sequence[Asked], providers: Sequence[Provision]) -> Iterator[tuple[Asked, Provision]]:
    """What a line asks for in vain, with what is offered in its place."""
    if len(asked) == 1 and _is_met(asked[0]):
        return
    near = _elsewhere(asked, providers)
    if near is not None:
        yield asked[0], near
    else:
        yield from _lost(asked, providers)


def _is_met(asked: Asked) -> bool:
    """Whether the name is offered; a private one hangs below its node, so that it is compared with that."""
    return asked.match.state == "met" and any(not each.name.startswith("~") for each in asked.match.found)


def _elsewhere(asked: Sequence[Asked], providers: Sequence[Provision]) -> Provision | None:
    """Return a provider that ends as the names do, of a few, when no provider can be meant by any of them."""
    names = [each.requirement.name for each in asked]
    ends = {_last(name) for name in names}
    if any(_may_mean(name, _full(each)) for name in names for each in providers) or len(ends) != 1:
        return None
    last = ends.pop()
    found: dict[str, Provision] = {}
    for each in providers:
        if _last(each.name) == last:
            found.setdefault(_full(each), each)
    deep = all(len(_parts(name)) >= _NEVER_ROOT for name in names)
    told = deep and 0 < len(found) <= MAX_PROVIDERS and not _is_computed(last)
    return next(iter(found.values())) if told else None


def _lost(asked: Sequence[Asked], providers: Sequence[Provision]) -> Iterator[tuple[Asked, Provision]]:
    """Of several names that a line chooses from, those that nothing offers while another one is offered."""
    names = [each.requirement.name for each in asked]
    meant = [each for each in providers if any(_may_mean(name, _full(each)) for name in names)]
    free = [each for each in providers if each not in meant]
    for each in asked if meant and len(asked) > 1 else ():
        wanted = each.requirement
        lost = wanted.certainty != "unknown" and not any(_may_mean(wanted.name, _full(other)) for other in meant)
        near = _elsewhere([each], free) if lost else None
        if near is not None:
            yield each, near


def _may_mean(used: str, offered: str) -> bool:
    """Names are compared from their end; a node, and a part that only the launch knows, can be anything."""
    pairs = list(zip(reversed(_parts(used)), reversed(_parts(offered)), strict=False))[:_COMPARED]
    return all(one == two or _is_computed(one) or _is_computed(two) for one, two in pairs)


def _full(offered: Provision) -> str:
    """A private name hangs below its node, where a source names that."""
    name = offered.name
    return f"/{offered.node}{name[1:]}" if offered.node and name.startswith("~/") else name


def _is_computed(part: str) -> bool:
    return part == "~" or "{" in part or HOLE in part


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def _last(name: str) -> str:
    return name.rpartition("/")[2]


def _starts_foreign(known: Known) -> bool:
    """Whether launch files start nodes that are not known, which may offer what nobody here does."""
    return any(asked.match.state == "unknown" for use in ("starts", "includes_launch") for asked in known.asked(use))


def _is_related(user: str, provider: str, known: Known) -> bool:
    """Tell whether a package knows another, so that the one is likely to mean what the other offers."""
    return user == provider or provider in known.needed_by(user) or user in known.needed_by(provider)


def _finding(asked: Asked, near: Provision, lines: list[Evidence], level: Severity) -> Finding:
    wanted, name = asked.requirement, _full(near)
    text = f"{wanted.name} is used and nothing here offers it; {name} has the same type"
    entity = Entity("topic", name, wanted.name)
    places = [*wanted.evidence, *lines]
    return RULE.finding(text, entity, asked.consumer.name, places, certainty="likely", severity=level)
