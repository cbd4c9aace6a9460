"""Names of an owner with those above and below them, as one launch asks for them: met, dangling or unknown."""

from __future__ import annotations

import pytest
from ecm_checker.contract import Evidence
from ecm_checker.hub.package import Package, provided
from ecm_checker.hub.provision import ABOVE, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.packages import Packages


def packages(*rows: Provision) -> Packages:
    return Packages([Package(name="launch", version=None, path="", ros=None, provides=tuple(map(provided, rows)))])


def row(name: str, *, kind: str = "topic", owner: str = "a", facet: str = "", is_open: bool = False) -> Provision:
    return Provision(
        kind=kind, package="launch", owner=owner, name=name, facet=facet, open=is_open, path="a.cpp", line=1
    )


def wanted(name: str, use: str = "renames", owner: str = "a") -> Requirement:
    return Requirement(
        use=use,
        kind="topic",
        package="launch",
        owner=owner,
        name=name,
        type=None,
        certainty="likely",
        conditions=(),
        by="/a",
        evidence=(Evidence("a.launch", 1),),
    )


def state(wants: Requirement, *rows: Provision) -> str:
    known = packages(*rows)
    return known.match(wants, known.consumers[0]).state


OWNER, OPEN = row("a", kind="node", owner=""), row("a", kind="node", owner="", is_open=True)
IMAGE, NAMESPACE = row("/arm/image"), row("/arm", facet=ABOVE)


@pytest.mark.parametrize(
    ("name", "rows", "expected"),
    [
        ("/arm/image", (OWNER, IMAGE), "met"),
        ("/arm/image/compressed", (OWNER, IMAGE), "met"),
        ("/arm", (OWNER, IMAGE, NAMESPACE), "met"),
        ("/arm/scan", (OWNER, IMAGE, NAMESPACE), "dangling"),
        ("/arm/images", (OWNER, IMAGE), "dangling"),
        ("/arm/image", (OWNER, row("/arm/image", owner="b")), "dangling"),
        ("/arm/scan", (OPEN, IMAGE), "unknown"),
        ("/arm/scan", (IMAGE,), "unknown"),
    ],
)
def test_names_of_an_owner(name: str, rows: tuple[Provision, ...], expected: str) -> None:
    """What is below a name that is there may be made by it; beside it nothing is."""
    assert state(wanted(name), *rows) == expected


def test_a_node_of_a_launch() -> None:
    """Nobody else can start one, so that its absence is known."""
    nodes = (row("/left/arm", kind="node", owner=""), row("/left", kind="node", owner="", facet=ABOVE))
    assert state(wanted("/left", "reaches", ""), *nodes) == "met"
    assert state(wanted("/arm", "reaches", ""), *nodes) == "dangling"
