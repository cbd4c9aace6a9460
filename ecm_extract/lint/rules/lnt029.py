"""LNT029: a script of the workspace uses a name that the workspace offers under another one, with the same type."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence, Interface
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT029",
    name="name_moved_away",
    dimension="versioning",
    severity="warning",
    who="graph",
    consequence="the subscriber or client waits for ever, without an error",
    resolution="use the name that is offered now",
)
_OFFERS = {"subscriber": "publisher", "service_client": "service_server", "action_client": "action_server"}
MAX_PROVIDERS = 3
_COMPILED = (".cpp", ".cc", ".hpp", ".h")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report lines of Python none of whose possible names is offered, while one thing of the type ends the same.

    Not asked of the engine: a name that is near by its end is no match of the engine.
    """
    offered: dict[tuple[str, str | None], dict[str, Interface]] = {}
    used: dict[tuple[Evidence, str], list[Interface]] = {}
    packages: dict[Evidence, str] = {}
    for entry in workspace.linked:
        for interface in entry.interfaces:
            offered.setdefault((interface.role, interface.type), {}).setdefault(interface.name, interface)
            place = interface.evidence[0]
            is_own = interface.raw_name.startswith("~")  # a private name is there to be remapped
            if interface.role in _OFFERS and interface.type and not is_own and not place.path.endswith(_COMPILED):
                used.setdefault((place, interface.role), []).append(interface)
                packages.setdefault(place, entry.module.package)
    for (place, role), names in used.items():
        user = packages[place]
        providers = list(offered.get((_OFFERS[role], names[0].type), {}).values())
        near = _elsewhere(names, providers)
        pairs = [(names[0], near)] if near is not None else _lost(names, providers)
        for name, other in pairs:
            if _is_related(user, workspace.package_of(other.evidence[0].path), workspace):
                yield _finding(name, other, user, "info" if workspace.starts_foreign else "warning")


def _is_related(user: str, provider: str, workspace: Workspace) -> bool:
    """Tell whether a package knows another, so that the one is likely to mean what the other offers."""
    asked = {
        name: {entry.name for entry in package.manifest.dependencies} if package.manifest is not None else set()
        for name, package in workspace.by_name.items()
        if name in (user, provider)
    }
    return user == provider or provider in asked.get(user, ()) or user in asked.get(provider, ())


def _elsewhere(names: list[Interface], providers: list[Interface]) -> Interface | None:
    """Return a provider that ends as the names do, of a few, when no provider can be meant by any of them."""
    ends = {_last(name.name) for name in names}
    if any(_may_mean(name.name, each.name) for name in names for each in providers) or len(ends) != 1:
        return None
    last = ends.pop()
    found = {each.name: each for each in providers if _last(each.name) == last}
    deep = all(len(_parts(name.name)) > 2 for name in names)
    return next(iter(found.values())) if deep and 0 < len(found) <= MAX_PROVIDERS and "{" not in last else None


def _lost(names: list[Interface], providers: list[Interface]) -> Iterator[tuple[Interface, Interface]]:
    """Of several names that a line chooses from, those that nothing offers while another one is offered."""
    meant = [each for each in providers if any(_may_mean(name.name, each.name) for name in names)]
    free = [each for each in providers if each not in meant]
    for name in names if meant and len(names) > 1 else ():
        lost = name.confidence != "pattern" and not any(_may_mean(name.name, each.name) for each in meant)
        near = _elsewhere([name], free) if lost else None
        if near is not None:
            yield name, near


def _may_mean(used: str, offered: str) -> bool:
    """Names are compared from their end; `~`, and a part that only the launch knows, can be anything."""
    pairs = zip(reversed(_parts(used)), reversed(_parts(offered)), strict=False)
    return all(one == two or "~" in (one, two) or "{" in one + two for one, two in list(pairs)[:2])


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def _last(name: str) -> str:
    return name.rsplit("/", 1)[-1]


def _finding(interface: Interface, near: Interface, package: str, level: Severity) -> Finding:
    text = f"{interface.name} is used and nothing here offers it; {near.name} has the same type"
    entity = Entity("topic", near.name, interface.name)
    places = [interface.evidence[0], near.evidence[0]]
    return RULE.finding(text, entity, package, places, certainty="likely", severity=level)
