"""Which old constant is which new one."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.hub.provision import Provision
from pairs_of_sides import entity, paired


def _limit(owner: str, **more: Any) -> Provision:
    return entity("constant", "LIMIT", owner, type=more.pop("type", "int"), default=3, path="include/pkg/limits.hpp")


@pytest.mark.parametrize(
    ("old", "new", "holders", "how"),
    [
        (_limit("pkg::Arm"), _limit("pkg::Leg"), (), {"moved"}),
        (_limit("pkg::Arm"), _limit("pkg::Leg"), ("pkg::Arm",), {"same"}),
        (_limit("pkg::arm"), _limit("pkg::leg"), ("pkg::arm", "pkg::leg"), {"same"}),
        (_limit("pkg::arm"), _limit("pkg::leg"), (), {"moved"}),
        (_limit("pkg::Arm"), _limit("limbs::Arm"), ("pkg::Arm", "limbs::Arm"), {"moved"}),
        (_limit("pkg::mode", type="mode"), _limit("pkg::state", type="state"), (), {"same"}),
    ],
)
def test_constants_of_classes_and_of_namespaces(
    old: Provision, new: Provision, holders: tuple[str, ...], how: set[str]
) -> None:
    """Whether the limit of one is that of another tells what both are, not how they are spelt."""
    classes = [entity("class", name, "", path="include/pkg/limits.hpp") for name in holders]
    pairs = paired([old, *classes], [new, *classes])
    assert {pair.how for pair in pairs if (pair.old or pair.new).kind == "constant"} == how  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("name", "value", "how"),
    [("DEFAULT_OFFSET", None, "removed"), ("OFFSET_ADDRESS", 85, "renamed"), ("OFFSET_ADDRESS", 86, "removed")],
)
def test_a_constant_whose_value_is_not_known_is_not_a_number(name: str, value: int | None, how: str) -> None:
    """A list that is called alike means something else than a number did; the same number is the same thing."""
    old = entity("constant", "OFFSET", "pkg.registers", default=85, path="pkg/registers.py")
    new = entity("constant", name, "pkg.registers", default=value, path="pkg/registers.py")
    pairs = paired([old], [new])
    assert {"renamed" if pair.how == "renamed" else "removed" for pair in pairs} == {how}
