"""Fingerprints of the messages of a tree, with types of the distributions filled in."""

from __future__ import annotations

from ecm_parsers.interface import parse
from ecm_parsers.package_facts import Manifest

from ecm_extract.assemble.definitions import Definitions
from ecm_extract.discover import PackageRoot
from ecm_extract.read.facts import PackageFacts


def package(name: str, ros: int, **messages: str) -> PackageFacts:
    interfaces = {f"{name}/msg/{own}.msg": parse(text.encode(), "msg").facts for own, text in messages.items()}
    return PackageFacts(PackageRoot(name, None, ()), Manifest(name), ros, interfaces=interfaces)


def fingerprint(facts: PackageFacts, own: str, definitions: Definitions) -> str | None:
    definition = facts.interfaces[f"{facts.name}/msg/{own}.msg"]
    return definitions.fingerprint(f"{facts.name}/msg/{own}", definition, facts.ros).value


def test_ros1_sum_is_the_one_on_the_wire() -> None:
    """The sum of a copy of geometry_msgs/Twist is the one that nodes exchange."""
    facts = package("geometry_msgs", 1, Twist="Vector3 linear\nVector3 angular\n")
    assert fingerprint(facts, "Twist", Definitions([facts])) == "9f195f881246fdfa2798d1d3eebca84a"


def test_types_of_the_tree_come_before_those_of_a_distribution() -> None:
    """A changed definition in the tree changes the fingerprint of what holds it."""
    plain = package("pkg", 2, Pair="geometry_msgs/Point first\n")
    own = package("geometry_msgs", 2, Point="float32 x\n")
    assert fingerprint(plain, "Pair", Definitions([plain])) != fingerprint(plain, "Pair", Definitions([plain, own]))


def test_a_type_that_nobody_knows_gives_no_fingerprint() -> None:
    """A sum over a guess would be worse than none."""
    facts = package("pkg", 2, Odd="nowhere_msgs/Thing thing\n")
    assert fingerprint(facts, "Odd", Definitions([facts])) is None
