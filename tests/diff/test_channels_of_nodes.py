"""Channels by private names, and by handles that are not known: which old one is which new one."""

from __future__ import annotations

from typing import Any

import pytest
from pairs_of_sides import entity, paired, shown


@pytest.mark.parametrize("name", ["~/state", "~/result/state"])
def test_a_private_name_of_another_node_is_another_channel(name: str) -> None:
    """`~/state` of one node is below the name of that node: another node that has one now has its own."""
    state: dict[str, Any] = {"type": "std_msgs/msg/String", "facet": "published"}
    old = [entity("topic", "~/state", "arm", path="src/arm.py", **state)]
    new = [entity("topic", name, "leg", path="src/leg.py", **state)]
    assert shown(paired(old, new)) == [("~/state", None, "same"), (None, name, "same")]


def test_that_a_public_channel_is_of_another_node_now_says_nothing_of_private_ones() -> None:
    """Two nodes that publish `/image` one after the other are two nodes."""
    image: dict[str, Any] = {"type": "sensor_msgs/msg/Image", "facet": "published"}
    both = ("/image", "~/image")
    old = [entity("topic", name, "arm", path="src/arm.py", node="arm", **image) for name in both]
    new = [entity("topic", name, "leg", path="src/leg.py", node="leg", **image) for name in both]
    assert ("~/image", None, "same") in shown(paired(old, new))


def test_a_private_name_is_still_that_of_its_node_whose_file_moved() -> None:
    """Where the file of the node moved, its channels went with it."""
    state: dict[str, Any] = {"type": "std_msgs/msg/String", "facet": "published"}
    old = [entity("topic", "~/state", "arm", path="src/arm.py", node="arm", **state)]
    new = [entity("topic", "~/state", "new_arm", path="src/new_arm.py", node="new_arm", **state)]
    assert shown(paired(old, new, {"src/arm.py": "src/new_arm.py"})) == [("~/state", "~/state", "same")]


@pytest.mark.parametrize("old", ["/scanned", "~/scanned"])
@pytest.mark.parametrize(("new", "how"), [("/<*>/scanned", "same"), ("/<*>/scans", "lost")])
def test_a_handle_that_is_not_known_may_be_any(old: str, new: str, how: str) -> None:
    """What it puts before a name may be the node's name, nothing, or anything else: the name may be what it was."""
    scan: dict[str, Any] = {"type": "sensor_msgs/msg/LaserScan", "facet": "published"}
    pairs = paired([entity("topic", old, "arm", **scan)], [entity("topic", new, "arm", **scan)])
    assert (shown(pairs) == [(old, new, "same")]) == (how == "same")


def test_a_parameter_by_such_a_handle_has_no_other_name() -> None:
    """It is told as what may be there still, and not as renamed to a pattern that it fits."""
    old = entity("parameter", "frame_id", type="string")
    (lost,) = [pair for pair in paired([old], [entity("parameter", "/<*>/frame_id", type="string")]) if pair.old]
    assert (lost.new, lost.hidden_in and lost.hidden_in.name) == (None, "/<*>/frame_id")
