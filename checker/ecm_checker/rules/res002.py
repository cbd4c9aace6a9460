"""Several modules publish on a topic that moves the robot, and nothing chooses between them."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator
from functools import cache
from importlib import resources
from typing import Any

from ecm_checker.case import Case
from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import roles, writing_roles
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="RES002",
    name="several_actuation_writers",
    dimension="resources",
    severity="warning",
    who="safety",
    part_of=("ResJointSat", "GlobalSafe"),
    by_absence=True,
    consequence="the robot follows whichever message came last and jerks between the two",
    resolution="give each its own topic and put a multiplexer before the base, or run only one of them",
)


def check(case: Case) -> Iterator[Finding]:
    """Actuation topics with several writers in a set without a multiplexer."""
    topics = _table()["topics"]
    written = {
        (role, name): writers
        for role in writing_roles()
        for name, writers in case.by_name(role).items()
        if len(writers) > 1 and name.rpartition("/")[2] in topics
    }
    if not written or any(map(_is_multiplexer, case.modules)):
        return
    for (role, name), writers in written.items():
        kinds = topics[name.rpartition("/")[2]]
        active = [each for each in writers if any(_is_command(each.endpoints(role)[name], kind) for kind in kinds)]
        if len(active) > 1:
            text = f"{name} is published by {', '.join(each.id for each in active)}"
            evidence = [each.endpoints(role)[name][0].evidence[0] for each in active]
            yield RULE.finding(text, Entity(roles()[role].provides, name), active, evidence, certainty="likely")


@cache
def _table() -> dict[str, Any]:
    return tomllib.loads((resources.files("ecm_checker") / "data" / "actuation.toml").read_text("utf-8"))


def _is_command(endpoints: Iterable[Interface], kind: str) -> bool:
    return any(entry.type == kind and entry.evidence for entry in endpoints)


def _is_multiplexer(module: View) -> bool:
    return any(word in module.id.rpartition(".")[2].lower() for word in _table()["multiplexers"]["words"])
