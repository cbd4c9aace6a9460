"""Members of class templates as whoever derives from these has them."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.hub.provision import Form, Provision
from ecm_checker.match.hierarchy import Bases


def entity(kind: str, name: str, owner: str = "", **more: Any) -> Provision:
    return Provision(kind=kind, name=name, owner=owner, package="pkg", path="include/pkg/a.hpp", line=1, **more)


@pytest.mark.parametrize(
    ("given", "types"),
    [
        ((("int",), ()), ("int",)),
        ((("int",),), ("int",)),
        ((), ("$1",)),
        ((("int",), (), ("bool",), ()), ("int",)),
    ],
    ids=["each base", "a base without", "a document that has none", "a document that has too many"],
)
def test_a_base_has_the_arguments_that_it_is_given(given: tuple[tuple[str, ...], ...], types: tuple[str, ...]) -> None:
    """Documents come from others: one that tells of fewer bases, or of more, costs nobody an answer."""
    rows = [
        entity("class", "Grid"),
        entity("class", "Other"),
        entity("method", "put", "Grid", forms=(Form(("$1",), 1),)),
        entity("class", "Map", bases=("Grid", "Other"), given=given),
    ]
    found = Bases({row.key: row for row in rows}).provider("Map", True, "put")
    assert found is not None
    assert found.forms[0].types == types
